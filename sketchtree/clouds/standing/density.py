"""Where do many points lie above one another? That is where roots are (Guo et al. 2018, §5.3).

    1. every point is projected along the vertical on the ground plane y = 0, and the density of what is projected is measured
    2. where it is higher there is a root; one for a tree; for a shrub the k of the highest density

The paper takes the centroids of clusters of higher density and gives no numbers: here the density is counted in cells and spread over their neighbours, `peaks` tells one cluster from
another, and "higher", where one trunk is looked for, is more than a share of the highest.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.ndimage import gaussian_filter

CELL = 0.01  # of the height
HIGHER = 0.3  # of the highest density
SPREAD = 1.5  # cells
_MOST = 1000  # cells along a side
_MARGIN = 8  # cells round the plan


@dataclass(frozen=True, eq=False)
class Density:
    """How many points lie above each cell of the plan, spread over its neighbours."""

    value: Float[np.ndarray, "x z"]  # points of a cell
    corner: Float[np.ndarray, "2"]  # (x, z) of the first cell's corner, metres
    size: float  # of a cell, metres


def density(xyz: Float[np.ndarray, "point 3"], height: float | None = None, cell: float = CELL) -> Density:
    """The density of points projected on the ground plane. `height`: of the plant, metres, where these are only some of its points; `cell`: its size, of the height."""
    plan = xyz[:, [0, 2]]
    size = max(cell * (float(np.ptp(xyz[:, 1])) if height is None else height), float(np.ptp(plan, axis=0).max()) / _MOST, 1e-9)
    corner = plan.min(axis=0) - _MARGIN * size
    row, column = np.floor((plan - corner) / size).astype(np.int64).T
    counts = np.zeros((row.max() + _MARGIN + 1, column.max() + _MARGIN + 1))
    np.add.at(counts, (row, column), 1.0)
    return Density(gaussian_filter(counts, SPREAD, mode="constant"), corner, size)
