"""Flat and random-sign: what they promise."""

import jax
import numpy as np
import pytest

from sketchtree.mrf.baselines import Flat, RandomSign, depth_of, unit_vector
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.prior import Prior
from tests.mrf.drawings import lone_stroke, random_tree, small_tree

KEY = jax.random.key(4)


def test_flat_leaves_the_drawing_on_the_page(small):
    assert (infer(small, Prior(), Flat(), key=KEY).depth == 0).all()


def test_laterals_leave_at_the_angle_where_they_can():
    graph = factor_graph(small_tree())
    depth = infer(graph, Prior(), RandomSign(), key=KEY).depth / graph.scale
    tip = np.c_[graph.xy, depth]
    v = tip - tip[np.maximum(graph.parent, 0)]
    for row in np.flatnonzero(graph.is_lateral):
        u = v[graph.parent[row]]
        angle = np.degrees(np.arccos(v[row] @ u / np.linalg.norm(v[row]) / np.linalg.norm(u)))
        steepness = np.degrees(np.arcsin(abs(v[row, 2]) / np.linalg.norm(v[row])))
        assert angle == pytest.approx(50) or angle > 50 or steepness == pytest.approx(60)


def test_a_limb_keeps_the_elevation_of_its_start(small):
    depth = infer(small, Prior(), RandomSign(), key=KEY).depth / small.scale
    slope = (depth - depth[np.maximum(small.parent, 0)]) / np.maximum(small.length, 1e-9)
    assert slope[9] == pytest.approx(slope[5])


def test_the_side_is_chance():
    graph = factor_graph(random_tree(0, 12))
    first, again, other = (infer(graph, Prior(), RandomSign(), key=jax.random.key(k)).depth for k in (0, 0, 1))
    assert (first == again).all() and not np.allclose(first, other)


def test_stems_and_lone_strokes_stay_on_the_page(small):
    assert (infer(small, Prior(), RandomSign(), key=KEY).depth[:5] == 0).all()
    assert (infer(factor_graph(lone_stroke()), Prior(), RandomSign(), key=KEY).depth == 0).all()


def test_depth_is_the_sum_of_the_rises(small):
    elevation = np.where(small.is_base, 0, 0.2)
    depth = depth_of(small, elevation)
    assert depth[10] == pytest.approx(np.tan(0.2) * small.length[[1, 2, 5, 10]].sum() - np.tan(0.2) * small.length[2])
    np.testing.assert_allclose(np.linalg.norm(unit_vector(small.direction[5], 0.2)), 1)
