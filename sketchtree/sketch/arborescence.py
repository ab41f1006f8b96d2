"""Which parent for every stroke, so that the whole costs least?

The minimum spanning arborescence of a directed graph (Chu & Liu 1965; Edmonds 1967): every node but the
root takes one incoming arc, no cycles, least total cost. Each round takes the cheapest arc into every node; cycles
are contracted, an arc (u → v) into a cycle then costs w(u → v) − w(best into v); all cycles of a round at once.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL


def arborescence(
    tail: Int[np.ndarray, " arc"], head: Int[np.ndarray, " arc"], cost: Float[np.ndarray, " arc"], node_count: int, root: int
) -> Int[np.ndarray, " node"]:
    """The arc chosen into every node (NULL at the root). Ties go to the arc that stands first.

    Every node must be reachable from the root.
    """
    levels = []
    arc = np.arange(len(head))
    while True:
        best = _cheapest(head, cost, node_count, root)
        cycle = _cycles(np.where(best == NULL, NULL, tail[best]))
        if not (cycle != NULL).any():
            break
        label, count = _contract(cycle)
        levels.append((best, cycle, head, label))
        cost = np.where(cycle[head] != NULL, cost - cost[best[head]], cost)
        kept = label[tail] != label[head]
        arc = np.flatnonzero(kept)
        levels[-1] += (arc,)
        tail, head, cost = label[tail[kept]], label[head[kept]], cost[kept]
        root, node_count = label[root], count
    for previous, cycle, head_before, label, kept_arc in reversed(levels):
        best = _expand(best, previous, cycle, head_before, label, kept_arc)
    return best


def _cheapest(head, cost, node_count: int, root: int) -> Int[np.ndarray, " node"]:
    order = np.lexsort((np.arange(len(head)), cost, head))
    best = np.full(node_count, NULL)
    first = np.r_[True, np.diff(head[order]) != 0] if len(order) else np.zeros(0, bool)
    best[head[order[first]]] = order[first]
    best[root] = NULL
    assert (np.delete(best, root) != NULL).all(), "every node must have an incoming arc"
    return best


def _cycles(parent: Int[np.ndarray, " node"]) -> Int[np.ndarray, " node"]:
    """For every node on a cycle the cycle's smallest node; NULL elsewhere."""
    cycle = np.full(len(parent), NULL)
    state = np.zeros(len(parent), np.int64)  # 0 unseen, else the walk that saw it
    up = parent.tolist()
    for start in range(len(up)):
        walk, node = [], start
        while node != NULL and state[node] == 0:
            state[node] = start + 1
            walk.append(node)
            node = up[node]
        if node != NULL and state[node] == start + 1:
            ring = walk[walk.index(node) :]
            cycle[ring] = min(ring)
    return cycle


def _contract(cycle: Int[np.ndarray, " node"]) -> tuple[Int[np.ndarray, " node"], int]:
    keeper: Bool[np.ndarray, " node"] = (cycle == NULL) | (cycle == np.arange(len(cycle)))
    number = np.cumsum(keeper) - 1
    return np.where(cycle == NULL, number, number[np.where(cycle == NULL, 0, cycle)]), int(keeper.sum())


def _expand(best, previous, cycle, head, label, kept_arc) -> Int[np.ndarray, " node"]:
    """The arcs of one level from those of its contraction: a cycle keeps its own, except where it is entered."""
    chosen = np.where(cycle != NULL, previous, NULL)
    entering = np.where(best == NULL, NULL, kept_arc[best] if len(kept_arc) else NULL)
    entering = entering[entering != NULL]
    chosen[head[entering]] = entering
    return chosen
