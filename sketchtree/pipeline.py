"""A sketch in, a complete tree out: every stage in order.

    strokes → sketch graph → template → depths → skeleton → propagation → radii → leaves → meshes
"""

import dataclasses
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.errors import InferenceError, OptionError, TemplateError
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_names
from sketchtree.foliage.populate import populate
from sketchtree.geometry.bark import bark_names
from sketchtree.geometry.mesh import Mesh
from sketchtree.geometry.radii import PipeRadii
from sketchtree.geometry.wood import wood_mesh
from sketchtree.keys import stage_key
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import Fit, infer
from sketchtree.mrf.lift import lift
from sketchtree.mrf.methods import solver_named
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.solver import RESULTS
from sketchtree.parameters import GENERIC, Habit
from sketchtree.propagate.generations import Propagate
from sketchtree.similarity import Similarity
from sketchtree.skeleton import TreeSkeleton
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch
from sketchtree.templates.database import Database
from sketchtree.templates.exemplar import Exemplar
from sketchtree.templates.match import Match, match

_STOUT = 1.6  # a trunk drawn thicker than its species has is at most this many times as thick
_THIN = 0.12  # radius of the thinnest line's branch / radius of the trunk, at most

STAGES = ("read", "match", "infer", "propagate", "foliage", "mesh", "export")
"""Stages in the order they run; `seconds` in the report has one entry each."""


@dataclass(frozen=True)
class ReadingOptions:
    """How a sketch becomes drawn branches in 3D."""

    template: str = "auto"  # auto: best match; none: no template; else an exemplar's name
    theta: str = "fit"  # fit: learn Θ from the sketch; fixed: hold the template's
    method: str = "elevation"
    height: float | None = None  # metres, > 0; None: the template's
    crown: str = "auto"  # auto | off
    planar: bool = False
    max_strokes: int = 20_000

    def __post_init__(self):
        if self.height is not None and not (np.isfinite(self.height) and 0 < self.height <= 1000):
            raise OptionError(f"`--height {self.height:g}` is no height of a tree.", remedy="Give metres above 0, at most 1000.")


