"""Limbs are flipped with all they carry, and depths carried over to a drawing with one stroke more."""

import numpy as np
import pytest

from sketchtree.errors import InferenceError
from sketchtree.mrf.edits import carried, flipped
from sketchtree.mrf.factor_graph import factor_graph
from tests.mrf.drawings import random_tree, sketch, small_tree


def _depth(graph, seed=0):
    rise = np.where(graph.is_base, 0.0, np.random.default_rng(seed).normal(0, 5, len(graph)))
    out = np.zeros(len(graph))
    for row in range(1, len(graph)):
        out[row] = out[graph.parent[row]] + rise[row]
    return out


def test_a_flip_turns_the_limb_and_what_grows_on_it_and_nothing_else():
    graph = factor_graph(small_tree())
    depth = _depth(graph)
    turned = flipped(graph, depth, 1)
    rise, after = (z - z[np.maximum(graph.parent, 0)] for z in (depth, turned))
    moved = np.isin(graph.limb, [1, 5])
    np.testing.assert_allclose(after[moved], -rise[moved])
    np.testing.assert_allclose(after[~moved], rise[~moved])


def test_two_flips_are_none():
    graph = factor_graph(small_tree())
    depth = _depth(graph)
    np.testing.assert_allclose(flipped(graph, flipped(graph, depth, 1), 1), depth)


def test_there_must_be_such_a_limb():
    graph = factor_graph(small_tree())
    with pytest.raises(InferenceError, match=r"There is no limb 6 to flip\. Name a limb between 0 and 5\."):
        flipped(graph, np.zeros(len(graph)), 6)


def test_the_same_drawing_keeps_its_depths():
    graph = factor_graph(random_tree(1, 9))
    depth = _depth(graph)
    np.testing.assert_allclose(carried(graph, depth, graph), depth, atol=1e-9)


def test_a_new_limb_is_not_known_and_the_old_ones_are_whatever_their_numbers():
    whole = random_tree(1, 9)
    keep = np.flatnonzero(whole.limb != 4)
    keep = keep[[not _grows_on(whole, row, 4) for row in keep]]
    renumber = np.full(len(whole) + 1, -1)
    renumber[keep] = np.arange(len(keep))
    limbs, limb = np.unique(whole.limb[keep], return_inverse=True)
    small = sketch(renumber[whole.parent[keep]], whole.xy[keep], limb).replace(limb_id=whole.limb_id[limbs])
    before, graph = factor_graph(small), factor_graph(whole)
    depth = _depth(before)
    after = carried(before, depth, graph)
    np.testing.assert_allclose(after[keep], depth, rtol=1e-5, atol=1e-5)
    assert np.isnan(after[whole.limb == 4]).all()


def _grows_on(graph, row, limb):
    while row >= 0:
        if graph.limb[row] == limb:
            return True
        row = graph.parent[row]
    return False
