"""A sketch in, a complete tree out: every stage in order.

    strokes → sketch graph → template → depths → skeleton → propagation → radii → sag, shedding, untangling, pruning → leaves → meshes
"""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.choose import bark_model, leaf_model
from sketchtree.drawn_tree import DrawnTree, draw_out
from sketchtree.dressing import Dress
from sketchtree.editing.clearing import cleared
from sketchtree.editing.laid_cloud import LaidCloud
from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.populate import populate
from sketchtree.geometry.bark import Colour
from sketchtree.geometry.mesh import Mesh
from sketchtree.geometry.radii import PipeRadii
from sketchtree.geometry.wood import check_wood, wood_of
from sketchtree.keys import stage_key
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.parameters import Habit
from sketchtree.propagate.after.each_tree import sagged
from sketchtree.propagate.after.level import kept_weight
from sketchtree.propagate.after.prune import Prune
from sketchtree.propagate.after.shed import Shed
from sketchtree.propagate.after.untangle import Untangle
from sketchtree.propagate.generations import Propagate, Propagation
from sketchtree.propagate.scale import to_scale
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_joined import moved
from sketchtree.sketch.strokes import Sketch
from sketchtree.templates.store.database import Database
from sketchtree.watch import Pulse, Watch, no_pulse

STAGES = ("read", "match", "infer", "propagate", "foliage", "mesh", "export")
"""Stages in the order they run; `seconds` in the report has one entry each."""


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
    cloud: LaidCloud | None = None,
    watch: Watch | None = None,
) -> TreeModel:
    """Every stage in order (Chen et al. 2008, Figure 2). `sketch` may be a path to a file; `cloud`: points that it was drawn over, if not those of its project."""
    watch = watch or Watch()
    leaf_model(tree.leaf, Habit(), templates), bark_model(tree.bark, Habit())  # refuse a wrong name before the work
    Prune(tree.prune), check_wood(tree.wood, tree.solid)  # and a mesh that can't be used, and what isn't installed
    obstacles = read_obstacles(tree)
    drawn = draw_out(sketch, templates, key=key, options=reading, cloud=cloud, watch=watch)
    return complete(drawn, templates, key=key, options=tree, obstacles=obstacles, watch=watch)


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
        grown = grow(drawn, options, obstacles, key=key)
    return finish(Grown(drawn, grown, key, options, templates), watch)


def grow(
    drawn: DrawnTree,
    options: TreeOptions,
    obstacles: tuple = (),
    *,
    key: Key[Array, ""],
    only: frozenset[int] | None = None,
    pulse: Pulse = no_pulse,
) -> Propagation:
    """What the sketch left out, grown (§6); nothing where a limb was cleared away by hand. `only`: ids of the drawn limbs that grow. `pulse` is called before
    every generation; what it raises ends the growth."""
    grown = dataclasses.replace(propagation(drawn, options, obstacles), only=only).run(drawn.skeleton, key=stage_key(key, "propagate"), pulse=pulse)
    return cleared(grown, drawn.edits.cleared.values(), drawn.similarity)


@dataclass(frozen=True, eq=False)
class LeafyTree:
    """A tree that has grown, with its leaves; all but its meshes."""

    skeleton: TreeSkeleton
    leaves: Leaves
    blossom: Leaves | None
    dress: Dress
    warnings: tuple[str, ...]


Leafing = Callable[[TreeSkeleton, Dress, Key[Array, ""]], tuple[Leaves, Leaves | None]]
"""Makes the leaves, and the blossoms if there are any, of a skeleton."""


@dataclass(frozen=True, eq=False)
class Grown:
    """A tree that has grown, and what the rest of it is to be made with."""

    drawn: DrawnTree
    grown: Propagation
    key: Key[Array, ""]
    options: TreeOptions = TreeOptions()
    templates: Database | None = None  # for their leaves
    place: Float[np.ndarray, " 3"] | None = None  # where it stands, metres; None: where it was drawn
    leafing: Leafing | None = None  # what makes its leaves and blossoms, where that is not `foliage`
    bark_colour: Callable[[str], Colour | None] | None = None  # the mean colour of its bark, by the bark's name, where that is not the bark's own


