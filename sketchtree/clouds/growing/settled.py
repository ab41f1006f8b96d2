"""Where exactly does the wood run among the points that it came to?

A shoot is straight while points lie a little to one side or the other. Every node of thin wood moves across its limb towards the middle of the points that are nearest to it, neighbours on
a limb together, so that it stays as smooth as it grew (ours). The points of thicker wood are bark: it follows them as far as they lie all round it.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.clouds.growing.heading import unit
from sketchtree.clouds.growing.perception import workers
from sketchtree.traverse import child_count

_ROUNDS = 4
_DOUBT = 2.0  # points of which the middle counts half
_THIN = 0.3  # of the reach: the radius of thin wood
_ONE_SIDED = 0.6  # size of the mean direction to the points, from which they are bark of one side
_TOGETHER = 2  # times that a node's move becomes the mean of its own and its neighbours'
_SMOOTH = 0.4  # of the way to the middle of its neighbours


def settled(
    parent: Int[np.ndarray, " node"], place: Float[np.ndarray, "node 3"], radius: Float[np.ndarray, " node"], xyz: Float[np.ndarray, "point 3"], reach: float
) -> Float[np.ndarray, "node 3"]:
    """Places of nodes that so lie among points. `reach`: how near a point must be, in the same units."""
    place, best = place.copy(), _thickest(parent, radius)
    before = np.where(parent == NULL, np.arange(len(parent)), parent)
    inner = np.flatnonzero((parent != NULL) & (child_count(parent) > 0))
    for _ in range(_ROUNDS):
        distance, near = cKDTree(place).query(xyz, distance_upper_bound=reach, workers=workers(len(xyz)))
        held = np.isfinite(distance)
        near = near[held]
        along = place[best] - place[before]
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
        across = xyz[held] - place[near]
        across -= np.einsum("pi,pi->p", across, along[near])[:, None] * along[near]
        number = np.bincount(near, minlength=len(parent))
        one_sided = np.linalg.norm(_mean(near, unit(across), number), axis=1)
        sure = np.where(radius < _THIN * reach, 1.0, np.clip(1.0 - one_sided / _ONE_SIDED, 0.0, 1.0)) * number / (number + _DOUBT)
        move = np.where(parent == NULL, 0.0, sure)[:, None] * _mean(near, across, number)
        for _ in range(_TOGETHER):
            move = (move[before] + 2.0 * move + move[best]) / 4.0
        place += np.where((parent == NULL)[:, None], 0.0, move)
        place[inner] += _SMOOTH * ((place[before[inner]] + place[best[inner]]) / 2 - place[inner])
    return place


def _mean(row, value, number):
    """The mean of values by row."""
    return np.stack([np.bincount(row, axis, len(number)) for axis in value.T], axis=1) / np.maximum(number, 1)[:, None]


def _thickest(parent, radius):
    """The thickest child of every node; itself at a tip."""
    best = np.arange(len(parent))
    child = np.flatnonzero(parent != NULL)
    order = child[np.lexsort((radius[child], parent[child]))]
    best[parent[order]] = order
    return best
