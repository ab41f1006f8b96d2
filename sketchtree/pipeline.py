"""A sketch in, a complete tree out: every stage in order.

    strokes → sketch graph → template → depths → skeleton → propagation → radii → sag, shedding, untangling, pruning → leaves → meshes
"""

import dataclasses
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.choose import bark_model, choose_template, leaf_model
from sketchtree.drawing import read_drawing
from sketchtree.dressing import Dress
from sketchtree.errors import InferenceError
from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.populate import populate
from sketchtree.geometry.mesh import Mesh
from sketchtree.geometry.radii import PipeRadii
from sketchtree.geometry.wood import check_wood, wood_of
from sketchtree.keys import stage_key
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import Fit, infer
from sketchtree.mrf.lift import lift
from sketchtree.mrf.methods import solver_named
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.solver import RESULTS
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.page import drawn_radius, page_to_world
from sketchtree.parameters import GENERIC, Habit, TreeParameters
from sketchtree.propagate.after.each_tree import sagged
from sketchtree.propagate.after.level import kept_weight
from sketchtree.propagate.after.prune import Prune
from sketchtree.propagate.after.shed import Shed
from sketchtree.propagate.after.untangle import Untangle
from sketchtree.propagate.generations import Propagate, Propagation
from sketchtree.propagate.scale import to_scale
from sketchtree.roots import root_depth
from sketchtree.similarity import Similarity
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_joined import moved
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch
from sketchtree.templates.store.database import Database
from sketchtree.templates.exemplar import Exemplar
from sketchtree.templates.matching.match import Match
from sketchtree.watch import Watch

STAGES = ("read", "match", "infer", "propagate", "foliage", "mesh", "export")
"""Stages in the order they run; `seconds` in the report has one entry each."""


