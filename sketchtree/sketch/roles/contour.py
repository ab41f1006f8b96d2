"""Which part of a drawing is one contour around a crown? "Lollipops": a round outline on a trunk.

The outline may run on into the trunk's side, stay open where the trunk enters, or be drawn in two strokes. Of
every stroke (then of two that meet end to end, then of a chain from one foot of the trunk to the other) the part is sought
that is roundest once its opening is closed,

    4πA / (P + 2d)²      A area, P length of the part, d its opening

and it is the crown only if the whole drawing says so: it is large and high, has a trunk below its inner part, and
nothing drawn outside it rises above its opening. A limb fails: its neighbours stand beside it, and its parent at its end.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.sketch.strokes import Stroke

SAMPLES = 128  # points along a stroke at which it may be cut
MANY = 24  # strokes: fuller drawings are of branches
OPEN = 0.6  # widest opening, of the outline's larger side
FEW, SKIP = 6, 0.4  # strokes of a drawing in which a chain is looked for, and its one wide gap, of the drawing's size
CLOSED = 0.2  # the same where two strokes make it: two fronds from one trunk leave more
GATE = 0.45  # under a wider opening the trunk ends below the outline's middle: else it carries an arching limb
ROUND = 0.08  # least 4πA / (P + 2d)², lobes and all
SHARP = 0.25  # least 4πA / P² of its convex hull, times its share of the hull's area
LARGE = 0.35  # least size, of the drawing's
HIGH = 0.9  # of the drawing's height: its top is above
NEAR = 0.06  # of the drawing's size: a point no farther outside is inside
MEET = 0.1  # of the drawing's size: ends no farther apart than this meet
PIECE = 0.25  # of the opening: a stroke that closes it is as long
LEVEL = 0.3  # of its width: how much higher one end of an arc lies than the other; stems side by side are no outline
INNER = 0.15  # of its width: the trunk stands at least this far from either side
LEG = 0.12  # of the drawing's height: how far the trunk reaches below the outline, and its feet from the ground
TRIES, APART = 12, 6  # how many parts of a stroke are looked at, and how many points their ends differ
INSIDE = 0.95  # least part of what is drawn above the opening that lies inside


@dataclass(frozen=True, eq=False)
class Contour:
    """A crown's outline, and what is left of the strokes that drew it."""

    outline: Float[np.ndarray, "point 2"]
    legs: dict[int, tuple[Float[np.ndarray, "point 2"], ...]]  # by stroke; () where all of it is crown


def contour(strokes: list[Stroke]) -> Contour | None:
    """The crown of a drawing that is one contour on a trunk; None for any other."""
    if not strokes or len(strokes) > MANY or any(s.filled or s.labelled for s in strokes):
        return None
    points = [_ring(s) for s in strokes]
    drawn = [_evenly(p) if len(p) > 2 else p for p in points]
    size = float(np.ptp(np.concatenate(points), axis=0).max())
    ways = [((k,), drawn[k]) for k in range(len(points))]
    for rows in (ways, _pairs(drawn, size), _chains(drawn, size)):
        found = [c for way in rows if (c := _of_way(*way, drawn, size)) is not None]
        if found:
            return max(found, key=lambda c: shapely.Polygon(c.outline).convex_hull.area)
    return None


def lone_outline(strokes: list[Stroke]) -> Float[np.ndarray, "point 2"] | None:
    """The closed outline that one or two unlabelled lines draw, and nothing else; None for any other drawing."""
    if not 1 <= len(strokes) <= 2 or any(s.filled or s.labelled for s in strokes):
        return None
    drawn = [_evenly(_ring(s)) for s in strokes if len(s.points) > 2]
    size = float(np.ptp(np.concatenate([s.points for s in strokes]), axis=0).max())
    if len(drawn) < len(strokes):
        return None
    level = all(abs(line[0, 1] - line[-1, 1]) <= LEVEL * np.ptp(line[:, 0]) for line in drawn)
    ways = drawn if len(drawn) == 1 else [way for _, way in _pairs(drawn, size) if level]
    return next((way for way in ways if np.hypot(*(way[0] - way[-1])) <= MEET * size and _is_round(way)), None)


def _ring(stroke: Stroke) -> Float[np.ndarray, "point 2"]:
    return np.vstack([stroke.points, stroke.points[:1]]) if stroke.closed else stroke.points


