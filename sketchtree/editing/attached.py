"""How do strokes of turned pages, and limbs that were adopted, join the tree?

Front strokes come first: the whole tree of them is in space. Then, in the order they were drawn, each stroke of a turned page grows from the limb that one of its
ends is nearest to on that page; it keeps its course there, and only how far it goes towards that page's viewer is inferred, all else held. If what it
grows on is moved later, it moves along. Adopted limbs are in space already: they only have to be hung up.
"""

import dataclasses
from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.axes import NULL
from sketchtree.drawable import bends
from sketchtree.editing.edits import Adopted, Edits
from sketchtree.editing.laid_cloud import LaidCloud
from sketchtree.editing.part import part_of, reachable
from sketchtree.editing.rows import Drawing, nearest_place, on_other_page, place_at
from sketchtree.editing.seen import with_seen_from
from sketchtree.editing.settle import QUICK
from sketchtree.editing.settled import Depths, Settled, course_of
from sketchtree.editing.touched import SAME_COURSE, depth_at
from sketchtree.editing.turning import in_front, on_page
from sketchtree.keys import stage_key
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.prior import Prior
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Stroke, StrokeKind
from sketchtree.skeleton import Kind
from sketchtree.traverse import sum_from_root

_BEND = 0.012  # of the height: a node where a stroke bends more
_FAR = 0.12  # of the height: a stroke that starts farther from any limb is told of


@dataclass(frozen=True, eq=False)
class Attached:
    """A drawing with all that was attached to it."""

    drawing: Drawing
    settled: dict[int, Depths]  # of what was attached, by limb
    touched: frozenset[int]  # of them, those that were solved
    warnings: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Hanging:
    """What hanging up needs to know."""

    graph: SketchGraph  # of the front page
    prior: Prior
    solver: object
    edits: Edits
    settled: Settled
    axis: float
    key: Key[Array, ""]
    quick: bool = False
    cloud: LaidCloud | None = None


def attach_turned(drawing: Drawing, strokes: dict[int, Stroke], hanging: Hanging) -> Attached:
    """The drawing with the strokes of turned pages (`strokes`: number in the sketch → stroke), and with all adopted limbs."""
    settled: dict[int, Depths] = {}
    solved, told = set(), []
    for number, stroke in strokes.items():
        drawing, depths, fresh, far = _with_stroke(drawing, number, stroke, hanging)
        limb = stroke_limb_id(stroke.id)
        settled[limb] = depths
        solved |= {limb} if fresh else set()
        told += [f"Stroke {stroke.id} starts far from any limb on its page; it was joined to the nearest."] if far else []
    for limb, adopted in hanging.edits.adopted.items():
        hung = _with_adopted(drawing, adopted, settled, hanging)
        if hung is None:
            told.append("A limb that was kept by hand stood on a branch that is gone; it is left out until that comes back.")
            continue
        drawing, settled[limb] = hung
    return Attached(drawing, settled, frozenset(solved), tuple(dict.fromkeys(told)))


def is_turned(stroke: Stroke) -> bool:
    """Whether it is a branch of a turned page."""
    return stroke.view_deg % 360.0 != 0.0 and stroke.kind == StrokeKind.BRANCH and len(np.unique(stroke.points, axis=0)) > 1


def _with_stroke(drawing: Drawing, number: int, stroke: Stroke, hanging: Hanging):
    """(the drawing with one stroke more, what it settled to, whether it was solved, whether it starts far from any limb)."""
    view, axis = stroke.view_deg, hanging.axis
    page = on_other_page(drawing.tree, lambda point: on_page(point, view, axis))
    height = max(float(np.ptp(page.tip, axis=0).max()), 1e-300)
    end, place, gap = nearest_place(drawing.tree, stroke.points[[0, -1]], page)
    points = stroke.points[::-1] if end else stroke.points
    drawing, foot = drawing.with_node(place)
    start = on_page(drawing.tree.tip[foot], view, axis)
    points = _from_foot(points, start[:2], height)
    marks = np.r_[0, bends(points, _BEND * height), len(points) - 1]
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
    share = along[marks] / along[-1]
    limb, parent = stroke_limb_id(stroke.id), int(drawing.tree.limb[foot])
    before = hanging.settled.limbs.get(limb)
    course = course_of(points)
    fresh = before is None or before.rough or before.parent != parent or _runs_elsewhere(course, before.course, SAME_COURSE * height)
    if fresh:
        drawing_with = _joined(drawing, foot, points, marks, np.full(len(points), start[2]), limb, number, hanging, view)
        begin = None if before is None else depth_at(before, share) - before.depth[0]
        depth, sd = _solved(drawing_with, limb, foot, view, hanging, begin)
    else:
        depth, sd = depth_at(before, share) + start[2] - before.depth[0], np.interp(share, before.share, before.sd)
    depth = _with_held(hanging.edits, limb, share, depth, start[2])
    every = np.interp(along, along[marks], depth)
    drawing = _joined(drawing, foot, points, marks, every, limb, number, hanging, view)
    return drawing, Depths(share, depth, sd, course, parent, (stroke.id,), view), fresh, gap > _FAR * height