def leafy(tree: Grown, watch: Watch | None = None) -> LeafyTree:
    """Radii, sag, shedding, pruning and leaves."""
    watch = watch or Watch()
    habit, options = tree.drawn.habit, tree.options
    bark = bark_model(options.bark, habit)
    colour = None if tree.bark_colour is None else tree.bark_colour(bark)
    dress = Dress(bark, leaf_model(options.leaf, habit, tree.templates), options.season, habit, bark_colour=colour)
    with watch("propagate"):
        skeleton, warnings = weathered(tree.drawn, tree.grown, options, tree.place)
    with watch("foliage"):
        leaves, flowers = foliage(skeleton, dress, key=tree.key) if tree.leafing is None else tree.leafing(skeleton, dress, tree.key)
    if leaves.kept < 1:
        warnings += (f"Only {leaves.kept:.1%} of the leaves were kept (at most {len(leaves)}), each larger, so that their area is right.",)
    return LeafyTree(skeleton, leaves, flowers, dress, warnings)


def finish(grown: Grown, watch: Watch | None = None) -> TreeModel:
    """Radii, sag, shedding, pruning, leaves and meshes."""
    watch = watch or Watch()
    tree, options = leafy(grown, watch), grown.options
    dress = tree.dress
    with watch("mesh"):
        wood = wood_of(tree.skeleton, bark=dress.bark, habit=dress.habit, key=stage_key(grown.key, "mesh"), wood=options.wood, solid=options.solid, bark_colour=dress.bark_colour)
        meshes = [*wood.meshes]
        meshes += [leaf_mesh(worn, season=options.season) for worn in (tree.leaves, tree.blossom) if worn is not None and len(worn)]
    warnings = grown.drawn.warnings + tree.warnings + wood.warnings
    return TreeModel(grown.drawn, tree.skeleton, tree.leaves, tuple(meshes), warnings, tree.blossom, dress, wood.made)


def weathered(
    drawn: DrawnTree, grown: Propagation, options: TreeOptions, place: Float[np.ndarray, " 3"] | None = None, pulse: Pulse = no_pulse
) -> tuple[TreeSkeleton, tuple[str, ...]]:
    """What weight, shade, others in the way and the shears leave of a grown tree, with its radii; and what the user should know."""
    left, tangled = _weathered(drawn, grown, options, pulse)
    pulse()
    skeleton, told = _pruned(left if place is None else moved(left, place), options)
    return skeleton, grown.warnings + tangled + told


def foliage(tree: TreeSkeleton, dress: Dress, *, key: Key[Array, ""], pulse: Pulse = no_pulse) -> tuple[Leaves, Leaves | None]:
    """The leaves, and the blossoms of a spring."""
    habit, leaf, season, key = dress.habit, dress.leaf, dress.season, stage_key(key, "foliage")
    if leaf is None:
        return Leaves.none(habit.leaf), None
    how = {"key": key, "model": leaf, "season": season, "pulse": pulse}
    return populate(tree, habit, **how), blossom(tree, habit, **how)


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
        like=drawn.settled.manner.blocks,
    )


def _pruned(tree: TreeSkeleton, options: TreeOptions) -> tuple[TreeSkeleton, tuple[str, ...]]:
    """What the shears leave, and what the user should know about it."""
    pruned = Prune(options.prune).run(tree)
    cut = pruned.strokes_cut
    return pruned.skeleton, (f"Pruning cut {cut} drawn stroke{'s' if cut > 1 else ''}.",) if cut else ()


def _weathered(drawn: DrawnTree, grown: Propagation, options: TreeOptions, pulse: Pulse) -> tuple[TreeSkeleton, tuple[str, ...]]:
    """What weight, shade and others in the way leave of a grown tree, with the radii of what is left; and what the user should know."""
    radius = np.full(len(grown.skeleton), np.nan)
    radius[grown.drawn_row] = drawn.radius
    tree, weight = grown.skeleton, grown.tip_weight
    tree = PipeRadii(drawn.habit, radius, weight)(tree)
    habit = to_scale(drawn.habit, drawn.skeleton, drawn.crown)
    shed = Shed(options.shed, options.shed_twigs, habit)
    for run in (lambda whole: sagged(whole, options.sag, drawn.habit, grown.spaces), shed.run):
        pulse()
        cut = run(tree)
        radius, weight = radius[cut.rows], None if weight is None else kept_weight(tree, cut, weight)
        tree = cut.skeleton
    if options.sag or options.shed or options.shed_twigs:
        tree = PipeRadii(drawn.habit, radius, weight)(tree)
    if not options.untangle:
        return tree, ()
    pulse()
    freed = Untangle(habit, grown.spaces).run(tree, pulse)
    if len(freed.rows) < len(tree):
        weight = None if weight is None else kept_weight(tree, freed, weight)
        return PipeRadii(drawn.habit, radius[freed.rows], weight)(freed.skeleton), freed.warnings
    return freed.skeleton, freed.warnings