@dataclass(frozen=True)
class TreeOptions:
    """How the drawn branches become a complete tree."""

    generations: int | None = None  # ≥ 0; None: 5, or up to 12 inside a crown; 0: only what was drawn
    fill: bool = False  # keep on until the crown is evenly filled
    max_segments: int = 200_000
    leaf: str | None = None  # leaf model, exemplar whose leaf to take, or "none"; None: the template's
    season: str = "summer"
    bark: str | None = None  # None: the template's

    def __post_init__(self):
        if self.generations is not None and not 0 <= self.generations <= 12:
            raise OptionError(f"`--generations {self.generations}` is out of range.", remedy="Give 0 to 12.")


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

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the user should know about the reading and the depths."""
        unsettled = () if self.fit.result == RESULTS.converged else (str(RESULTS[self.fit.result]),)
        return self.graph.warnings + unsettled


@dataclass(frozen=True, eq=False)
class TreeModel:
    """A complete tree."""

    drawn: DrawnTree
    skeleton: TreeSkeleton
    leaves: Leaves
    meshes: tuple[Mesh, ...]  # wood, then leaves if there are any
    warnings: tuple[str, ...]


@dataclass
class Watch:
    """Seconds of every stage; tells `on_stage` when one begins."""

    on_stage: Callable[[str], None] = lambda stage: None
    seconds: dict[str, float] = field(default_factory=dict)

    def __call__(self, stage: str):
        self.on_stage(stage)
        return _Lap(self, stage)


class _Lap:
    def __init__(self, watch: Watch, stage: str):
        self._watch, self._stage = watch, stage

    def __enter__(self):
        self._began = time.perf_counter()

    def __exit__(self, *_):
        lap = time.perf_counter() - self._began
        self._watch.seconds[self._stage] = self._watch.seconds.get(self._stage, 0.0) + lap


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
    drawn = draw_out(sketch, templates, key=key, options=reading, watch=watch)
    return complete(drawn, templates, key=key, options=tree, watch=watch)


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
        sketch = sketch if isinstance(sketch, Sketch) else read_sketch(sketch, max_strokes=options.max_strokes)
        graph = sketch_graph(sketch, crown=options.crown)
    with watch("match"):
        templates = templates if templates is not None or options.template == "none" else Database.open()
        matches, exemplar = choose_template(graph, templates, options.template)
        habit = exemplar.habit if exemplar else Habit()
        prior = Prior(exemplar.theta, exemplar.limbs) if exemplar else Prior(GENERIC)
    with watch("infer"):
        solver = solver_named(options.method, theta=options.theta, planar=options.planar)
        fit = infer(factor_graph(graph), prior, solver, key=stage_key(key, "infer"), throw=False)
        if fit.result == RESULTS.not_finite:
            raise InferenceError(f"The depths could not be inferred by `{options.method}`.", remedy=str(RESULTS[fit.result]))
        similarity = page_to_world(graph, options.height or habit.height)
        radius = drawn_radius(sketch, graph, similarity, habit)
        skeleton = lift(graph, fit.depth, similarity, depth_sd=fit.depth_sd)
        skeleton = PipeRadii(habit, radius)(skeleton, key=stage_key(key, "radii"))
    return DrawnTree(graph, matches, exemplar, fit, similarity, skeleton, radius, habit)


def complete(
    drawn: DrawnTree,
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    options: TreeOptions = TreeOptions(),
    watch: Watch | None = None,
) -> TreeModel:
    """Replication blocks, radii, leaves and meshes: the complete tree (§6)."""
    watch = watch or Watch()
    habit = drawn.habit
    leaf = leaf_model(options.leaf, habit, templates)
    bark = bark_model(options.bark, habit)
    with watch("propagate"):
        skeleton, warnings = _propagated(drawn, options, stage_key(key, "propagate"))
    with watch("foliage"):
        season = "bare" if leaf is None else options.season
        leaves = populate(skeleton, habit, key=stage_key(key, "foliage"), model=leaf or habit.leaf, season=season)
    if leaves.kept < 1:
        warnings += (f"Only {leaves.kept:.0%} of the leaves were kept (at most {len(leaves)}), each larger, so that their area is right.",)
    with watch("mesh"):
        meshes = [wood_mesh(skeleton, bark=bark, key=stage_key(key, "mesh"))]
        if len(leaves):
            meshes.append(leaf_mesh(leaves, season=options.season))
    return TreeModel(drawn, skeleton, leaves, tuple(meshes), drawn.warnings + warnings)


def choose_template(graph: SketchGraph, templates: Database | None, wanted: str) -> tuple[list[Match], Exemplar | None]:
    """All exemplars ranked (§7), and the one to use: the best, or the one the user named."""
    if wanted == "none" or templates is None:
        return [], None
    if wanted != "auto" and wanted not in templates.names:
        names = ", ".join(templates.names)
        raise TemplateError(f"There is no template called “{wanted}”.", remedy=f"Choose auto, none or one of: {names}.")
    matches = match(graph, templates)
    return matches, templates.exemplar(matches[0].name if wanted == "auto" else wanted)


def page_to_world(graph: SketchGraph, height: float) -> Similarity:
    """The similarity that puts the first root at the origin and gives the drawing `height` metres.

    The drawing's height runs from the root to the highest point of branches and crown; a drawing
    much wider than high (a fallen or creeping tree) is scaled by its width instead."""
    points = np.concatenate([graph.xy, graph.curve_points, *graph.crown])
    root = graph.xy[np.flatnonzero(graph.is_base)[0]]
    extent = max(points[:, 1].max() - root[1], 0.4 * np.ptp(points[:, 0]), 1e-300)
    scale = height / extent
    return Similarity(scale, (-scale * root[0], -scale * root[1], 0.0))


def drawn_radius(sketch: Sketch, graph: SketchGraph, similarity: Similarity, habit: Habit) -> Float[np.ndarray, " segment"]:
    """Half the drawn width of each branch, metres; NaN where the widths say nothing.

    An outline filled with ink shows how thick the wood is. A pen's line does not: it shows which branch is thicker
    than which. The thickest line then stands for the trunk of such a tree (or up to `_STOUT` times that, if it was
    drawn so), the thinnest for a branch no thicker than `_THIN` of it, and those between for what lies between on a
    logarithmic scale."""
    radius = graph.width * similarity.scale / 2
    inked = np.array([stroke.filled for stroke in sketch.strokes], bool)
    if np.isnan(radius).all() or inked[graph.stroke].any():
        return radius
    thinnest, thickest = np.nanmin(radius), np.nanmax(radius)
    trunk = habit.trunk_ratio * similarity.scale * float(np.ptp(graph.xy[:, 1]))
    stem = float(np.clip(thickest, trunk, _STOUT * trunk))
    twig = min(float(thinnest), _THIN * stem)
    span = np.log(thickest / thinnest)
    return twig * (stem / twig) ** (np.log(radius / thinnest) / span) if span > 1e-9 else np.full(len(radius), np.nan)


def leaf_model(wanted: str | None, habit: Habit, templates: Database | None) -> str | None:
    """The leaf model to use; None for no leaves. `wanted` is a model, an exemplar or "none"."""
    if wanted is None:
        return habit.leaf
    if wanted == "none":
        return None
    if wanted in leaf_names():
        return wanted
    if templates is not None and wanted in templates.names:
        return templates.exemplar(wanted).habit.leaf
    raise OptionError(f"There is no leaf called “{wanted}”.", remedy=f"Choose none, a template's name or one of: {', '.join(leaf_names())}.")


def bark_model(wanted: str | None, habit: Habit) -> str:
    """The bark to use, the template's by default."""
    if wanted is not None and wanted not in bark_names():
        raise OptionError(f"There is no bark called “{wanted}”.", remedy=f"Choose one of: {', '.join(bark_names())}.")
    return wanted or habit.bark


def _propagated(drawn: DrawnTree, options: TreeOptions, key) -> tuple[TreeSkeleton, tuple[str, ...]]:
    """The complete skeleton with its final radii, and what the user should know about it."""
    stage = Propagate(
        drawn.habit,
        drawn.fit.theta,
        crown=tuple(drawn.similarity.to_world(outline) for outline in drawn.graph.crown),
        generations=options.generations,
        fill=options.fill,
        max_segments=options.max_segments,
        exemplar=drawn.exemplar.skeleton if drawn.exemplar else None,
    )
    grown = stage.run(drawn.skeleton, key=key)
    radius = np.full(len(grown.skeleton), np.nan)
    radius[grown.drawn_row] = drawn.radius
    return PipeRadii(drawn.habit, radius)(grown.skeleton, key=key), grown.warnings


@dataclass(frozen=True)
class SketchSource:
    """The built-in source: a sketch, or a path to one, becomes its drawn branches in 3D."""

    options: ReadingOptions = ReadingOptions()

    def __call__(self, input: Sketch | str | Path, *, key: Key[Array, ""]) -> TreeSkeleton:
        return draw_out(input, key=key, options=self.options).skeleton


def options_as_dict(*options) -> dict:
    """Options as used, for the report."""
    merged: dict = {}
    for record in options:
        merged |= dataclasses.asdict(record)
    return merged
