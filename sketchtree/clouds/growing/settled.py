"""Where exactly does the wood run among the points that it came to?

A shoot is straight while points lie a little to one side or the other. Every node of thin wood moves across its limb towards the middle of the points that are nearest to it, and then a
little to the middle of its neighbours on the limb (ours). Thick wood is only smoothed: its points are bark, often of one side only.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.clouds.growing.perception import workers
from sketchtree.traverse import child_count

_ROUNDS = 3
_DOUBT = 2.0  # points of which the middle counts half
_SMOOTH = 0.5  # of the way to the middle of its neighbours


def settled(
    parent: Int[np.ndarray, " node"], place: Float[np.ndarray, "node 3"], radius: Float[np.ndarray, " node"], xyz: Float[np.ndarray, "point 3"], reach: float
) -> Float[np.ndarray, "node 3"]:
    """Places of nodes that so lie among points. `reach`: how near a point must be, in the same units; thicker wood follows no points."""
    place = place.copy()
    moves = np.flatnonzero((parent != NULL) & (radius < reach))
    if not len(moves):
        return place
    count = child_count(parent)
    best = _thickest(parent, radius)
    inner = np.flatnonzero((parent != NULL) & (count > 0))
    for _ in range(_ROUNDS):
        distance, near = cKDTree(place).query(xyz, distance_upper_bound=reach, workers=workers(len(xyz)))
        held = np.isfinite(distance)
        near = near[held]
        number = np.bincount(near, minlength=len(parent))
        middle = np.stack([np.bincount(near, axis, len(parent)) for axis in xyz[held].T], axis=1) / np.maximum(number, 1)[:, None]
        along = place[best] - place[np.where(parent == NULL, np.arange(len(parent)), parent)]
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
        away = middle - place
        across = away - np.einsum("ni,ni->n", away, along)[:, None] * along
        share = number / (number + _DOUBT)
        place[moves] += share[moves, None] * across[moves]
        place[inner] += _SMOOTH * ((place[parent[inner]] + place[best[inner]]) / 2 - place[inner])
    return place


def _thickest(parent, radius):
    """The thickest child of every node; itself at a tip."""
    best = np.arange(len(parent))
    child = np.flatnonzero(parent != NULL)
    order = child[np.lexsort((radius[child], parent[child]))]
    best[parent[order]] = order
    return best
