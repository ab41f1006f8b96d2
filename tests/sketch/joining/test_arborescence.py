from itertools import product

import numpy as np
import pytest

from sketchtree.sketch.joining.arborescence import arborescence


def cheapest_by_trying_all(tail, head, cost, node_count):
    """Total of the best arborescence from node 0, all choices of one arc into each other node tried."""
    into = [np.flatnonzero(head == node) for node in range(1, node_count)]
    totals = []
    for arcs in product(*into):
        up = {int(head[a]): int(tail[a]) for a in arcs}
        if all(reaches_root(node, up) for node in up):
            totals.append(cost[list(arcs)].sum())
    return min(totals)


def reaches_root(node, up):
    for _ in range(len(up) + 1):
        if node == 0:
            return True
        node = up[node]
    return False


@pytest.mark.parametrize("seed", range(30))
def test_total_cost_is_that_of_the_best_of_all_arborescences(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 6))
    pairs = [(a, b) for a in range(count) for b in range(1, count) if a != b]
    tail, head = np.array(pairs).T
    cost = rng.integers(0, 12, len(pairs)).astype(float)
    chosen = arborescence(tail, head, cost, count, 0)
    assert chosen[0] == -1
    assert (head[chosen[1:]] == np.arange(1, count)).all()
    assert cost[chosen[1:]].sum() == cheapest_by_trying_all(tail, head, cost, count)


def test_nested_cycles_are_opened_where_they_are_entered():
    tail, head = np.array([[1, 2], [2, 1], [2, 3], [3, 1], [0, 3], [0, 1]]).T
    cost = np.array([1.0, 1.0, 1.0, 1.0, 50.0, 60.0])
    chosen = arborescence(tail, head, cost, 4, 0)
    assert cost[chosen[1:]].sum() == 52.0


def test_a_tie_goes_to_the_arc_that_stands_first():
    chosen = arborescence(np.array([0, 0]), np.array([1, 1]), np.array([2.0, 2.0]), 2, 0)
    assert chosen.tolist() == [-1, 0]
