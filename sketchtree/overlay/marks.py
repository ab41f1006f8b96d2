"""What does an overlay show of a reading? Strokes faint, limbs in the colour of their order, junctions, bases, crown, doubts.

    grey line            a stroke as it was drawn
    coloured line        a limb as it was read, an arrow head on it pointing from foot to tip
    white disc           a junction            black disc    a base, where a stem meets the ground
    short red line       how far a foot was moved to its junction
    red ring, number     a doubt; a broken red line leads to the next best parent
"""

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.overlay.colours import DOUBT, DRAWN, ORDER, OTHER_ROLE, ROLE, ROOT
from sketchtree.overlay.doubts import Doubt, doubts
from sketchtree.overlay.scene import Disc, Path, Words
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch

THICK, THIN = 7.0, 2.2  # pixels: the widest and the narrowest limb drawn
ROOM, FINEST = 90.0, 0.45  # pixels of the picture's side for the root of the limbs' number, below which marks shrink, and how far
BRANCH_ROLES = frozenset({"crown", "obstacle", "ground"})  # shown by what the graph holds of them


class Placing:
    """From sketch units (y up) to pixels of the picture (y down)."""

    def __init__(self, low: Float[np.ndarray, " 2"], high: Float[np.ndarray, " 2"], left: float, top: float, scale: float):
        self.low, self.high, self.left, self.top, self.scale = low, high, left, top, scale

    def __call__(self, points) -> Float[np.ndarray, "point 2"]:
        points = np.atleast_2d(np.asarray(points, float))
        return np.stack([self.left + (points[:, 0] - self.low[0]) * self.scale, self.top + (self.high[1] - points[:, 1]) * self.scale], 1)


def reading_marks(sketch: Sketch, graph: SketchGraph, place: Placing, *, numbered: int = 0) -> list[Path | Disc | Words]:
    """Every mark of the picture, in the order of painting; the first doubts have a number, as many as are explained."""
    fine = _fineness(graph, place)
    return [
        *_page(sketch, place),
        *_areas(graph, place),
        *_drawn(sketch, graph, place),
        *_limbs(graph, place, fine),
        *_moved_feet(sketch, graph, place, fine),
        *_joints(graph, place, fine),
        *_cuts(graph, place),
        *_doubt_marks(sketch, graph, place, fine, numbered),
    ]


def _fineness(graph: SketchGraph, place: Placing) -> float:
    """How large marks are: 1, or smaller where many limbs share the picture."""
    points = place(np.concatenate([graph.xy, graph.curve_points]))
    room = float(np.ptp(points, axis=0).max()) / np.sqrt(len(graph.limb_id))
    return float(np.clip(room / ROOM, FINEST, 1.0))


def _page(sketch: Sketch, place: Placing) -> list[Path]:
    if sketch.page is None:
        return []
    left, bottom, right, top = sketch.page
    if left < place.low[0] or right > place.high[0] or bottom < place.low[1] or top > place.high[1]:
        return []
    corners = place([(left, bottom), (right, bottom), (right, top), (left, top)])
    return [Path(corners, "#bbbbbb", 1.0, closed=True, dash=6.0)]


def _areas(graph: SketchGraph, place: Placing) -> list[Path]:
    crowns = [Path(place(outline), ROLE["crown"], 2.5, closed=True, fill=ROLE["crown"]) for outline in graph.crown]
    obstacles = [Path(place(outline), ROLE["obstacle"], 2.5, closed=True, fill=ROLE["obstacle"]) for outline in graph.obstacles]
    ground = [Path(place(line), ROLE["ground"], 4.0, opacity=0.8) for line in graph.ground]
    return crowns + obstacles + ground


def _drawn(sketch: Sketch, graph: SketchGraph, place: Placing) -> list[Path]:
    role = {r.stroke: r.role for r in graph.roles}
    marks = []
    for stroke in sketch.strokes:
        colour = ROLE.get(role[stroke.id], OTHER_ROLE) if stroke.id in role and role[stroke.id] not in BRANCH_ROLES else DRAWN
        fill = colour if stroke.filled else None
        marks.append(Path(place(stroke.points), colour, 1.4, 0.9, closed=stroke.closed, fill=fill, fill_opacity=0.25))
    return marks


