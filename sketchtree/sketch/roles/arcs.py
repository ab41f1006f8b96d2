"""Do several arcs together draw a crown? Lobes and bows, end to end or overlapping, around the branches.

Seen from the middle of the crown an arc of its outline lies outermost in its directions, and runs across them: its
length is little more than the angle it covers times its distance. Arcs are the outline if together they cover
nearly all directions (more may be open below, where the trunk comes in), the gaps are short beside them, and their ends do
not sit on branches: twigs at the tips of a tree lie outermost, too, but their feet do.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Bool, Float, Int

from sketchtree.sketch.roles.measures import Measures

STEPS = 24  # even steps along every stroke
BINS = 72  # directions
OUTER = 0.72  # of the greatest distance in its direction: farther out is outermost …
MOST = 0.8  # … for at least this part of an arc
ACROSS = 0.45  # least angle that an arc covers, times its middle distance, of its length
BOWED = 0.5  # radians that an arc turns at least
FILLS = 0.1  # of the drawing's size: a flatter stroke is an arc if both its ends are this near to those of two bowed ones
SPAN = np.radians(20)  # least angle of an arc
LARGE = 0.3  # least size of the crown, of the drawing's
HIGH = 0.85  # of the drawing's height: the crown's top is above
FEWEST, MANY = 2, 40  # arcs
OPEN, OPEN_BELOW = np.radians(50), np.radians(110)  # widest gap, and where it looks downward
COVERED = 0.7  # least part of all directions
ON_BRANCH = 0.012  # of the drawing's size: an end this near to the inner part of another stroke sits on it
SEATED = 0.3  # greatest part of the arcs' ends that do
INSIDE = 0.85  # least part of the rest above the crown's foot that lies inside
NEAR = 0.05  # of the drawing's size: a point no farther outside is inside
ROUNDS = 3
STANDS = 0.1  # of the drawing's height: a trunk reaches farther down


@dataclass(frozen=True, eq=False)
class Arcs:
    """The strokes that draw an outline together."""

    rows: Int[np.ndarray, " arc"]
    outline: Float[np.ndarray, "point 2"]


def crown_of_arcs(m: Measures, free: Bool[np.ndarray, " stroke"], wood: Bool[np.ndarray, " stroke"]) -> Arcs | None:
    """The crown that some of the strokes `free` draw together around the tips of the `wood`; None if they do not."""
    rows = np.flatnonzero(wood & ~m.filled & (m.size > 0))
    if len(rows) < FEWEST:
        return None
    low, high = m.low[rows].min(0), m.high[rows].max(0)
    size = float((high - low).max())
    bowed = free & (m.turning >= BOWED)
    if bowed.sum() < FEWEST:
        return None
    may_be = bowed[rows] & (m.size[rows] >= 0.04 * size) & (m.size[rows] <= 0.9 * size)
    points = m.resampled(rows, STEPS)
    centre = np.array([0.5 * (low[0] + high[0]), 0.4 * low[1] + 0.6 * high[1]])
    found = []
    ground = low[1] + STANDS * (high[1] - low[1])
    stems = (m.low[rows, 1] <= ground) & (m.turning[rows] < BOWED)
    for foot in (ground,) if stems.any() else (ground, -np.inf):  # on a trunk, or a bush
        chosen, middle = _chosen(points, may_be, centre, foot, m.length[rows])
        flat = _between(m, rows, chosen, size) & free[rows] & (m.size[rows] >= 0.04 * size)
        if flat.any():
            chosen |= flat & _outermost(points, middle, foot, m.length[rows])
        if FEWEST <= chosen.sum() <= MANY:
            found.append(_checked(m, rows[chosen], rows[~chosen], points[chosen], points[~chosen], middle, size))
    return max((arcs for arcs in found if arcs is not None), key=lambda arcs: len(arcs.rows), default=None)


def _between(m: Measures, rows, chosen: Bool[np.ndarray, " stroke"], size: float) -> Bool[np.ndarray, " stroke"]:
    """Strokes that lead from the end of one chosen arc to that of another: flat pieces of an outline."""
    if chosen.sum() < FEWEST:
        return np.zeros(len(rows), bool)
    ends = np.stack([m.first[rows], m.last[rows]], 1)
    apart = np.hypot(*np.moveaxis(ends[:, :, None] - ends[chosen].reshape(-1, 2), -1, 0))
    near = apart.min(-1) <= FILLS * size
    return ~chosen & near.all(1) & (apart.argmin(-1)[:, 0] != apart.argmin(-1)[:, 1])


def _chosen(points, may_be, centre, ground: float, length) -> tuple[Bool[np.ndarray, " stroke"], Float[np.ndarray, " 2"]]:
    """(the strokes that lie outermost, seen from their own middle; that middle)."""
    chosen = np.zeros(len(points), bool)
    for _ in range(ROUNDS):
        chosen = may_be & _outermost(points, centre, ground, length)
        if not chosen.any():
            break
        inner = points[chosen].reshape(-1, 2)
        centre = 0.5 * (inner.min(0) + inner.max(0))
    return chosen, centre


def _outermost(points, centre, ground: float, length) -> Bool[np.ndarray, " stroke"]:
    """Strokes that lie outermost in their directions, and run across these."""
    offset = points - centre
    distance = np.hypot(offset[..., 0], offset[..., 1])
    angle = np.arctan2(offset[..., 1], offset[..., 0])
    bins = np.floor((angle + np.pi) / (2 * np.pi) * BINS).astype(int) % BINS
    aloft = points[..., 1].min(1) > ground  # a trunk reaches farther down than the crown
    farthest = np.zeros(BINS)
    np.maximum.at(farthest, bins[aloft].ravel(), distance[aloft].ravel())
    farthest = np.maximum(farthest, np.maximum(np.roll(farthest, 1), np.roll(farthest, -1)))
    outer = (distance >= OUTER * farthest[bins]).mean(1) >= MOST
    turned = _turned(angle)
    return outer & aloft & (np.ptp(turned, axis=1) >= SPAN) & (np.ptp(turned, axis=1) * np.median(distance, axis=1) >= ACROSS * length)


def _turned(angle) -> Float[np.ndarray, "stroke step"]:
    """Angles along strokes without jumps of a full turn."""
    step = (np.diff(angle, axis=1) + np.pi) % (2 * np.pi) - np.pi
    return np.concatenate([angle[:, :1], angle[:, :1] + np.cumsum(step, axis=1)], axis=1)


def _checked(m: Measures, rows, others, points, rest_points, centre, size: float) -> Arcs | None:
    """The arcs as an outline, if they close, hold the rest, and do not grow on it."""
    offset = points - centre
    angle = _turned(np.arctan2(offset[..., 1], offset[..., 0]))
    if not _closes(angle) or _seated(m, rows, rest_points, size) > SEATED:
        return None
    outline = _outline(points, angle)
    low, high = m.drawing
    if np.ptp(outline, axis=0).max() < LARGE * size or outline[:, 1].max() < low[1] + HIGH * (high[1] - low[1]):
        return None
    region = shapely.make_valid(shapely.Polygon(outline)).buffer(NEAR * size)
    rest = shapely.union_all(m.shapes(others))
    aloft = rest.intersection(shapely.box(low[0] - size, outline[:, 1].min() + 0.1 * np.ptp(outline[:, 1]), high[0] + size, high[1] + size))
    if aloft.length > 0 and aloft.intersection(region).length < INSIDE * aloft.length:
        return None
    return Arcs(rows, outline)


def _closes(angle) -> bool:
    """Whether the arcs cover nearly all directions, without a wide gap."""
    covered = np.zeros(BINS, bool)
    for row in angle:
        low, high = (np.array([row.min(), row.max()]) / (2 * np.pi) * BINS).tolist()
        covered[np.arange(int(np.floor(low)), int(np.floor(high)) + 1) % BINS] = True
    if covered.mean() < COVERED:
        return False
    start = int(np.argmax(covered))
    runs = np.flatnonzero(np.diff(np.r_[1, np.roll(covered, -start).astype(int), 1]))
    for begin, end in zip(runs[::2], runs[1::2], strict=True):
        middle = (start + 0.5 * (begin + end)) / BINS * 2 * np.pi
        widest = OPEN_BELOW if np.sin(middle) < -0.5 else OPEN
        if (end - begin) / BINS * 2 * np.pi > widest:
            return False
    return True


def _seated(m: Measures, rows, others: Float[np.ndarray, "stroke step 2"], size: float) -> float:
    """Part of the arcs' ends that sit on other strokes, away from these strokes' own ends."""
    if len(others) == 0:
        return 0.0
    ends = shapely.points(np.concatenate([m.first[rows], m.last[rows]]))
    near = shapely.STRtree(shapely.linestrings(others[:, 3:-3])).query(ends, predicate="dwithin", distance=ON_BRANCH * size)[0]
    return len(np.unique(near)) / len(ends)


def _outline(points, angle) -> Float[np.ndarray, "point 2"]:
    """The arcs one after the other, counter-clockwise, each from where the one before it ends."""
    turned = [(a, p) if a[-1] >= a[0] else (a[::-1], p[::-1]) for a, p in zip(angle, points, strict=True)]
    turned.sort(key=lambda arc: float(np.median(arc[0]) % (2 * np.pi)))
    kept, last = [], -np.inf
    for a, p in turned:
        a = a - 2 * np.pi * np.floor(np.median(a) / (2 * np.pi))
        kept.append(p[a > last] if (a > last).any() else p[:0])
        last = max(last, float(a.max()))
    first = turned[0][0] - 2 * np.pi * np.floor(np.median(turned[0][0]) / (2 * np.pi))
    kept[-1] = kept[-1] if last < first.min() + 2 * np.pi else kept[-1][: max(len(kept[-1]) - 1, 1)]
    return np.concatenate(kept)