def _pairs(drawn: list, size: float) -> list[tuple[tuple[int, int], Float[np.ndarray, "point 2"]]]:
    """Every two large strokes that meet end to end, as one."""
    large = [k for k, p in enumerate(drawn) if len(p) > 2 and np.ptp(p, axis=0).max() >= 0.5 * LARGE * size]
    found = []
    for a, b in combinations(large, 2):
        turns = [(p, q) for p in (drawn[a], drawn[a][::-1]) for q in (drawn[b], drawn[b][::-1])]
        gap, turn = min((float(np.hypot(*(p[-1] - q[0]))), k) for k, (p, q) in enumerate(turns))
        if gap <= MEET * size:
            found.append(((a, b), np.vstack(turns[turn])))
    return found


def _chains(drawn: list, size: float) -> list[tuple[tuple[int, ...], Float[np.ndarray, "point 2"]]]:
    """Three or more strokes end to end, both ends on the ground, of few strokes: one gap among them may be wide."""
    if not 3 <= len(drawn) <= FEW:
        return []
    ground = min(float(line[:, 1].min()) for line in drawn) + LEG * size
    found = []

    def extend(rows: tuple[int, ...], way, skipped: bool) -> None:
        if len(rows) >= 3 and way[-1, 1] <= ground and rows[0] < rows[-1]:
            found.append((rows, way))
        for k in range(len(drawn)):
            for line in (drawn[k], drawn[k][::-1]) if k not in rows else ():
                gap = float(np.hypot(*(line[0] - way[-1])))
                if gap <= MEET * size or (gap <= SKIP * size and not skipped and min(gap, way[-1, 1] - ground, line[0, 1] - ground) > 0):
                    extend((*rows, k), np.vstack([way, line]), skipped or gap > MEET * size)

    for k, line in enumerate(drawn):
        for turned in (line, line[::-1]):
            if turned[0, 1] <= ground:
                extend((k,), turned, False)
    return found


def _of_way(rows: tuple[int, ...], way, drawn: list, size: float) -> Contour | None:
    """The crown that these strokes, end to end, draw with some part of them."""
    if len(way) < 6 or not np.ptp(way, axis=0).max() > LARGE * size:
        return None
    ground = min(float(line[:, 1].min()) for line in drawn) + LEG * size
    others = [drawn[k] for k in range(len(drawn)) if k not in rows]
    for low, high in _roundest(way, size, ground, CLOSED if len(rows) == 2 else OPEN):
        outline, legs = way[low : high + 1], [leg for leg in (way[: low + 1], way[high:]) if len(leg) > 1]
        if len(rows) > 2 and len(legs) < 2:
            continue
        if _is_round(outline) and _crowns(outline, [*legs, *others], size):
            kept = {row: tuple(leg for leg in of_row if np.ptp(leg, axis=0).max() > 0.5 * NEAR * size) for row, of_row in _by_row(rows, legs).items()}
            closing = _closing(outline, {k: drawn[k] for k in range(len(drawn)) if k not in rows}, size)
            outline = np.vstack([outline, *closing.values()])
            return Contour(outline, kept | {row: () for row in closing})
    return None


def _by_row(rows: tuple[int, ...], legs: list) -> dict[int, list]:
    """The legs by the strokes that drew them: those of a chain belong to its first and last."""
    if len(rows) < 3:
        return {rows[0]: legs} | {row: [] for row in rows[1:]}
    return {row: [] for row in rows} | {rows[0]: legs[:1], rows[-1]: legs[1:]}


def _closing(outline, others: dict[int, Float[np.ndarray, "point 2"]], size: float) -> dict[int, Float[np.ndarray, "point 2"]]:
    """The strokes that close the outline's opening: both their ends lie on it, one after the other. In order, from its end to its start."""
    begin, end = outline[-1], outline[0]
    gap = float(np.hypot(*(end - begin)))
    if gap < MEET * size:
        return {}
    way = (end - begin) / gap
    found = []
    for row, points in others.items():
        s, off = (points - begin) @ way, np.abs((points - begin) @ np.array([-way[1], way[0]]))
        points, s, off = (points, s, off) if s[0] <= s[-1] else (points[::-1], s[::-1], off[::-1])
        if off[[0, -1]].max() <= MEET * size and s[0] > -MEET * size and s[-1] < gap + MEET * size and s[-1] - s[0] >= max(PIECE * gap, 2 * off.max()):
            found.append((float(s[0]), float(s[-1]), row, points))
    found.sort(key=lambda piece: piece[:2])
    apart = [piece for k, piece in enumerate(found) if k == 0 or piece[0] >= found[k - 1][1] - MEET * size]
    return {row: points for _, _, row, points in apart}


def _roundest(way: Float[np.ndarray, "point 2"], size: float, ground: float, widest: float) -> tuple[tuple[int, int], ...]:
    """First and last point of the large, nearly closed parts that are roundest once closed, the roundest first.

    What is cut off must be a leg of the trunk: it reaches below `ground`."""
    return _roundest_of(np.ascontiguousarray(way, np.float64).tobytes(), size, ground, widest)