def _limbs(graph: SketchGraph, place: Placing, fine: float) -> list[Path]:
    """Limbs, the trunk last, so that it lies on top."""
    rows = np.flatnonzero(~graph.is_base)
    curves = {limb: [] for limb in graph.limb[rows].tolist()}
    for row in rows.tolist():
        curves[graph.limb[row]].append(graph.curve(row))
    order = graph.limb_order
    marks = []
    for limb in sorted(curves, key=lambda k: (-order[k], k)):
        points = place(np.concatenate(curves[limb]))
        below = bool(graph.root[graph.limb_first[limb]])
        colour = ROOT if below else ORDER[min(int(order[limb]), len(ORDER) - 1)]
        width = fine * float(np.clip(THICK * 0.72 ** int(order[limb]), THIN, THICK))
        marks.append(Path(points, colour, width, 0.85, dash=9.0 if below else None))
        marks += _arrow(points, colour, width)
    return marks


def _arrow(points: Float[np.ndarray, "point 2"], colour: str, width: float) -> list[Path]:
    """An arrow head two thirds of the way along; none on a short limb."""
    line = shapely.LineString(points)
    size = 3.0 + 1.6 * width
    if line.length < 4 * size:
        return []
    at, before = (np.array(line.interpolate(s).coords[0]) for s in (0.66 * line.length + size / 2, 0.66 * line.length - size / 2))
    along = (at - before) / max(float(np.hypot(*(at - before))), 1e-9)
    across = np.array([-along[1], along[0]]) * size * 0.55
    return [Path(np.array([before - across, before + across, before + along * size * 1.1]), None, closed=True, fill=colour, fill_opacity=1.0)]


def _moved_feet(sketch: Sketch, graph: SketchGraph, place: Placing, fine: float) -> list[Path]:
    """From the end of the stroke that was drawn nearest to its junction, to the junction."""
    strokes = {stroke.id: stroke for stroke in sketch.strokes}
    marks = []
    for a in graph.attachments:
        if a.parent is None or a.gap <= 1e-3 * graph.height or a.stroke not in strokes or strokes[a.stroke].filled:
            continue
        ends = strokes[a.stroke].points[[0, -1]]
        foot = ends[np.argmin(np.hypot(*(ends - a.point).T))]
        marks.append(Path(place([foot, a.point]), DOUBT, 2.0 * fine))
    return marks


def _joints(graph: SketchGraph, place: Placing, fine: float) -> list[Disc]:
    first = graph.limb_first
    joint = np.unique(graph.parent[first])
    joint = joint[~graph.is_base[joint]]
    marks = [Disc(x, y, 3.2 * fine, "#ffffff", "#333333", 1.3 * fine) for x, y in place(graph.xy[joint]).tolist()]
    marks += [Disc(x, y, 8.0, "#111111", "#ffffff", 2.0) for x, y in place(graph.xy[graph.is_base]).tolist()]
    return marks


def _cuts(graph: SketchGraph, place: Placing) -> list[Path]:
    """A bar along the page's edge where it cuts the tree."""
    marks = []
    for cut in graph.cuts:
        point = place(cut.point)[0]
        along = np.array([0.0, 9.0]) if cut.edge in ("left", "right") else np.array([9.0, 0.0])
        marks.append(Path(np.array([point - along, point + along]), DOUBT, 4.0))
    return marks


def _doubt_marks(sketch: Sketch, graph: SketchGraph, place: Placing, fine: float, numbered: int) -> list[Path | Disc | Words]:
    strokes = {stroke.id: stroke for stroke in sketch.strokes}
    marks: list[Path | Disc | Words] = []
    for number, doubt in enumerate(doubts(graph), 1):
        marks += _ways_out(doubt, strokes, place)
        for a in doubt.attachments:
            x, y = place(a.point if doubt.role is None else _middle(strokes[a.stroke].points))[0].tolist()
            marks.append(Disc(x, y, 8.5 * fine, None, DOUBT, 2.2 * fine))
            if number <= numbered:
                marks.append(Words(x + 10 * fine, y - 8 * fine, str(number), 14.0, DOUBT, bold=True, halo=True))
    return marks


def _ways_out(doubt: Doubt, strokes: dict, place: Placing) -> list[Path]:
    """A broken line from a doubtful junction to the next best parent."""
    if doubt.other not in strokes or len(strokes[doubt.other].points) < 2:
        return []
    (a,) = doubt.attachments
    line = shapely.LineString(strokes[doubt.other].points)
    near = line.interpolate(line.project(shapely.Point(a.point))).coords[0]
    return [Path(place([a.point, near]), DOUBT, 1.6, dash=4.0)]


def _middle(points: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, " 2"]:
    """The point half way along a stroke."""
    if len(points) < 2:
        return points[0]
    return np.array(shapely.LineString(points).interpolate(0.5, normalized=True).coords[0])
