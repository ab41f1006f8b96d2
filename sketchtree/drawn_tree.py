"""Strokes in, the drawn branches in space out: reading, template, depths.

    strokes → sketch graph → template → depths (what was done by hand kept) → strokes of turned pages, adopted limbs → skeleton
"""

import dataclasses
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.axes import NULL
from sketchtree.choose import choose_template
from sketchtree.drawing import read_drawing, read_hand_work
from sketchtree.editing.attached import Hanging, attach_turned, is_turned, sd_of_rows
from sketchtree.editing.edits import Edits
from sketchtree.editing.laid_cloud import LaidCloud
from sketchtree.editing.limbs import LimbLines
from sketchtree.editing.rows import Drawing
from sketchtree.editing.seen import with_seen
from sketchtree.editing.settle import Settling, settle
from sketchtree.editing.settled import MEASURED, Depths, Manner, Settled
from sketchtree.errors import InferenceError
from sketchtree.geometry.radii import PipeRadii
from sketchtree.keys import stage_key
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import Fit
from sketchtree.mrf.lift import lift
from sketchtree.mrf.methods import solver_named
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.solver import RESULTS, AbstractSolver
from sketchtree.options import ReadingOptions
from sketchtree.page import drawn_radius, page_to_world
from sketchtree.parameters import GENERIC, Habit, TreeParameters
from sketchtree.roots import root_depth, without_roots
from sketchtree.similarity import Similarity
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch
from sketchtree.propagate.blocks.block import blocks_of
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.exemplar import Exemplar
from sketchtree.templates.matching.match import Match
from sketchtree.templates.store.database import Database
from sketchtree.watch import Watch

_ANOTHER = 0.15  # the manner of growing is measured anew when so many limbs, of those there were, came or went
_TRUNKS = (0.001, 0.2)  # radius at the foot / height, of any tree
_LARGER = 0.02  # or when the tree's scale changed by so much


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
    edits: Edits = Edits()  # what was done by hand
    settled: Settled = Settled()  # what the depths have come to
    touched: frozenset[int] = frozenset()  # ids of the limbs that were solved
    remarks: tuple[str, ...] = ()  # what could not be done as asked by hand
    cloud: LaidCloud | None = None  # points behind the drawing, which said how deep it lies

    @property
    def crown(self) -> tuple[Float[np.ndarray, "point 2"], ...]:
        """The drawn crown's outlines, world metres."""
        return tuple(self.similarity.to_world(outline) for outline in self.graph.crown)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the user should know about the reading and the depths."""
        unsettled = () if self.fit.result == RESULTS.converged else (str(RESULTS[self.fit.result]),)
        return self.graph.warnings + unsettled + self.fit.warnings + self.remarks


def draw_out(
    sketch: Sketch | str | Path,
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    options: ReadingOptions = ReadingOptions(),
    edits: Edits | None = None,
    settled: Settled | None = None,
    cloud: LaidCloud | None = None,
    similarity: Similarity | None = None,
    quick: bool = False,
    watch: Watch | None = None,
) -> DrawnTree:
    """Strokes → sketch graph → template → depths: the drawn branches in 3D (§5, §7).

    A project file brings what was done to its tree by hand, and the cloud behind it; `edits`, `settled` and `cloud` say so otherwise. What is settled already is not solved again. `quick`: the
    shortest run that finds a side for what was touched, in the scale of `similarity` if given."""
    watch = watch or Watch()
    with watch("read"):
        by_hand = read_hand_work(sketch) if edits is None or settled is None else None  # of a project file
        edits, settled = by_hand.edits if edits is None else edits, by_hand.settled if settled is None else settled
        cloud = by_hand.cloud if cloud is None and by_hand is not None else cloud
        sketch, graph = read_drawing(sketch, options, watch)
    return draw_out_graph(sketch, graph, templates, key=key, options=options, edits=edits, settled=settled, cloud=cloud, similarity=similarity, quick=quick, watch=watch)


def draw_out_graph(
    sketch: Sketch,
    graph: SketchGraph,
    templates: Database | None = None,
    *,
    key: Key[Array, ""],
    options: ReadingOptions = ReadingOptions(),
    edits: Edits = Edits(),
    settled: Settled = Settled(),
    cloud: LaidCloud | None = None,
    similarity: Similarity | None = None,
    quick: bool = False,
    watch: Watch | None = None,
) -> DrawnTree:
    """The same of a segment tree that is known already, of a photo for one: template → depths. `sketch` are its limbs as strokes."""
    watch = watch or Watch()
    asked = _Asked(options, stage_key(key, "infer"), edits, settled, quick, cloud)
    with watch("match"):
        templates = templates if templates is not None or options.template == "none" else Database.open()
        matches, exemplar = _template(graph, templates, asked)
    with watch("infer"):
        return _in_space(sketch, graph, matches, exemplar, asked, similarity, stage_key(key, "radii"))


@dataclass(frozen=True, eq=False)
class _Asked:
    """How the drawn branches are wanted."""

    options: ReadingOptions
    key: Key[Array, ""]  # of the stage
    edits: Edits
    settled: Settled
    quick: bool
    cloud: LaidCloud | None = None

    def of_depths(self, exemplar: Exemplar | None) -> str:
        """All that bears on depths beside the drawing: with others, every limb is solved again."""
        seen = "" if self.cloud is None else f" {self.cloud.digest} {self.cloud.place}"
        return f"{self.options.method} {self.options.theta} {self.options.planar} {exemplar.name if exemplar else 'none'}{seen}"

    @property
    def unheard(self) -> tuple[str, ...]:
        """What the user should know where the points behind the drawing say nothing."""
        if self.cloud is None or self.options.method == "elevation":
            return ()
        return (f"The method `{self.options.method}` does not hear of the points behind the drawing; `elevation` does.",)

    def scale(self, graph: SketchGraph, habit: Habit) -> Similarity:
        """From the page to metres: as high as is said, else as the cloud behind it is, else as such a tree is."""
        if self.cloud is None or self.options.height is not None:
            return page_to_world(graph, self.options.height or habit.height)
        metres = 1.0 / self.cloud.unit
        x, y = graph.xy[np.flatnonzero(graph.is_base)[0]]
        return Similarity(metres, (float(-metres * x), float(-metres * y), 0.0))

    def habit(self, graph: SketchGraph, habit: Habit) -> Habit:
        """The species', with a trunk as thick as the cloud behind the drawing has it."""
        tall = float(np.ptp(graph.xy[:, 1]))
        if self.cloud is None or not self.cloud.trunk or tall <= 0:
            return habit
        return dataclasses.replace(habit, trunk_ratio=float(np.clip(self.cloud.trunk * self.cloud.unit / tall, *_TRUNKS)))


