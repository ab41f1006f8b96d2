"""Which points belong to nothing? Those far from all others, by the scatter of the cloud's own distances.

    d_i   mean distance from a point to its six nearest neighbours
    removed where d_i > median(d) · exp(4.5 · σ),  σ = 1.48 · median |log d − median(log d)|, and no less than 7 medians

Distances are compared as logarithms, since a scan is dense on the trunk and thin among twigs: a tip keeps its points, a bird doesn't.
"""

import numpy as np
from jaxtyping import Bool, Float
from scipy.spatial import cKDTree

_NEIGHBOURS = 6
_SPREADS, _LEAST = 4.5, 7.0


def outliers(xyz: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
    """Which points belong to nothing. None of a cloud of a handful."""
    if len(xyz) <= 2 * _NEIGHBOURS:
        return np.zeros(len(xyz), bool)
    log = np.log(cKDTree(xyz).query(xyz, k=_NEIGHBOURS + 1)[0][:, 1:].mean(axis=1) + 1e-9)
    middle = np.median(log)
    return log - middle > max(_SPREADS * 1.4826 * float(np.median(np.abs(log - middle))), np.log(_LEAST))


def height_without(xyz: Float[np.ndarray, "point 3"]) -> float:
    """How high points reach, metres, those that belong to nothing left out."""
    return float(np.ptp(xyz[~outliers(xyz), 1]))
