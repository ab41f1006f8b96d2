"""From which of several starts is a point reached most easily? Over steps between neighbours, of least Σ d²: along wood, by many short steps, rather than by a long one through the air."""

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from sketchtree.axes import NULL

_NEIGHBOURS = 8


def reached(xyz: Float[np.ndarray, "point 3"], starts: list[Int[np.ndarray, "_"]]) -> Int[np.ndarray, " point"]:
    """The number of the start, a set of points, that each point is reached from; NULL where it isn't."""
    count, k = len(xyz), min(_NEIGHBOURS + 1, len(xyz))
    distance, near = cKDTree(xyz).query(xyz, k=k)
    one = np.concatenate([np.repeat(np.arange(count), k - 1), *(np.full(len(some), count + number) for number, some in enumerate(starts))])
    other = np.concatenate([near[:, 1:].ravel(), *starts])
    cost = np.concatenate([distance[:, 1:].ravel() ** 2 + 1e-18, np.full(sum(map(len, starts)), 1e-18)])
    there = csr_matrix((cost, (one, other)), shape=(count + len(starts),) * 2)
    source = dijkstra(there.maximum(there.T), directed=False, indices=np.arange(count, count + len(starts)), return_predecessors=True, min_only=True)[2]
    return np.where(source[:count] >= count, source[:count] - count, NULL)