@lru_cache(maxsize=4096)  # while somebody draws, nearly all strokes are those of the last reading
def _roundest_of(line: bytes, size: float, ground: float, widest: float) -> tuple[tuple[int, int], ...]:
    way = np.frombuffer(line, np.float64).reshape(-1, 2)
    n, found = len(way), []
    x, y = way.T
    before = np.minimum.accumulate(y) <= ground
    after = np.minimum.accumulate(y[::-1])[::-1] <= ground
    before[0] = after[-1] = True
    rows = np.flatnonzero(before)  # few: most lines are on the ground at one end, if at all
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(way, axis=0).T))]
    moment = np.r_[0.0, np.cumsum(way[:-1, 0] * way[1:, 1] - way[:-1, 1] * way[1:, 0])]
    area = 0.5 * np.abs(moment[None] - moment[rows, None] + x[None] * y[rows, None] - y[None] * x[rows, None])
    opening = np.hypot(x[None] - x[rows, None], y[None] - y[rows, None])
    inside = np.arange(n)[None] >= rows[:, None]
    side = np.max([_running_extent(axis, inside) for axis in (x, y)], axis=0)
    around = np.where(inside, s[None] - s[rows, None] + 2 * opening, np.inf)
    round_as = 4 * np.pi * area / np.maximum(around, 1e-9 * size) ** 2
    allowed = inside & after[None] & (side >= LARGE * size) & (opening <= widest * side)
    score = np.full((n, n), -np.inf)
    score[rows] = np.where(allowed & (round_as >= ROUND), round_as, -np.inf)
    for _ in range(TRIES):
        low, high = (int(k) for k in np.unravel_index(np.argmax(score), score.shape))
        if not np.isfinite(score[low, high]):
            break
        found.append((low, high))
        score[max(low - APART, 0) : low + APART + 1, max(high - APART, 0) : high + APART + 1] = -np.inf
    return tuple(found)


def _running_extent(value: Float[np.ndarray, " point"], inside) -> Float[np.ndarray, "start point"]:
    """Of every part from some i to j, how far its coordinate ranges."""
    upper = np.maximum.accumulate(np.where(inside, value[None], -np.inf), axis=1)
    lower = np.minimum.accumulate(np.where(inside, value[None], np.inf), axis=1)
    return np.where(inside, upper - lower, 0.0)


def _is_round(points: Float[np.ndarray, "point 2"]) -> bool:
    hull = shapely.convex_hull(shapely.MultiPoint(points))
    if hull.area <= 0:
        return False
    filled = shapely.make_valid(shapely.Polygon(points)).area / hull.area
    return 4 * np.pi * hull.area / hull.length**2 * filled >= SHARP


def _crowns(outline, rest: list, size: float) -> bool:
    """Whether the rest of the drawing stands under this outline or lies in it."""
    if not rest:
        return False
    points = np.concatenate([_evenly(line) for line in rest])
    weight = np.repeat([_length(line) for line in rest], SAMPLES)
    low, high = outline.min(0), outline.max(0)
    bottom, top = min(points[:, 1].min(), low[1]), max(points[:, 1].max(), high[1])
    if high[1] < bottom + HIGH * (top - bottom) or low[1] - bottom < LEG * (top - bottom):
        return False
    region = shapely.make_valid(shapely.Polygon(outline)).buffer(NEAR * size)
    opening = max(outline[0, 1], outline[-1, 1])
    beside = (points[:, 0] < low[0] - NEAR * size) | (points[:, 0] > high[0] + NEAR * size)
    aloft = (points[:, 1] > opening + NEAR * size) | (beside & (points[:, 1] > low[1]))
    if aloft.any() and weight[aloft][shapely.contains_xy(region, points[aloft])].sum() < INSIDE * weight[aloft].sum():
        return False
    below = points[(points[:, 1] <= low[1]) & (points[:, 1] >= low[1] - LEG * (top - bottom))]
    if len(below) == 0:
        return False
    side, gap = float((high - low).max()), float(np.hypot(*(outline[0] - outline[-1])))
    if gap > GATE * side and any(line[:, 1].max() > 0.5 * (low + high)[1] for line in rest if line[:, 1].min() < low[1]):
        return False
    margin = INNER * (high[0] - low[0])
    return bool(low[0] + margin <= below[:, 0].mean() <= high[0] - margin)


def _evenly(points: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, "point 2"]:
    """SAMPLES points along the same line."""
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    at = np.linspace(0.0, s[-1], SAMPLES)
    return np.stack([np.interp(at, s, points[:, axis]) for axis in (0, 1)], 1)


def _length(points: Float[np.ndarray, "point 2"]) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())

