"""Which strokes are the ground? Level lines at the foot of a stem, and what stands on them that is no stem.

A level line is the ground if a stem stands on it: the lower end of a stroke that rises from there through a good part of
the drawing. A limb fails: it starts higher up its stem. What lies on one side of the stem only must keep as low as
its foot, and the drawing may go on below the line only as roots do: less deep than the tree is tall, in several lines or painted.
One that is drawn in two pieces, on both sides of what passes through it, is the ground if what lies below is like roots, and less wide.
With a line found, the small things that stand on it away from every stem are grass.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import shapely
from jaxtyping import Bool, Float, Int

from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.measures import Measures

LONG = 0.15  # of the drawing's height: least width of a ground line
FLAT = 0.1  # of the drawing's height: how far it strays from its chord …
SLOPE = 0.3  # … and how steep that may be: a hillside
WINDING = 6.0  # most length of a line of grass, of its width
AT_FOOT = 0.05  # of the drawing's height: a stem ends this near to the line it stands on
DIPS = 0.3  # of its height: a stroke that dips as far below both ends stands on its lowest point
RISES = 0.25  # of the drawing's height: what goes up less from the line is no stem
BESIDE = 0.03  # of the drawing's height: a line that goes on this far on both sides of the foot passes under it
DEEP = 0.12  # of the drawing's height: what reaches deeper below the line must look like roots
DEEPEST = 0.75  # of the height above the line: nothing reaches as deep below it
ROOTS = 3  # lines below a ground in two pieces
TOGETHER = 0.2  # of the drawing's height: roots start no farther apart
TUFT = 0.1  # of the drawing's height: grass is smaller
APART = 0.015  # of the drawing's height: grass does not touch a stem
MIDDLE = 0.2  # of its width: a line that the tree passes through goes on this far on both sides
BROKEN = 0.12  # of the drawing's height: widest gap between two pieces of one line …
STRAIGHT = 0.04  # … and how far they stray from one height
RULED = 0.01  # of their width: farthest off one straight line, but for their ends
ACROSS = 0.6  # of the drawing's width: such a line is wider
AS_THICK = 0.6  # of a stem: a line whose own thickness was measured is thinner than that where it is the ground
BROAD = 1.2  # of the width of the rest: a wider painted area at the foot is ground, no shadow


@dataclass(frozen=True, eq=False)
class Stems:
    """Strokes that may stand on the ground."""

    row: Int[np.ndarray, " stem"]
    foot: Float[np.ndarray, "stem 2"]  # their lower end; their lowest point if they are closed, or dip below both ends
    top: Float[np.ndarray, " stem"]  # how high they reach


def stems(m: Measures, rows: Int[np.ndarray, " row"]) -> Stems:
    """These strokes with their feet."""
    foot = np.where((m.first[:, 1] <= m.last[:, 1])[:, None], m.first, m.last)[rows]
    dips = m.low[:, 1] < np.minimum(m.first[:, 1], m.last[:, 1]) - DIPS * (m.high - m.low)[:, 1]
    for k in np.flatnonzero((m.closed | dips)[rows]):
        points = m.strokes[rows[k]].points
        foot[k] = points[np.argmin(points[:, 1])]
    return Stems(rows, foot, m.high[rows, 1])


def ground_lines(m: Measures, free: Bool[np.ndarray, " stroke"], wood: Bool[np.ndarray, " stroke"]) -> list[Found]:
    """The level lines that a stem stands on. `free`: strokes not yet known; `wood`: strokes that may be stems."""
    height = _height(m, wood)
    flat = free & ~m.closed & (m.opening >= 0.5 * (m.high - m.low)[:, 0]) & _level(m, height)
    if not flat.any() or height <= 0:
        return []
    standing = stems(m, np.flatnonzero(wood & ~flat))
    found = []
    middle = 0.5 * (m.drawing[0][1] + m.drawing[1][1])
    for row in np.flatnonzero(flat & (m.low[:, 1] <= middle)):
        reason = _stood_on(m, int(row), standing, height)
        if reason:
            found.append(Found(int(row), "ground", reason, (("branch", 0.5),)))
    return found or _in_two_pieces(m, np.flatnonzero(flat), height)


def _in_two_pieces(m: Measures, rows: Int[np.ndarray, " row"], height: float) -> list[Found]:
    """The two level lines on both sides of a stem that goes on below them as roots."""
    side, level = m.high - m.low, 0.5 * (m.low + m.high)[:, 1]
    straight = rows[side[rows, 1] <= STRAIGHT * height]
    everything = m.drawing[1] - m.drawing[0]
    for a, b in combinations(straight[np.argsort(m.low[straight, 0], kind="stable")].tolist(), 2):
        gap, left, right = m.low[b, 0] - m.high[a, 0], m.low[a, 0], m.high[b, 0]
        if abs(level[a] - level[b]) > STRAIGHT * height or not -STRAIGHT * height <= gap <= BROKEN * height:
            continue
        below = np.flatnonzero((m.high[:, 1] <= min(m.low[a, 1], m.low[b, 1]) + STRAIGHT * height) & (m.size > STRAIGHT * height))
        below = below[(below != a) & (below != b)]
        if len(below) < ROOTS:
            continue
        deep = level[a] - m.low[below, 1].min() >= DEEP * height
        wider = m.low[below, 0].min() >= left and m.high[below, 0].max() <= right
        if deep and wider and right - left >= ACROSS * everything[0] and _in_line(m, a, b):
            reason = "one of two pieces of a level line that the tree passes through, roots below"
            return [Found(row, "ground", reason, (("branch", 0.5),)) for row in (a, b)]
    return []


def _in_line(m: Measures, a: int, b: int) -> bool:
    """Whether two strokes lie on one straight line, nearly all of them."""
    points = m.evenly[[a, b]].reshape(-1, 2)
    slope, level = np.polyfit(*points.T, 1)
    off = np.abs(points[:, 1] - slope * points[:, 0] - level)
    return bool(np.quantile(off, 0.85) <= RULED * np.ptp(points[:, 0]))


def grass(m: Measures, free: Bool[np.ndarray, " stroke"], lines: list[np.ndarray], wood: Bool[np.ndarray, " stroke"]) -> list[Found]:
    """The small strokes that stand on the ground lines away from every stem."""
    height = _height(m, wood)
    small = free & (m.size <= TUFT * height)
    if not lines or not small.any():
        return []
    ground = shapely.union_all([shapely.LineString(line) for line in lines])
    large = shapely.union_all([_shape(m, row) for row in np.flatnonzero(wood & (m.size > TUFT * height))])
    found = []
    upward = np.flatnonzero(small)[np.argsort(m.low[small, 1], kind="stable")]
    for row in upward.tolist():
        points = m.strokes[row].points
        lowest = shapely.Point(points[np.argmin(points[:, 1])])
        near = lowest.distance(ground) <= 0.5 * AT_FOOT * height or _shape(m, row).distance(ground) <= 0.2 * AT_FOOT * height
        near = near or any(_shape(m, row).distance(_shape(m, one.row)) <= 0.5 * AT_FOOT * height for one in found)
        if near and (m.filled[row] or _shape(m, row).distance(large) > APART * height):
            found.append(Found(int(row), "ground", "a small mark on the ground line, apart from every stem", () if m.filled[row] else (("branch", 0.5),)))
    return found


def level_at(lines: list[np.ndarray], x: Float[np.ndarray, " place"]) -> Float[np.ndarray, " place"]:
    """Height of the ground at each `x`: of the line below or above, else of the nearest end."""
    x = np.asarray(x, float)
    best, nearest = np.zeros(x.shape), np.full(x.shape, np.inf)
    for line in lines:
        line = line[np.argsort(line[:, 0], kind="stable")]
        off = np.maximum(np.maximum(line[0, 0] - x, x - line[-1, 0]), 0.0)
        best = np.where(off < nearest, np.interp(x, line[:, 0], line[:, 1]), best)
        nearest = np.minimum(off, nearest)
    return best


def _height(m: Measures, wood) -> float:
    """Height of what may be wood; of all there is, if that is more sensible."""
    rows = np.flatnonzero(wood) if wood.any() else np.arange(len(m))
    return float(m.high[rows, 1].max() - m.low[rows, 1].min())


def _level(m: Measures, height: float) -> Bool[np.ndarray, " stroke"]:
    """Strokes that run level and long."""
    width = m.high[:, 0] - m.low[:, 0]
    chord = m.last - m.first
    with np.errstate(invalid="ignore", divide="ignore"):
        slope = np.abs(chord[:, 1]) / np.abs(chord[:, 0])
    long = (width >= LONG * height) & (m.length <= WINDING * width) & (slope <= SLOPE)
    flat = np.zeros(len(m), bool)
    for row in np.flatnonzero(long & (m.high[:, 1] - m.low[:, 1] <= SLOPE * width + FLAT * height)):
        points = m.strokes[row].points
        off = points[:, 1] - np.interp(points[:, 0], *_by_x(m.first[row], m.last[row]))
        flat[row] = np.ptp(off) <= min(2 * FLAT * height, 0.25 * width[row])
    return flat


def _by_x(a, b):
    a, b = sorted((a.tolist(), b.tolist()))
    return (a[0], b[0]), (a[1], b[1])


def _stood_on(m: Measures, row: int, standing: Stems, height: float) -> str:
    """Why this level line is the ground; "" if it need not be."""
    line = m.strokes[row].points
    deep = float(np.median(line[:, 1]) - m.drawing[0][1])
    if deep > DEEPEST * float(m.drawing[1][1] - np.median(line[:, 1])):
        return ""
    shape = shapely.LineString(line)
    at = level_at([line], standing.foot[:, 0])
    rising = standing.top - at >= RISES * height
    over = (standing.foot[:, 0] >= m.low[row, 0] - AT_FOOT * height) & (standing.foot[:, 0] <= m.high[row, 0] + AT_FOOT * height)
    near = shapely.distance(shapely.points(standing.foot), shape) <= AT_FOOT * height if len(at) else np.zeros(0, bool)
    near |= over & (np.abs(standing.foot[:, 1] - at) <= AT_FOOT * height)
    feet = standing.foot[near & rising]
    if _as_thick(m, row, standing.row[near & rising]):
        return ""
    if len(feet) == 0:
        return "a level line that the tree passes through, roots below" if _rooted(m, row, height, deep) else ""
    passes = bool((feet[:, 0].min() - m.low[row, 0] >= BESIDE * height) and (m.high[row, 0] - feet[:, 0].max() >= BESIDE * height))
    keeps_low = bool(line[:, 1].max() <= feet[:, 1].max() + 0.02 * height)
    if deep > DEEP * height and not (passes and _in_middle(m, row, feet[:, 0]) and _rootlike(m, row, height)):
        return ""
    return "a level line that a stem stands on" if passes or keeps_low else ""


def _as_thick(m: Measures, row: int, on_it: Int[np.ndarray, " stem"]) -> bool:
    """Whether the thickness of a line was measured, and is that of a limb beside what stands on it."""
    stem = max((m.strokes[k].width or 0.0 for k in on_it), default=0.0)
    return bool(m.strokes[row].wood and stem and m.strokes[row].width >= AS_THICK * stem)


def _in_middle(m: Measures, row: int, x) -> bool:
    """Whether all of these abscissas, at least one, lie in the middle part of a line."""
    margin = MIDDLE * float(m.high[row, 0] - m.low[row, 0])
    return len(x) > 0 and bool((x >= m.low[row, 0] + margin).all() and (x <= m.high[row, 0] - margin).all())


def _rooted(m: Measures, row: int, height: float, deep: float) -> bool:
    """Whether a wide level line crosses a tree that goes on below it as roots do."""
    width = float(m.high[row, 0] - m.low[row, 0])
    line = m.strokes[row].points
    straight = float(np.ptp(line[:, 1])) <= FLAT * height
    everything = float(m.drawing[1][0] - m.drawing[0][0])
    level = float(np.median(line[:, 1]))
    others = np.flatnonzero((m.low[:, 1] < level - DEEP * height) & (m.high[:, 1] > level + DEEP * height) & (np.arange(len(m)) != row))
    crossings = shapely.get_coordinates(shapely.intersection(m.shapes(others), shapely.LineString([(m.low[row, 0], level), (m.high[row, 0], level)])))
    centred = _in_middle(m, row, crossings[:, 0]) or bool(m.filled[others].any())
    return straight and width >= 0.5 * everything and deep > DEEP * height and centred and _rootlike(m, row, height)


def _rootlike(m: Measures, row: int, height: float) -> bool:
    """Whether what lies below a line is painted, or several strokes that spread."""
    level = float(np.median(m.strokes[row].points[:, 1]))
    below = np.flatnonzero((m.low[:, 1] < level - 0.5 * DEEP * height) & (np.arange(len(m)) != row))
    painted = m.filled[below] & (m.high[below, 1] > level)
    wholly = below[(m.high[below, 1] <= level + AT_FOOT * height) & ~m.closed[below]]
    upper = np.where((m.first[:, 1] >= m.last[:, 1])[:, None], m.first, m.last)[wholly]
    lower = np.where((m.first[:, 1] >= m.last[:, 1])[:, None], m.last, m.first)[wholly]
    falls = upper[:, 1] - lower[:, 1] >= 0.25 * np.hypot(*(upper - lower).T)
    from_foot = falls & (np.abs(upper[:, 1] - level) <= 2 * AT_FOOT * height)
    if painted.any() or (from_foot.sum() >= 2 and np.ptp(upper[from_foot, 0]) <= TOGETHER * height):
        return True
    narrower = (m.low[below, 0] >= m.low[row, 0]).all() and (m.high[below, 0] <= m.high[row, 0]).all()
    passing = shapely.union_all(m.shapes(below[m.high[below, 1] > level + DEEP * height]))
    on_taproot = falls & (shapely.distance(shapely.points(upper), passing) <= AT_FOOT * height)
    return bool(narrower and on_taproot.sum() >= 2)


def _shape(m: Measures, row: int):
    points = m.strokes[row].points
    if m.filled[row] and len(points) > 2:
        return shapely.make_valid(shapely.Polygon(points))
    return shapely.LineString(points) if len(points) > 1 else shapely.Point(points[0])
