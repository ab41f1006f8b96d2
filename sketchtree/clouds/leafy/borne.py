"""How much hangs on the wood at a point? What the ways from the foot say (`tracing.ways`).

    b_i = log mean over i and its nine nearest of c_j        c_j  how many points' ways lead through j, itself counted

Limbs bear much, leaves and the ends of twigs bear next to nothing (after Vicari et al. 2019, who count ways through cubes).
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.clouds.tracing.ways import Ways

_NEAREST = 10


def borne(xyz: Float[np.ndarray, "point 3"], way: Ways) -> Float[np.ndarray, " point"]:
    """b of every point, natural logarithms; 0 where nothing hangs on it or on those about it."""
    near = cKDTree(xyz).query(xyz, k=min(_NEAREST, len(xyz)))[1].reshape(len(xyz), -1)
    return np.log(passing(way)[near].mean(axis=1))


def passing(way: Ways) -> Int[np.ndarray, " point"]:
    """How many ways lead through each point, its own counted."""
    before, count = way.before.tolist(), [1] * len(way.before)
    for point in np.argsort(-way.length, kind="stable").tolist():  # a way is longer than that of the point before it
        if before[point] != NULL:
            count[before[point]] += count[point]
    return np.array(count)
