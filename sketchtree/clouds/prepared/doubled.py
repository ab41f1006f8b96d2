"""Which points are there twice? Those at the same place, to a hundredth of a millimetre: scans that were merged hold many. The first of each is kept."""

import numpy as np
from jaxtyping import Float, Int

_SAME = 1e-5  # metres


def single_rows(xyz: Float[np.ndarray, "point 3"]) -> Int[np.ndarray, " kept"]:
    """Rows of the points that are the first at their place."""
    place = np.round((xyz - xyz.min(axis=0)) / _SAME).astype(np.int64)
    order = np.lexsort(place.T)  # stable: the first of equals stays first
    return np.sort(order[np.r_[True, (np.diff(place[order], axis=0) != 0).any(axis=1)]])