def _from_foot(points, foot, height: float):
    """The stroke's points from where it grows; its own first point goes if it is there already."""
    apart = np.linalg.norm(points - foot, axis=1)
    rest = points[np.flatnonzero(apart > 1e-6 * height)[0] :] if (apart > 1e-6 * height).any() else points[-1:] + 1e-3 * height
    points = np.concatenate([foot[None], rest])
    return points[np.r_[True, np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9 * height]]


def _runs_elsewhere(course, before, near: float) -> bool:
    """Whether a course is another, wherever it starts: it moves with what it grows on."""
    return bool(np.abs((course - course[0]) - (before - before[0])).max() > near)


def _joined(drawing: Drawing, foot: int, points, marks, depth, limb: int, number: int, hanging: Hanging, view: float) -> Drawing:
    """The drawing with a limb through these points of a page, at these depths."""
    front = in_front(np.column_stack([points, depth]), view, hanging.axis)
    curves = [front[a + 1 : b] for a, b in zip(marks[:-1], marks[1:], strict=True)]
    return drawing.with_limb(foot, front[marks[1:]], curves, limb, number)


def _solved(drawing: Drawing, limb: int, foot: int, view: float, hanging: Hanging, begin):
    """(depth at the foot and at every node of the limb, its sd), on its own page, all else held as well as that page allows. `begin`: how far the foot and the nodes
    went before, None if nothing is known."""
    ids = hanging.graph.stroke_ids
    turned = on_other_page(drawing.tree, lambda point: on_page(point, view, hanging.axis))
    turned = turned.select(turned.kind != Kind.ROOT)
    graph = Drawing(turned, drawing.source[: len(turned)]).graph(hanging.graph, ids).replace(crown=())
    factors = factor_graph(graph)
    free = factors.limb_id == limb
    part, rows = part_of(factors, free)
    stands = sum_from_root(graph.parent, np.where(graph.is_base, turned.tip[:, 2], 0.0))  # depth of each row's base
    z = reachable(factors, (turned.tip[:, 2] - stands) / factors.scale) * factors.scale
    locked = {k: float(z[row]) for k, row in enumerate(rows) if not free[factors.limb[row]] and not factors.is_base[row]}
    mine = np.flatnonzero(free[factors.limb[rows]] & ~factors.is_base[rows])
    k = int(np.flatnonzero(rows == foot)[0])
    start = None if begin is None or len(begin) != len(mine) + 1 else np.where(np.isin(np.arange(len(rows)), mine), np.nan, z[rows])
    if start is not None:
        start[mine] = z[foot] + begin[1:]
    base = float(turned.tip[np.flatnonzero(graph.is_base)[0], 2])
    seeing = with_seen_from(hanging.solver, hanging.cloud, graph, view, hanging.axis, base)
    solver = dataclasses.replace(seeing, start=start, locked=locked, **(QUICK if hanging.quick else {}))
    fit = infer(part, hanging.prior, solver, key=stage_key(hanging.key, f"turned {limb}"), throw=False)
    at = turned.tip[foot, 2]
    sd = fit.depth_sd[mine] if np.isfinite(fit.depth_sd[mine]).all() else np.zeros(len(mine))
    return np.r_[at, at + fit.depth[mine] - fit.depth[k]], np.r_[0.0, sd]


def _with_held(edits: Edits, limb: int, share, depth, foot: float):
    """Depths of nodes brought to where the limb is held; what lies between and beyond moves along."""
    held = edits.held.get(limb)
    if held is None:
        return depth
    places = np.r_[0.0, held.share[held.share > 1e-6]]
    off = np.r_[0.0, (held.depth - np.interp(held.share, share, depth))[held.share > 1e-6]]
    return depth + np.interp(share, places, off)


def _with_adopted(drawing: Drawing, adopted: Adopted, settled: dict[int, Depths], hanging: Hanging):
    """(the drawing with an adopted limb, what it is settled to); None where what it stood on is gone."""
    view = settled[adopted.parent].view_deg if adopted.parent in settled else 0.0
    page = on_other_page(drawing.tree, lambda point: on_page(point, view, hanging.axis))
    place = place_at(drawing.tree, adopted.parent, adopted.share, page)
    if place is None:
        return None
    drawing, foot = drawing.with_node(place)
    points = adopted.path + drawing.tree.tip[foot]
    height = max(float(np.ptp(drawing.tree.tip, axis=0).max()), 1e-300)
    marks = np.r_[0, bends(points, _BEND * height), len(points) - 1]
    curves = [points[a + 1 : b] for a, b in zip(marks[:-1], marks[1:], strict=True)]
    drawing = drawing.with_limb(foot, points[marks[1:]], curves, adopted.limb, NULL)
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1))]
    share = along / max(along[-1], 1e-300)
    return drawing, Depths(share, points[:, 2], np.zeros(len(points)), course_of(points[:, :2]), adopted.parent, ())


def sd_of_rows(drawing: Drawing, sd: Float[np.ndarray, " graph_row"], attached: dict[int, Depths]) -> Float[np.ndarray, " segment"]:
    """The sd of every row's depth, sketch units; rows of the graph have `sd`."""
    found = np.where(drawing.source != NULL, sd[drawing.source], np.nan)
    for limb, depths in attached.items():
        rows = np.flatnonzero((drawing.tree.limb == limb) & (drawing.source == NULL))
        if len(rows) and len(depths.sd) - 1 == len(rows):
            found[rows] = depths.sd[1:]
    return found
