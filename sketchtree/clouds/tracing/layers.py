"""Which points lie round the same place of the same branch?

Points are sorted by how far they are from the foot, in layers that are as wide as it takes there: wide where wood is thick, narrow among twigs. What hangs together in a layer is a
*node*, a ring of bark where the wood is thick. A node's parent is the node from which most ways come into it (the level sets of Verroust and Lazarus 2000).
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components

from sketchtree.axes import NULL
from sketchtree.clouds.tracing.joined import Joined
from sketchtree.clouds.tracing.ways import Ways
from sketchtree.skeleton_rows import parents_first


@dataclass(frozen=True, eq=False)
class Nodes:
    """Pieces of layers, parents first."""

    parent: Int[np.ndarray, " node"]
    centre: Float[np.ndarray, "node 3"]  # mean of its points, metres
    of_point: Int[np.ndarray, " point"]  # the node that each point belongs to
    size: Int[np.ndarray, " node"]  # points
    width: Float[np.ndarray, " node"]  # of its layer, metres
    end: Float[np.ndarray, "node 3"]  # its point that is farthest from the foot


def layers(
    xyz: Float[np.ndarray, "point 3"], graph: Joined, way: Ways, width: Float[np.ndarray, " point"], apart: Float[np.ndarray, " point"] | None = None
) -> Nodes:
    """The nodes of layers that are so wide at each point, metres. `apart`: neighbours that are farther from one another, metres, are of two twigs; without it none are."""
    layer = np.floor(way.summed(way.step / width)).astype(np.int64)
    together = (layer[graph.one] == layer[graph.other]) & (way.foot[graph.one] == way.foot[graph.other])
    if apart is not None:
        together &= graph.length <= np.minimum(apart[graph.one], apart[graph.other])
    walks = np.flatnonzero((way.before != NULL) & (layer[way.before] == layer))
    at_foot = [np.flatnonzero((way.before == NULL) & (way.foot == foot)) for foot in range(way.foot.max() + 1)]
    one = np.concatenate([graph.one[together], walks, *(points[1:] for points in at_foot)])
    other = np.concatenate([graph.other[together], way.before[walks], *(points[:-1] for points in at_foot)])
    count, piece = connected_components(csr_matrix((np.ones(len(one), np.int8), (one, other)), shape=(len(xyz), len(xyz))), directed=False)
    parent = _parents(way.before, piece, count)
    order = parents_first(parent, "the cloud")
    place = np.argsort(order)
    parent = np.where(parent[order] == NULL, NULL, place[parent[order]])
    of_point = place[piece]
    size = np.bincount(of_point, minlength=count)
    centre = np.stack([np.bincount(of_point, axis, count) / size for axis in xyz.T], axis=1)
    return Nodes(parent, centre, of_point, size, np.bincount(of_point, width, count) / size, xyz[_last(of_point, way.length)])


def _parents(before, piece, count: int):
    """The piece from which most ways come; of as many, that of the higher number."""
    entering = np.flatnonzero((before != NULL) & (piece[before] != piece))
    pair, times = np.unique(piece[entering].astype(np.int64) * count + piece[before[entering]], return_counts=True)
    child, above = pair // count, pair % count
    order = np.lexsort((times, child))
    parent = np.full(count, NULL)
    parent[child[order]] = above[order]
    return parent


def _last(of_point, length):
    """The point of each node that is farthest from the foot."""
    order = np.lexsort((length, of_point))
    return order[np.r_[np.flatnonzero(np.diff(of_point[order])), len(order) - 1]]
