"""Which points does each bud see?

Pałubicki et al. 2009, in Guo et al. 2018, §5.2: a bud perceives what lies within the influence distance d_i and within θ/2 of where it looks, a cone of the angle θ ≈ 90°.
A point that several perceive goes to the nearest: they compete for it. What lies within the kill distance d_k = 0.5 d_i of wood is taken.

Ours: a bud counts for a point only where the way from the root through it is hardly longer than the straight one,

    s_A + |p − A| ≤ τ |p − root|       s_A   metres along the wood from the root to bud A

so that a limb is not made of whatever crept there first. τ grows only when nothing else is left.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL

THETA = 90.0  # degrees
KILL = 0.5  # d_k / d_i
_NEAREST = 12  # buds that a point asks, nearest first
_MANY = 10_000


def workers(count: int) -> int:
    """Threads that so many questions are worth: all processors, or one."""
    return -1 if count > _MANY else 1


@dataclass(frozen=True, eq=False)
class Detour:
    """How much longer than straight a way may be."""

    length: Float[np.ndarray, " bud"]  # from its root to each bud, along the wood
    root: Float[np.ndarray, "bud 3"]  # where that root is
    most: float  # τ

    def allows(self, point: Float[np.ndarray, "point 3"], distance: Float[np.ndarray, "point near"], bud: Int[np.ndarray, "point near"]) -> Bool[np.ndarray, "point near"]:
        """Whether each bud may be asked by each point."""
        straight = np.linalg.norm(point[:, None] - self.root[bud], axis=2)
        return self.length[bud] + distance <= self.most * straight


def perceived(
    point: Float[np.ndarray, "point 3"],
    place: Float[np.ndarray, "bud 3"],
    heading: Float[np.ndarray, "bud 3"],
    reach: Float[np.ndarray, " bud"],
    theta: float = THETA,
    detour: "Detour | None" = None,
) -> Int[np.ndarray, " point"]:
    """The bud that each point belongs to; NULL where none sees it. `reach`: d_i of each bud."""
    holder = np.full(len(point), NULL)
    if not len(place) or not len(point):
        return holder
    tree, farthest = cKDTree(place), float(reach.max()) * (1.0 + 1e-12)
    near = np.flatnonzero(np.isfinite(tree.query(point, distance_upper_bound=farthest, workers=workers(len(point)))[0]))
    if not len(near):
        return holder
    distance, bud = tree.query(point[near], k=min(_NEAREST, len(place)), distance_upper_bound=farthest, workers=workers(len(near)))
    distance, bud = distance.reshape(len(near), -1), bud.reshape(len(near), -1)
    there = np.isfinite(distance)
    bud = np.where(there, bud, 0)
    ahead = np.einsum("pki,pki->pk", point[near][:, None] - place[bud], heading[bud])
    seen = there & (distance <= reach[bud]) & (ahead >= np.cos(np.radians(theta / 2)) * distance)
    if detour is not None:
        seen &= detour.allows(point[near], distance, bud)
    first = seen.argmax(axis=1)
    rows = np.arange(len(near))
    holder[near] = np.where(seen[rows, first], bud[rows, first], NULL)
    return holder


def taken(tree: cKDTree, node: Float[np.ndarray, "node 3"], kill: Float[np.ndarray, " node"]) -> Int[np.ndarray, " point"]:
    """Rows of the tree's points that lie within the kill distance of some node; `kill`: of each."""
    if not len(node):
        return np.zeros(0, np.int64)
    within = tree.query_ball_point(node, kill, workers=workers(len(node)), return_sorted=False)
    return np.unique(np.concatenate([np.asarray(rows, np.int64) for rows in within]))