def _template(graph: SketchGraph, templates: Database | None, asked: _Asked) -> tuple[list[Match], Exemplar | None]:
    """All templates ranked, and the one to use. In a hurry the one in use stays."""
    hurried = asked.quick and asked.settled.template and asked.options.template == "auto"
    wanted = asked.settled.template if hurried else asked.options.template
    return choose_template(graph.above_ground(), templates, wanted, before=asked.settled.template, rank=not asked.quick)


def _in_space(sketch, graph: SketchGraph, matches, exemplar, asked: _Asked, similarity: Similarity | None, radii_key) -> DrawnTree:
    """Depths, what hangs on turned pages and what was adopted, and the scale: a skeleton."""
    above, options = graph.above_ground(), asked.options
    habit = asked.habit(above, exemplar.habit if exemplar else Habit())
    prior = Prior(exemplar.theta, exemplar.limbs) if exemplar else Prior(GENERIC)
    solver, settling = _settled(above, prior, asked, exemplar)
    similarity = similarity or asked.scale(above, habit)
    radius = np.full(len(graph), np.nan)
    radius[~graph.root] = drawn_radius(sketch, above, similarity, habit)
    front = _Front(graph, _with_roots(settling.fit, graph), radius, _settled_limbs(above, settling.fit), settling.touched, (*settling.warnings, *asked.unheard))
    axis = float(above.xy[np.flatnonzero(above.is_base)[0], 0])
    hanging = Hanging(graph, prior, solver, asked.edits, asked.settled, axis, asked.key, asked.quick, asked.cloud)
    front, tree = _with_attached(front, sketch, hanging)
    skeleton = PipeRadii(habit, front.radius)(_in_world(tree, similarity, front.fit.depth_sd), key=radii_key)
    now = _as_settled(front, asked, exemplar, axis, skeleton, similarity.scale)
    held = options.theta == "fixed"
    theta = front.fit.theta_before if held else now.manner.theta
    return DrawnTree(
        front.graph, matches, exemplar, front.fit, similarity, skeleton, front.radius, habit, held, theta, sketch, asked.edits, now, front.touched, front.remarks, asked.cloud
    )


def _settled(above: SketchGraph, prior: Prior, asked: _Asked, exemplar: Exemplar | None) -> tuple[AbstractSolver, Settling]:
    """(what solves, the depths of the front page). Raises InferenceError."""
    options, factors = asked.options, factor_graph(above)
    solver = solver_named(options.method, theta=options.theta, planar=options.planar)
    solver = solver.with_samples(options.samples, factors) if options.samples else solver
    open_all = bool(len(asked.settled)) and asked.settled.asked not in (MEASURED, asked.of_depths(exemplar))
    settling = settle(
        above, factors, prior, with_seen(solver, asked.cloud, above), edits=asked.edits, settled=asked.settled, key=asked.key, quick=asked.quick, alternatives=options.alternatives, open_all=open_all
    )
    if settling.fit.result == RESULTS.not_finite:
        raise InferenceError(f"The depths could not be inferred by `{options.method}`.", remedy=str(RESULTS[settling.fit.result]))
    return solver, settling


