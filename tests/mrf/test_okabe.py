"""Okabe's rule: as far apart as the crown's hull of revolution allows."""

import jax
import numpy as np
import pytest

from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.okabe import Okabe, _total_distance
from sketchtree.mrf.prior import Prior
from tests.mrf.drawings import lone_stroke, random_tree, sketch

KEY = jax.random.key(0)


def _depth(graph):
    return infer(graph, Prior(), Okabe(), key=KEY).depth / graph.scale


def _whorl():
    """Four limbs one above the other; the lowest and the highest span the crown."""
    xy = [[0, 0], [0, 40], [0, 50], [0, 60], [0, 70], [0, 100], [50, 60], [-50, 62], [5, 80], [-5, 85]]
    return sketch([-1, 0, 1, 2, 3, 4, 1, 2, 3, 4], xy, [0, 0, 0, 0, 0, 0, 1, 2, 3, 4])


def test_limbs_that_overlap_on_the_page_go_to_opposite_sides():
    depth = _depth(factor_graph(_whorl()))
    assert depth[8] * depth[9] < 0


@pytest.mark.parametrize("seed", range(4))
def test_no_tip_leaves_the_hull_of_revolution(seed):
    graph, solver = factor_graph(random_tree(seed, 15)), Okabe()
    depth, half = _depth(graph), solver._half_depth(graph)
    for limb in np.flatnonzero(graph.limb_parent >= 0):
        reach = graph.limb_length[limb] * np.tan(solver.steepest)
        start = depth[graph.parent[graph.limb_first[limb]]]
        outside = max(0.0, abs(start) - half[limb])
        tip = depth[graph.limb_tip[limb]]
        assert abs(tip) <= max(half[limb], abs(start) - min(outside, reach)) + 1e-9


def test_depth_grows_evenly_along_a_limb(small):
    depth = _depth(small)
    rise = np.diff(depth[[1, 5, 9]])
    assert rise[0] / small.length[5] == pytest.approx(rise[1] / small.length[9])


def test_stems_stay_on_the_page(small):
    assert (_depth(small)[:5] == 0).all()


def test_a_lone_stroke_stays_on_the_page():
    assert (_depth(factor_graph(lone_stroke())) == 0).all()


def test_a_step_places_one_order(small):
    solver = Okabe()
    state = solver.init(small, Prior(), KEY)
    state, _ = solver.step(small, Prior(), state, KEY)
    assert state.depth[5] != 0 and state.depth[10] == 0
    assert not solver.terminate(small, Prior(), state)
    state, _ = solver.step(small, Prior(), state, KEY)
    assert solver.terminate(small, Prior(), state)


def test_the_mirrored_drawing_gives_the_same_depths():
    graph = random_tree(3, 14)
    mirrored = graph.replace(xy=graph.xy * [-1, 1])
    np.testing.assert_allclose(np.abs(_depth(factor_graph(mirrored))), np.abs(_depth(factor_graph(graph))), atol=1e-6)


def test_total_distance_agrees_with_a_plain_sum():
    rng = np.random.default_rng(0)
    q, others = rng.normal(size=(3, 2, 3)), rng.normal(size=(5000, 3))
    slow = [sum(np.linalg.norm(others - point, axis=1).sum() for point in candidate) for candidate in q]
    np.testing.assert_allclose(_total_distance(q, others), slow)


def test_each_choice_is_the_best_of_its_candidates():
    """With one limb, nothing but the stem repels it, so it takes the hull's far end."""
    xy = [[0, 0], [0, 40], [0, 70], [0, 100], [40, 70], [8, 85]]
    graph = factor_graph(sketch([-1, 0, 1, 2, 1, 2], xy, [0, 0, 0, 0, 1, 2]))
    depth, half = _depth(graph), Okabe()._half_depth(graph)
    assert abs(depth[5]) == pytest.approx(min(half[2], graph.limb_length[2] * np.tan(np.radians(70))))
