"""Are no two vertices so close that a program which welds by position would take them for one?

Limbs that coincide, or run back along their parents, have vertices where others are. Those are moved inwards, each of a crowd a
step farther than the last, until every two are more than `_CLOSE` of the tree's extent apart; programs weld at about 1e-6.
"""

import numpy as np
from jaxtyping import Float
from scipy.spatial import cKDTree

_CLOSE = 2e-6  # / extent
_STEP = 2.5  # / the least distance
_PASSES = 12


def distinct(position: Float[np.ndarray, "vertex 3"], normal: Float[np.ndarray, "vertex 3"]) -> Float[np.ndarray, "vertex 3"]:
    """The positions, metres, with those that coincide moved apart against their normals."""
    position = position.copy()
    least = _CLOSE * float(np.ptp(position, axis=0).max()) if len(position) else 0.0
    for _ in range(_PASSES):
        later, rank = _crowded(position, least)
        if len(later) == 0:
            break
        position[later] -= (_STEP * least * rank)[:, None] * normal[later]
    return position


def _crowded(position, least: float):
    """Vertices that have earlier ones within `least` metres, and how many."""
    some = np.arange(len(position))
    for axis in range(3):  # whoever is alone along an axis is alone
        order = some[np.argsort(position[some, axis], kind="stable")]
        near = np.diff(position[order, axis]) < least
        some = order[np.r_[False, near][: len(order)] | np.r_[near, False][: len(order)]]
    some = np.sort(some)
    if len(some) == 0:
        return some, some
    pairs = cKDTree(position[some]).query_pairs(least, output_type="ndarray")
    later, rank = np.unique(pairs.max(axis=1), return_counts=True)
    return some[later], np.minimum(rank, 50)
