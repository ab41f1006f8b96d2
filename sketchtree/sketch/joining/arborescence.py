"""Which parent for every stroke, so that the whole costs least?

The minimum spanning arborescence of a directed graph (Chu & Liu 1965; Edmonds 1967): every node but the root
takes one incoming arc, no cycles, least total cost. If the cheapest arc into every node makes no cycle, that is it. Else, as Tarjan (1977, "Finding optimum branchings") has it, a walk
goes from node to node up the cheapest incoming arcs until it meets the finished part. Where it meets itself, the cycle
becomes one node, whose arcs (u → v) then cost w(u → v) − w(best into v). Arcs wait in heaps; a heap carries what is
to be taken off all its costs, and the smaller of two heaps is poured into the larger: O(E log² E).
"""

import heapq

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL

_NEW, _WALKED, _DONE = 0, 1, 2


def arborescence(
    tail: Int[np.ndarray, " arc"], head: Int[np.ndarray, " arc"], cost: Float[np.ndarray, " arc"], node_count: int, root: int
) -> Int[np.ndarray, " node"]:
    """The arc chosen into every node (NULL at the root). Ties go to the arc that stands first.

    Every node must be reachable from the root.
    """
    order = np.lexsort((cost, head))
    chosen = _cheapest(order, head, node_count, root)
    if _reaches(tail, chosen, root):
        return chosen
    forest = _Contraction(tail, head, cost, order, node_count)
    forest.state[root] = _DONE
    for start in range(node_count):
        forest.walk(start)
    chosen = np.array(forest.unfold()[:node_count])
    chosen[root] = NULL
    return chosen


def _cheapest(order, head, node_count: int, root: int) -> Int[np.ndarray, " node"]:
    """The cheapest arc into every node: the first of it in `order`."""
    chosen = np.full(node_count, NULL)
    nodes, first = np.unique(head[order], return_index=True)
    chosen[nodes] = order[first]
    chosen[root] = NULL
    return chosen


def _reaches(tail, chosen, root: int) -> bool:
    """Whether every node hangs on the root by these arcs."""
    above = np.where(chosen == NULL, np.arange(len(chosen)), tail[chosen])
    for _ in range(len(chosen).bit_length()):
        above = above[above]
    return bool((above == root).all())


class _Contraction:
    """The graph while cycles are being contracted; nodes from `node_count` on are cycles."""

    def __init__(self, tail, head, cost, order, node_count: int):
        self.tail, self.head = tail.tolist(), head.tolist()
        order = order[np.sort(np.unique(head[order] * node_count + tail[order], return_index=True)[1])]  # of arcs alike the cheapest
        arcs = list(zip(cost[order].tolist(), order.tolist(), strict=True))
        bounds = np.searchsorted(head[order], np.arange(node_count + 1)).tolist()
        self.heap = [arcs[low:high] for low, high in zip(bounds[:-1], bounds[1:], strict=True)]  # in order: a heap
        self.taken_off = [0.0] * node_count
        self.state = [_NEW] * node_count
        self.arc = [NULL] * node_count  # the best into each
        self.cycle = [NULL] * node_count  # that each became part of
        self._jump = list(range(node_count))  # towards the outermost cycle

    def walk(self, start: int) -> None:
        """Go up the cheapest arcs from a node until the finished part is reached."""
        node, path = self.outermost(start), []
        while self.state[node] != _DONE:
            if self.state[node] == _WALKED:
                node = self._contract(path, node)
            self.state[node] = _WALKED
            path.append(node)
            node = self._step(node)
        for walked in path:
            self.state[walked] = _DONE

    def outermost(self, node: int) -> int:
        """The node itself or the outermost cycle that holds it."""
        jump = self._jump
        while jump[node] != node:
            jump[node] = jump[jump[node]]
            node = jump[node]
        return node

    def _step(self, node: int) -> int:
        heap = self.heap[node]
        while True:
            assert heap, "every node must be reachable from the root"
            value, arc = heapq.heappop(heap)
            above = self.outermost(self.tail[arc])
            if above != node:
                break
        self.arc[node] = arc
        self.taken_off[node] = value  # a cost counts from here on as what it exceeds this by
        return above

    def _contract(self, path: list[int], meeting: int) -> int:
        """Make one node of the cycle at the end of the path."""
        members = path[path.index(meeting) :]
        del path[-len(members) :]
        largest = max(members, key=lambda member: len(self.heap[member]))
        heap, off = self.heap[largest], self.taken_off[largest]
        for member in members:
            if member != largest:
                shift = off - self.taken_off[member]
                for value, arc in self.heap[member]:
                    heapq.heappush(heap, (value + shift, arc))
                self.heap[member] = []
        whole = len(self.heap)
        self.heap.append([])
        self.heap[whole], self.heap[largest] = heap, []
        self.taken_off.append(off)
        self.state.append(_NEW)
        self.arc.append(NULL)
        self.cycle.append(NULL)
        self._jump.append(whole)
        for member in members:
            self.cycle[member] = self._jump[member] = whole
        return whole

    def unfold(self) -> list[int]:
        """The arc into every node: a cycle keeps its own arcs, except where it is entered."""
        entered = [False] * len(self.arc)
        for whole in range(len(self.arc) - 1, -1, -1):
            if entered[whole] or self.arc[whole] == NULL:
                continue
            node = self.head[self.arc[whole]]
            while node != whole:  # the arc enters every cycle nested around its head
                self.arc[node], entered[node] = self.arc[whole], True
                node = self.cycle[node]
        return self.arc