@dataclass(frozen=True, eq=False)
class _Front:
    """What is known of the drawn limbs, row by row of the graph, and limb by limb."""

    graph: SketchGraph
    fit: Fit
    radius: Float[np.ndarray, " segment"]  # metres
    limbs: dict[int, Depths]
    touched: frozenset[int]
    remarks: tuple[str, ...]


def _with_attached(front: _Front, sketch: Sketch, hanging: Hanging) -> tuple[_Front, TreeSkeleton]:
    """(the same with the strokes of turned pages and with adopted limbs, its tree in sketch units)."""
    tree = lift(front.graph, front.fit.depth, Similarity(1.0, (0.0, 0.0, 0.0)), depth_sd=front.fit.depth_sd)
    strokes = {number: stroke for number, stroke in enumerate(sketch.strokes) if is_turned(stroke)}
    if not strokes and not hanging.edits.adopted:
        return front, tree
    attached = attach_turned(Drawing(tree, np.arange(len(front.graph))), strokes, hanging)
    drawing, known = attached.drawing, attached.drawing.source != NULL
    whole = _Front(
        drawing.graph(front.graph, front.graph.stroke_ids),
        _of_rows(front.fit, drawing, sd_of_rows(drawing, front.fit.depth_sd, attached.settled)),
        np.where(known, front.radius[drawing.source], np.nan),
        front.limbs | attached.settled,
        front.touched | attached.touched,
        (*front.remarks, *attached.warnings),
    )
    return whole, drawing.tree


def _settled_limbs(graph: SketchGraph, fit: Fit) -> dict:
    lines = LimbLines.of(graph)
    return {line.limb: line.depths(graph, fit.depth, fit.depth_sd, graph.stroke_ids) for line in lines.lines}


def _as_settled(front: _Front, asked: _Asked, exemplar: Exemplar | None, axis: float, skeleton: TreeSkeleton, scale: float) -> Settled:
    """What is settled now. The manner of growing stays what it was while the drawing is about as large and the question the same: one stroke more leaves what grew
    elsewhere alone."""
    before, bears, limbs = asked.settled.manner, asked.of_depths(exemplar), frozenset(front.limbs)
    same = before is not None and asked.settled.asked == bears and len(limbs ^ before.limbs) <= _ANOTHER * len(before.limbs)
    if not same or abs(scale / before.scale - 1.0) > _LARGER:
        above, _ = without_roots(skeleton)
        alone = len(np.unique(above.tree)) == 1
        before = Manner(front.fit.theta, blocks_of(above) if alone else None, limbs, scale)
    limbs = {limb: dataclasses.replace(one, rough=asked.quick and limb in front.touched) for limb, one in front.limbs.items()}
    return Settled(limbs, exemplar.name if exemplar else None, bears, before, axis)


def _with_roots(fit: Fit, graph: SketchGraph) -> Fit:
    """The fit with a row for every drawn root too (they stand last in the graph)."""
    if not graph.root.any():
        return fit
    depth, sd = root_depth(graph), np.full(len(graph), np.nan)
    depth[~graph.root], sd[~graph.root] = fit.depth, fit.depth_sd
    others = tuple(reading._replace(depth=np.r_[reading.depth, depth[graph.root]]) for reading in fit.alternatives)
    return dataclasses.replace(fit, depth=depth, depth_sd=sd, alternatives=others)


def _of_rows(fit: Fit, drawing: Drawing, sd) -> Fit:
    """The fit with a row for every row of a drawing that has more; its posterior and other readings are those of the front page and are left out."""
    place = np.flatnonzero(drawing.source != NULL)
    row = np.zeros(drawing.source.max() + 1, np.int64)
    row[drawing.source[place]] = place
    return dataclasses.replace(fit, depth=np.array(drawing.tree.tip[:, 2]), depth_sd=sd, posterior=None, alternatives=(), wanted=0, overlaps=row[fit.overlaps])


def _in_world(tree: TreeSkeleton, similarity: Similarity, sd) -> TreeSkeleton:
    """A skeleton in sketch units as one in metres."""
    return tree.replace(
        tip=similarity.to_world(tree.tip), radius=tree.radius * similarity.scale, depth_sd=np.asarray(sd) * similarity.scale,
        curve_points=similarity.to_world(tree.curve_points),
    )  # fmt: skip


@dataclass(frozen=True)
class SketchSource:
    """The built-in source: a sketch, or a path to one, becomes its drawn branches in 3D."""

    options: ReadingOptions = ReadingOptions()

    def __call__(self, input: Sketch | str | Path, *, key: Key[Array, ""]) -> TreeSkeleton:
        return draw_out(input, key=key, options=self.options).skeleton