@dataclass(frozen=True, eq=False)
class DrawnTree:
    """The drawn branches in 3D, and how they came to be."""

    graph: SketchGraph
    matches: list[Match]  # best first; empty without templates
    exemplar: Exemplar | None  # the template used
    fit: Fit
    similarity: Similarity  # sketch units → metres
    skeleton: TreeSkeleton  # metres; rows are those of the graph
    radius: Float[np.ndarray, " segment"]  # as drawn, metres; NaN where the lines' widths say nothing
    habit: Habit
    held: bool  # Θ is the template's, whatever was drawn
    theta: TreeParameters  # by which the rest grows: measured on these branches, or the template's where Θ is fixed
    sketch: Sketch  # as read

    @property
    def crown(self) -> tuple[Float[np.ndarray, "point 2"], ...]:
        """The drawn crown's outlines, world metres."""
        return tuple(self.similarity.to_world(outline) for outline in self.graph.crown)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the user should know about the reading and the depths."""
        unsettled = () if self.fit.result == RESULTS.converged else (str(RESULTS[self.fit.result]),)
        return self.graph.warnings + unsettled + self.fit.warnings


@dataclass(frozen=True, eq=False)
class TreeModel:
    """A complete tree."""

    drawn: DrawnTree
    skeleton: TreeSkeleton
    leaves: Leaves
    meshes: tuple[Mesh, ...]  # wood, then leaves and blossoms if there are any
    warnings: tuple[str, ...]
    blossom: Leaves | None = None  # in spring, where the species has one
    dress: Dress = Dress("oak", None)  # what it wears
    wood_used: str = "tubes"  # how the wood was made: one-piece | tubes | solid


def sketch_to_tree(
    sketch: Sketch | str | Path,
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    reading: ReadingOptions = ReadingOptions(),
    tree: TreeOptions = TreeOptions(),
    watch: Watch | None = None,
) -> TreeModel:
    """Every stage in order (Chen et al. 2008, Figure 2). `sketch` may be a path to a file."""
    watch = watch or Watch()
    leaf_model(tree.leaf, Habit(), templates), bark_model(tree.bark, Habit())  # refuse a wrong name before the work
    Prune(tree.prune), check_wood(tree.wood, tree.solid)  # and a mesh that can't be used, and what isn't installed
    obstacles = read_obstacles(tree)
    drawn = draw_out(sketch, templates, key=key, options=reading, watch=watch)
    return complete(drawn, templates, key=key, options=tree, obstacles=obstacles, watch=watch)


def draw_out(
    sketch: Sketch | str | Path,
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    options: ReadingOptions = ReadingOptions(),
    watch: Watch | None = None,
) -> DrawnTree:
    """Strokes → sketch graph → template → depths: the drawn branches in 3D (§5, §7)."""
    watch = watch or Watch()
    with watch("read"):
        sketch, graph = read_drawing(sketch, options, watch)
        above = graph.above_ground()
    with watch("match"):
        templates = templates if templates is not None or options.template == "none" else Database.open()
        matches, exemplar = choose_template(above, templates, options.template)
        habit = exemplar.habit if exemplar else Habit()
        prior = Prior(exemplar.theta, exemplar.limbs) if exemplar else Prior(GENERIC)
    with watch("infer"):
        factors = factor_graph(above)
        solver = solver_named(options.method, theta=options.theta, planar=options.planar)
        solver = solver.with_samples(options.samples, factors) if options.samples else solver
        fit = infer(factors, prior, solver, key=stage_key(key, "infer"), alternatives=options.alternatives, throw=False)
        if fit.result == RESULTS.not_finite:
            raise InferenceError(f"The depths could not be inferred by `{options.method}`.", remedy=str(RESULTS[fit.result]))
        fit = _with_roots(fit, graph)
        similarity = page_to_world(above, options.height or habit.height)
        radius = np.full(len(graph), np.nan)
        radius[~graph.root] = drawn_radius(sketch, above, similarity, habit)
        skeleton = lift(graph, fit.depth, similarity, depth_sd=fit.depth_sd)
        skeleton = PipeRadii(habit, radius)(skeleton, key=stage_key(key, "radii"))
    held = options.theta == "fixed"
    theta = fit.theta_before if held else fit.theta
    return DrawnTree(graph, matches, exemplar, fit, similarity, skeleton, radius, habit, held, theta, sketch)


def _with_roots(fit: Fit, graph: SketchGraph) -> Fit:
    """The fit with a row for every drawn root too (they stand last in the graph)."""
    if not graph.root.any():
        return fit
    depth, sd = root_depth(graph), np.full(len(graph), np.nan)
    depth[~graph.root], sd[~graph.root] = fit.depth, fit.depth_sd
    others = tuple(reading._replace(depth=np.r_[reading.depth, depth[graph.root]]) for reading in fit.alternatives)
    return dataclasses.replace(fit, depth=depth, depth_sd=sd, alternatives=others)


def complete(
    drawn: DrawnTree,
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    options: TreeOptions = TreeOptions(),
    obstacles: tuple | None = None,
    watch: Watch | None = None,
) -> TreeModel:
    """Replication blocks, radii, leaves and meshes: the complete tree (§6).

    `obstacles` are the meshes of `options.obstacle` (trimesh.Trimesh, world metres), if they have been read."""
    watch = watch or Watch()
    with watch("propagate"):
        obstacles = read_obstacles(options) if obstacles is None else obstacles
        grown = propagation(drawn, options, obstacles).run(drawn.skeleton, key=stage_key(key, "propagate"))
    return finish(drawn, grown, templates, key=key, options=options, watch=watch)


def finish(
    drawn: DrawnTree,
    grown: Propagation,
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    options: TreeOptions = TreeOptions(),
    place: Float[np.ndarray, " 3"] | None = None,
    watch: Watch | None = None,
) -> TreeModel:
    """Radii, sag, shedding, pruning, leaves and meshes of a tree that has grown; at another place (metres) than it was drawn, if asked."""
    watch = watch or Watch()
    habit = drawn.habit
    leaf = leaf_model(options.leaf, habit, templates)
    bark = bark_model(options.bark, habit)
    with watch("propagate"):
        left, tangled = _weathered(drawn, grown, options)
        skeleton, told = _pruned(left if place is None else moved(left, place), options)
        warnings = grown.warnings + tangled + told
    with watch("foliage"):
        leaves, flowers = _foliage(skeleton, habit, leaf, options.season, stage_key(key, "foliage"))
    if leaves.kept < 1:
        warnings += (f"Only {leaves.kept:.1%} of the leaves were kept (at most {len(leaves)}), each larger, so that their area is right.",)
    with watch("mesh"):
        wood = wood_of(skeleton, bark=bark, habit=habit, key=stage_key(key, "mesh"), wood=options.wood, solid=options.solid)
        meshes = [*wood.meshes]
        meshes += [leaf_mesh(worn, season=options.season) for worn in (leaves, flowers) if worn is not None and len(worn)]
    warnings = drawn.warnings + warnings + wood.warnings
    return TreeModel(drawn, skeleton, leaves, tuple(meshes), warnings, flowers, Dress(bark, leaf, options.season, habit), wood.made)


def _foliage(tree: TreeSkeleton, habit: Habit, leaf: str | None, season: str, key: Key[Array, ""]) -> tuple[Leaves, Leaves | None]:
    """The leaves, and the blossoms of a spring."""
    if leaf is None:
        return Leaves.none(habit.leaf), None
    return populate(tree, habit, key=key, model=leaf, season=season), blossom(tree, habit, key=key, model=leaf, season=season)


def read_obstacles(options: TreeOptions) -> tuple:
    """The meshes of the files named; refused here, before the work, if one is around the root, which is the world's origin."""
    if not options.obstacle:
        return ()
    from sketchtree.propagate.space.mesh_files import read_mesh
    from sketchtree.propagate.space.obstacle import refuse_around

    meshes = tuple(read_mesh(path) for path in options.obstacle)
    refuse_around(meshes, np.zeros((1, 3)))
    return meshes


