"""Where is the root? Where many points lie above one another (Guo et al. 2018, §5.3).

    1. every point is projected along the vertical on the ground plane y = 0, and the density of what is projected is measured
    2. the points of higher density form clusters; a cluster's centroid is a root
    3. one root for a tree; for a shrub the k clusters of the highest density

The paper gives no numbers: here the density is counted in cells and spread over their neighbours, and "higher" is more than a share of the highest.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.ndimage import gaussian_filter, label

CELL = 0.01  # of the height
HIGHER = 0.3  # of the highest density
_SPREAD = 1.5  # cells
_MOST = 1000  # cells along a side
_MARGIN = 8  # cells round the plan


@dataclass(frozen=True, eq=False)
class Density:
    """How many points lie above each cell of the plan, spread over its neighbours."""

    value: Float[np.ndarray, "x z"]  # points of a cell
    corner: Float[np.ndarray, "2"]  # (x, z) of the first cell's corner, metres
    size: float  # of a cell, metres


@dataclass(frozen=True, eq=False)
class Roots:
    """Clusters of high density, the densest first."""

    place: Float[np.ndarray, "root 2"]  # (x, z) of centroids, metres
    peak: Float[np.ndarray, " root"]  # the highest density of each


def density(xyz: Float[np.ndarray, "point 3"], height: float | None = None) -> Density:
    """The density of points projected on the ground plane. `height`: of the plant, metres, where these are only some of its points."""
    plan = xyz[:, [0, 2]]
    size = max(CELL * (float(np.ptp(xyz[:, 1])) if height is None else height), float(np.ptp(plan, axis=0).max()) / _MOST, 1e-9)
    corner = plan.min(axis=0) - _MARGIN * size
    cell = np.floor((plan - corner) / size).astype(np.int64)
    counts = np.zeros(cell.max(axis=0) + _MARGIN + 1)
    np.add.at(counts, (cell[:, 0], cell[:, 1]), 1.0)
    return Density(gaussian_filter(counts, _SPREAD, mode="constant"), corner, size)


def roots(found: Density, count: int | None = None, higher: float = HIGHER) -> Roots:
    """The clusters of cells that are denser than a share of the densest: all of them, or so many of the highest."""
    names, number = label(found.value > higher * found.value.max(), np.ones((3, 3)))
    rows = np.nonzero(names)
    name, value = names[rows] - 1, found.value[rows]
    weight = np.bincount(name, value, number)
    place = np.stack([np.bincount(name, value * (axis + 0.5), number) / weight for axis in rows], axis=1) * found.size + found.corner
    peak = np.zeros(number)
    np.maximum.at(peak, name, value)
    order = np.argsort(-peak, kind="stable")[:count]
    return Roots(place[order], peak[order])
