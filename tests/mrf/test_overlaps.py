"""Interpenetrating branches are moved away from each other along z (Chen §5.2.1)."""

import jax
import numpy as np

from sketchtree.mrf.chen.move_apart import MoveApart
from sketchtree.mrf.overlaps import candidates, pushes
from sketchtree.mrf.chen.estep import Reading
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.parameters import GENERIC
from tests.mrf.drawings import random_tree, sketch

KEY = jax.random.key(0)


def _crossing():
    """Two limbs of the trunk that cross on the page, far from their forks."""
    xy = [[0, 0], [0, 30], [0, 90], [0, 120], [30, 50], [60, 80], [30, 75], [60, 45]]
    return factor_graph(sketch([-1, 0, 1, 2, 1, 4, 2, 6], xy, [0, 0, 0, 0, 1, 1, 2, 2]))


def _apart(graph, depth):
    return MoveApart()(graph, GENERIC, Reading(np.array(depth, float), np.zeros(len(graph), int)), KEY).depth


def test_only_pairs_that_are_no_kin_are_candidates():
    graph = _crossing()
    assert candidates(graph).tolist() == [[5, 7]]


def test_crossing_limbs_end_up_clear_of_each_other():
    graph = _crossing()
    pair, flat = candidates(graph), np.zeros(8)
    assert pushes(graph, flat, pair).any()
    depth = _apart(graph, flat)
    assert not pushes(graph, depth, pair).any()
    assert depth[5] * depth[7] < 0


def test_limbs_that_are_clear_are_left_alone():
    graph = _crossing()
    depth = np.array([0, 0, 0, 0, 0.1, 0.2, -0.1, -0.2])
    np.testing.assert_array_equal(_apart(graph, depth), depth)


def test_the_nearer_one_comes_forward():
    graph = _crossing()
    depth = _apart(graph, [0, 0, 0, 0, 0, 0.001, 0, -0.001])
    assert depth[5] > 0 > depth[7]


def test_stems_stay_where_they_are():
    graph = factor_graph(random_tree(1, 25))
    depth = _apart(graph, np.zeros(len(graph)))
    assert depth[0] == depth[1] == 0


def test_what_grows_from_a_moved_tip_moves_with_it():
    xy = [[0, 0], [0, 30], [0, 90], [0, 120], [30, 50], [60, 80], [30, 75], [60, 45], [70, 100]]
    graph = factor_graph(sketch([-1, 0, 1, 2, 1, 4, 2, 6, 5], xy, [0, 0, 0, 0, 1, 1, 2, 2, 1]))
    depth = _apart(graph, np.zeros(9))
    assert depth[8] == depth[5] != 0


def test_a_lone_segment_has_no_pair():
    assert candidates(factor_graph(sketch([-1, 0], [[0, 0], [0, 1]], [0, 0]))).shape == (0, 2)