def propagation(drawn: DrawnTree, options: TreeOptions, obstacles: tuple = ()) -> Propagate:
    """How this tree is to grow."""
    return Propagate(
        drawn.habit,
        drawn.theta,
        crown=drawn.crown,
        obstacles=obstacles,
        regions=tuple(drawn.similarity.to_world(outline) for outline in drawn.graph.obstacles),
        generations=options.generations,
        fill=options.fill,
        max_segments=options.max_segments,
        density=options.density,
        light=options.light,
        fixed=drawn.held,
        exemplar=drawn.exemplar.skeleton if drawn.exemplar else None,
    )


def _pruned(tree: TreeSkeleton, options: TreeOptions) -> tuple[TreeSkeleton, tuple[str, ...]]:
    """What the shears leave, and what the user should know about it."""
    pruned = Prune(options.prune).run(tree)
    cut = pruned.strokes_cut
    return pruned.skeleton, (f"Pruning cut {cut} drawn stroke{'s' if cut > 1 else ''}.",) if cut else ()


def _weathered(drawn: DrawnTree, grown: Propagation, options: TreeOptions) -> tuple[TreeSkeleton, tuple[str, ...]]:
    """What weight, shade and others in the way leave of a grown tree, with the radii of what is left; and what the user should know."""
    radius = np.full(len(grown.skeleton), np.nan)
    radius[grown.drawn_row] = drawn.radius
    tree, weight = grown.skeleton, grown.tip_weight
    tree = PipeRadii(drawn.habit, radius, weight)(tree)
    habit = to_scale(drawn.habit, drawn.skeleton, drawn.crown)
    shed = Shed(options.shed, options.shed_twigs, habit)
    for run in (lambda whole: sagged(whole, options.sag, drawn.habit, grown.spaces), shed.run):
        cut = run(tree)
        radius, weight = radius[cut.rows], None if weight is None else kept_weight(tree, cut, weight)
        tree = cut.skeleton
    if options.sag or options.shed or options.shed_twigs:
        tree = PipeRadii(drawn.habit, radius, weight)(tree)
    if not options.untangle:
        return tree, ()
    freed = Untangle(habit, grown.spaces).run(tree)
    if len(freed.rows) < len(tree):
        weight = None if weight is None else kept_weight(tree, freed, weight)
        return PipeRadii(drawn.habit, radius[freed.rows], weight)(freed.skeleton), freed.warnings
    return freed.skeleton, freed.warnings


@dataclass(frozen=True)
class SketchSource:
    """The built-in source: a sketch, or a path to one, becomes its drawn branches in 3D."""

    options: ReadingOptions = ReadingOptions()

    def __call__(self, input: Sketch | str | Path, *, key: Key[Array, ""]) -> TreeSkeleton:
        return draw_out(input, key=key, options=self.options).skeleton
