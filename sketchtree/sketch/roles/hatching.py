"""Which strokes are hatching? Families of short straight strokes side by side that grow from nothing.

Strokes are neighbours if they are alike in length and direction and lie beside each other, not end to end. A family
of several, nearly none of whose ends comes near another stroke, is hatching: the twigs of a spruce are parallel, too, but
their feet are on a limb.
"""

import numpy as np
import shapely
from jaxtyping import Bool, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.measures import Measures

SHORT = 0.12  # of the drawing's height: longer strokes are no hatching
STRAIGHT = 0.93  # least distance between its ends, of its length
PARALLEL = np.cos(np.radians(14))
ALIKE = 0.5  # least ratio of the lengths of neighbours
BESIDE = 1.3  # of their length: neighbours are no farther apart
ACROSS = 0.35  # least part of that distance that lies across the strokes
FAMILY = 5  # strokes
LOOSE = 0.015  # of the drawing's height: a stroke with an end this near to another may grow from it
NEAREST, LONGER = 12, 1.3  # points looked at, and how much longer than itself a stroke is that bears a twig for sure
HELD = 0.25  # greatest part of a family that may


def hatching(m: Measures, free: Bool[np.ndarray, " stroke"], wood: Bool[np.ndarray, " stroke"], height: float) -> list[Found]:
    """The families of short parallel strokes that grow from nothing."""
    apart = np.hypot(*(m.last - m.first).T)
    rows = np.flatnonzero(free & ~m.closed & (m.length <= SHORT * height) & (apart >= STRAIGHT * m.length) & (m.length > 0))
    rows = rows[~_plainly_held(m, rows, wood, LOOSE * height)] if len(rows) >= FAMILY else rows
    if len(rows) < FAMILY:
        return []
    family = _families(m, rows)
    count = np.bincount(family)
    rows, family = rows[count[family] >= FAMILY], family[count[family] >= FAMILY]
    if len(rows) == 0:
        return []
    held = _held(m, rows, family, wood, LOOSE * height)
    part = np.bincount(family, held) / np.maximum(np.bincount(family), 1)
    return [Found(int(row), "hatching", "one of several short parallel strokes that grow from nothing", (("branch", 0.4),)) for row in rows[part[family] <= HELD]]


def _families(m: Measures, rows: Int[np.ndarray, " row"]) -> Int[np.ndarray, " row"]:
    """The family of every stroke: those that are neighbours of neighbours."""
    length = m.length[rows]
    way = (m.last - m.first)[rows] / np.maximum(np.hypot(*(m.last - m.first)[rows].T), 1e-300)[:, None]
    middle = 0.5 * (m.first + m.last)[rows]
    a, b = cKDTree(middle).query_pairs(BESIDE * float(length.max()), output_type="ndarray").T
    offset = middle[b] - middle[a]
    distance = np.hypot(*offset.T)
    across = np.abs(offset[:, 0] * way[a, 1] - offset[:, 1] * way[a, 0])
    alike = np.minimum(length[a], length[b]) >= ALIKE * np.maximum(length[a], length[b])
    near = (distance <= BESIDE * np.maximum(length[a], length[b])) & (across >= ACROSS * distance)
    kept = alike & near & (np.abs((way[a] * way[b]).sum(1)) >= PARALLEL)
    links = coo_array((np.ones(kept.sum()), (a[kept], b[kept])), (len(rows),) * 2)
    return connected_components(links, directed=False)[1]


def _plainly_held(m: Measures, rows, wood, reach: float) -> Bool[np.ndarray, " row"]:
    """Which of these strokes has an end near one of the even points along a longer stroke: most twigs, at little cost."""
    others = np.flatnonzero(wood)
    longer = np.repeat(m.length[others], m.evenly.shape[1])
    tree = cKDTree(m.evenly[others].reshape(-1, 2))
    ends = np.stack([m.first[rows], m.last[rows]], 1)
    _, near = tree.query(ends, k=NEAREST, distance_upper_bound=reach)
    longer = np.r_[longer, 0.0]  # where there are fewer near points
    return (longer[near] > LONGER * m.length[rows][:, None, None]).any((1, 2))


def _held(m: Measures, rows, family, wood, reach: float) -> Bool[np.ndarray, " row"]:
    """Which of these strokes has an end near a stroke outside its family."""
    others = np.flatnonzero(wood)
    member = np.full(len(m), -1)
    member[rows] = family
    ends = shapely.points(np.concatenate([m.first[rows], m.last[rows]]))
    end, other = shapely.STRtree(m.shapes(others)).query(ends, predicate="dwithin", distance=reach)
    foreign = member[others[other]] != family[end % len(rows)]
    held = np.zeros(len(rows), bool)
    held[end[foreign] % len(rows)] = True
    return held
