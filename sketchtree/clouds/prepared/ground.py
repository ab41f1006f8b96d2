"""Is there ground under the plant, and which points are it?

The plan is cut into cells; the lowest point of each is ground, if it lies on a plane that few points are below. The rule, in full:

    plane      of all planes through three lowest points, no steeper than 35°, the one that most lowest points lie on (within 1.5 % of the height, or of a twentieth of the width), less those below it
    there is   ground if half the cells or more lie on it and no more than 1 % of the points are below: the underside of a crown is no plane, and has a trunk below
    surface    in each cell the median of the points that are near the plane; where there are none, that of the nearest cell
    removed    is what is lower than 3 (robust) standard deviations of those points above the surface: as little of the trunk's foot as can be
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from scipy.spatial import cKDTree

_CELLS = 30  # along the wider side of the plan
_NEAR = 0.015  # of the height
_STEEPEST = np.tan(np.radians(35.0))
_TRIPLES = 400
_FLAT = 0.05  # of the width: a cloud that is lower may be nothing but ground
_LEAST, _BELOW = 0.5, 0.01  # share of the cells on the plane, of the points below it
_FEWEST = 30  # cells: fewer make no plane
_SPREADS = 3.0


@dataclass(frozen=True, eq=False)
class Ground:
    """The ground, and what is above it."""

    above: Float[np.ndarray, " point"]  # metres above the surface
    is_ground: Bool[np.ndarray, " point"]
    share: float  # of the cells that lie on the plane
    slope: float  # radians
    thick: float  # metres: how high above the surface points were taken for ground


def ground(xyz: Float[np.ndarray, "point 3"]) -> Ground | None:
    """The ground under points (y up), if there is some."""
    height = float(np.ptp(np.percentile(xyz[:, 1], [0.1, 99.9]))) + 1e-9
    plan = xyz[:, [0, 2]] - xyz[:, [0, 2]].min(axis=0)
    size = max(float(plan.max()) / _CELLS, 1e-9)
    cell = (np.minimum(plan // size, _CELLS).astype(np.int64) * [_CELLS + 1, 1]).sum(axis=1)
    order = np.lexsort((xyz[:, 1], cell))
    lowest = xyz[order[np.r_[True, np.diff(cell[order]) > 0]]]
    if len(lowest) < _FEWEST:
        return None
    near = _NEAR * max(height, _FLAT * float(plan.max()))
    plane = _plane(lowest, near)
    if plane is None or np.hypot(plane[0], plane[1]) > _STEEPEST:
        return None
    off = xyz[:, 1] - _on(plane, xyz)
    share = float((np.abs(lowest[:, 1] - _on(plane, lowest)) <= near).mean())
    if share < _LEAST or (off < -2 * near).mean() > _BELOW:
        return None
    above = off - _surface(off, cell, xyz, 2 * near)
    beside = above[np.abs(above) < near]
    thick = float(np.clip(_SPREADS * 1.4826 * np.median(np.abs(beside)), 0.002 * height, near))
    return Ground(above, above <= thick, share, float(np.arctan(np.hypot(plane[0], plane[1]))), thick)


def _on(plane, xyz):
    return plane[0] * xyz[:, 0] + plane[1] * xyz[:, 2] + plane[2]


def _plane(lowest, near: float):
    """(slope along x, along z, height at the origin) of the plane that most lowest points lie on; fitted to those in the end."""
    best, found, count = -1.0, None, len(lowest)
    for k in range(1, _TRIPLES + 1):
        rows = np.array([(k * 7919) % count, (k * 104_729 + count // 3) % count, (k * 15_485_863 + 2 * count // 3) % count])
        three = np.c_[lowest[rows][:, [0, 2]], np.ones(3)]
        if abs(np.linalg.det(three)) < 1e-9:
            continue
        plane = np.linalg.solve(three, lowest[rows, 1])
        if np.hypot(plane[0], plane[1]) > _STEEPEST:
            continue
        off = lowest[:, 1] - _on(plane, lowest)
        score = float((np.abs(off) <= near).sum() - (off < -2 * near).sum())
        if score > best:
            best, found = score, plane
    for _ in range(3 if found is not None else 0):
        on = np.abs(lowest[:, 1] - _on(found, lowest)) <= near
        if on.sum() < 3:
            return None
        found = np.linalg.lstsq(np.c_[lowest[on][:, [0, 2]], np.ones(on.sum())], lowest[on, 1], rcond=None)[0]
    return found


def _surface(off, cell, xyz, near: float):
    """How high above the plane the ground lies at each point, from the median of each cell, smoothed over its neighbours."""
    rows = np.flatnonzero(np.abs(off) <= near)
    rows = rows[np.lexsort((off[rows], cell[rows]))]
    first = np.flatnonzero(np.r_[True, np.diff(cell[rows]) > 0])
    count = np.diff(np.r_[first, len(rows)])
    level = off[rows[first + count // 2]]
    middle = np.add.reduceat(xyz[rows][:, [0, 2]], first) / count[:, None]
    tree = cKDTree(middle)
    _, four = tree.query(middle, k=min(5, len(middle)))
    level = np.median(level[four.reshape(len(middle), -1)], axis=1)
    distance, near_cell = tree.query(xyz[:, [0, 2]], k=min(4, len(middle)))
    distance, near_cell = distance.reshape(len(xyz), -1), near_cell.reshape(len(xyz), -1)
    weight = 1.0 / (distance + 1e-6) ** 2
    return (weight * level[near_cell]).sum(axis=1) / weight.sum(axis=1)
