"""How far is every point from the foot, along the wood?

The way to a point is the one of least Σ d^n over the pairs that it takes (Dijkstra). With n = 2 many short steps cost less than a long one, so a way keeps to where points are dense
and crosses a gap where it is narrow, but winds; with n near 1 it runs straight, so that all round a thick trunk it is as long. Its length is Σ d, metres.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

from sketchtree.axes import NULL
from sketchtree.clouds.tracing.joined import Joined


@dataclass(frozen=True, eq=False)
class Ways:
    """The way from a foot to each point."""

    before: Int[np.ndarray, " point"]  # the point before it on its way; NULL at a foot
    step: Float[np.ndarray, " point"]  # metres from the point before it
    foot: Int[np.ndarray, " point"]  # which foot, numbered as they were given

    @property
    def length(self) -> Float[np.ndarray, " point"]:
        """Metres from the foot."""
        return self.summed(self.step)

    def summed(self, value: Float[np.ndarray, " point"]) -> Float[np.ndarray, " point"]:
        """Σ of a value over all points of each way: by points twice as far back at every turn."""
        total, above = value.copy(), self.before.copy()
        while (above != NULL).any():
            rows = np.flatnonzero(above != NULL)
            total[rows], above[rows] = total[rows] + total[above[rows]], above[above[rows]]
        return total


def ways(xyz: Float[np.ndarray, "point 3"], graph: Joined, feet: list[Int[np.ndarray, " start"]], power: float = 2.0) -> Ways:
    """Ways from feet, each of which is some points that are all at its distance 0. Each point belongs to the foot from which it is reached most easily."""
    count, size = len(xyz), len(xyz) + len(feet)
    one = np.concatenate([graph.one, *(np.full(len(points), count + k) for k, points in enumerate(feet))])
    other = np.concatenate([graph.other, *feet])
    cost = np.concatenate([graph.length**power, np.full(sum(map(len, feet)), 1e-18)])
    there = csr_matrix((cost, (one, other)), shape=(size, size))
    _, before, source = dijkstra(there.maximum(there.T), directed=False, indices=np.arange(count, size), return_predecessors=True, min_only=True)
    foot = source[:count] - count
    before = np.where(before[:count] >= count, NULL, before[:count])
    step = np.where(before == NULL, 0.0, np.linalg.norm(xyz - xyz[before], axis=1))
    return Ways(before.astype(np.int64), step, foot.astype(np.int64))
