"""Which way does the axis grow? A rooted tree of it: every node is reached from the root the shortest way, where what is wide is short; loops are cut where two such ways meet.

Loops come from holes, mostly of limbs that cross. The length of an edge counts over the radius of its smaller circle (Dijkstra): sap goes straight up thick wood and doesn't wander from limb to limb, as it would
if only the widest edges were kept.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, dijkstra

from sketchtree.axes import NULL

_THIN = 0.25  # pixels: a radius at least
_STEP = 1e-9  # of an edge of no length


@dataclass(frozen=True, eq=False)
class Rooted:
    """A rooted tree of nodes, parents first; row 0 is the root. Pixels, y down."""

    parent: Int[np.ndarray, " node"]
    xy: Float[np.ndarray, "node 2"]
    radius: Float[np.ndarray, " node"]  # of the largest circle round each node within the contour

    def select(self, keep) -> "Rooted":
        """Only some nodes; every kept one's parent must be kept."""
        number = np.where(keep, np.cumsum(keep) - 1, NULL)
        up = self.parent[keep]
        return Rooted(np.where(up == NULL, NULL, number[up]), self.xy[keep], self.radius[keep])


def rooted(xy: Float[np.ndarray, "node 2"], edges: Int[np.ndarray, "edge 2"], radius: Float[np.ndarray, " node"], root: int) -> tuple[Rooted, int]:
    """(the tree that is left from `root`, how many loops were cut)."""
    count = len(xy)
    wide = np.minimum(radius[edges[:, 0]], radius[edges[:, 1]])
    far = np.hypot(*(xy[edges[:, 0]] - xy[edges[:, 1]]).T) / np.maximum(wide, _THIN) + _STEP
    graph = coo_array((far, (edges.min(axis=1), edges.max(axis=1))), shape=(count, count)).tocsr()
    _, way = dijkstra(graph, directed=False, indices=root, return_predecessors=True)
    found = np.flatnonzero(way >= 0)
    order, before = breadth_first_order(coo_array((np.ones(len(found)), (way[found], found)), shape=(count, count)).tocsr(), root, directed=True)
    number = np.full(count, NULL)
    number[order] = np.arange(len(order))
    parent = np.where(before[order] < 0, NULL, number[np.maximum(before[order], 0)])
    loops = len(np.unique(np.sort(edges, axis=1), axis=0)) - (len(order) - 1)
    return Rooted(parent, xy[order], radius[order]), loops


def chains(parent: Int[np.ndarray, " node"]) -> list[list[int]]:
    """The nodes from every fork (or the root) to the next, or to a tip: both ends belong to it. Those nearer to the root first."""
    count = np.bincount(parent[parent != NULL], minlength=len(parent))
    only = np.full(len(parent), NULL)
    only[parent[1:]] = np.arange(1, len(parent))
    found = []
    for row in range(1, len(parent)):
        up = parent[row]
        if count[up] == 1 and parent[up] != NULL:
            continue
        chain = [int(up), row]
        while count[chain[-1]] == 1:
            chain.append(int(only[chain[-1]]))
        found.append(chain)
    return found
