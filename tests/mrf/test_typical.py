"""What is shown of many samples; and limbs that give way."""

import numpy as np
import pytest

from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.answer.interpenetration import moved_apart
from sketchtree.mrf.answer.typical import (
    CROWN_LIMIT,
    STEM_SHARE,
    depth_of,
    most_typical,
    side_view,
    stretched_crown,
    typical_readings,
)
from tests.mrf.drawings import lone_stroke, sketch, small_tree
from tests.twins import limb_model as twin


def typical_elevation(graph, samples, trees):
    """ψ of the most typical reading."""
    readings, some = typical_readings(graph, samples, trees)
    return readings[:, most_typical(graph, readings, some)]


def test_depth_is_the_sum_along_the_way(small):
    psi = np.where(small.is_base, 0.0, np.random.default_rng(0).normal(0, 0.5, len(small)))
    np.testing.assert_allclose(depth_of(small, psi), np.array(twin.vectors(small, psi)[2])[:, 2], atol=1e-12)


def test_many_samples_at_once_are_the_same_as_one_by_one(small):
    psi = np.random.default_rng(0).normal(0, 0.5, (len(small), 4))
    together = depth_of(small, psi)
    for k in range(4):
        np.testing.assert_allclose(together[:, k], depth_of(small, psi[:, k]))


def test_signs_are_a_tree_s_and_steepness_is_the_median(small):
    rng = np.random.default_rng(1)
    size = np.where(small.is_base, 0.0, 0.5)
    samples = size * rng.choice([-1, 1], (9, len(small)))
    best = np.where(small.is_base, 0.0, np.where(np.arange(len(small)) % 2, -0.1, 0.1))
    psi = typical_elevation(small, samples, best[None])
    lateral = small.order > 0
    assert (np.sign(psi[lateral]) == np.sign(best[lateral])).all()
    np.testing.assert_allclose(np.abs(psi[1:5]), STEM_SHARE * 0.5)


def test_the_crown_is_stretched_towards_the_samples_extent_within_limits(small):
    psi = np.where(small.order > 0, 0.3, 0.0)
    for factor in (1.2, 10.0):
        sample = np.arctan(factor * np.tan(psi))
        ratio = np.ptp(depth_of(small, stretched_crown(small, psi[:, None], sample[:, None])[:, 0])) / np.ptp(depth_of(small, psi))
        assert 1.0 < ratio <= CROWN_LIMIT + 1e-9
        assert ratio <= factor


def test_a_lone_stroke_is_not_stretched():
    graph = factor_graph(lone_stroke())
    psi = np.zeros((len(graph), 1))
    np.testing.assert_array_equal(stretched_crown(graph, psi, psi), psi)


def test_signs_are_those_of_the_tree_that_looks_most_like_the_samples(small):
    """Samples have limbs before and behind the trunk; one tree has all of them before it."""
    lateral = small.order > 0
    shared = np.where(lateral, np.where(small.limb % 2, 0.5, -0.5), 0.0)
    samples = np.array([shared, -shared, 0.9 * shared, 1.1 * shared])
    for trees, expected in (([np.abs(shared), shared], 1), ([-shared, np.abs(shared)], 0)):
        psi = typical_elevation(small, samples, np.array(trees))
        np.testing.assert_array_equal(np.sign(psi[lateral]), np.sign(trees[expected])[lateral])
        assert most_typical(small, np.array(trees).T, samples.T) == expected


def test_a_side_view_is_the_reach_of_the_hull(small):
    psi = np.where(small.order > 0, 0.4, 0.0)
    z, lateral = depth_of(small, psi), small.order > 0
    view = side_view(small, np.c_[psi, -psi])
    assert view[0, 0, 8] == pytest.approx(z[lateral].max())
    assert view[0, 1, 8] == pytest.approx((-z[lateral]).max())
    np.testing.assert_allclose(view[0], view[1, ::-1])
    np.testing.assert_allclose(view[0, :, -1], small.xy[lateral, 1].max())


def _crossing(depth=0.0):
    """Two limbs from either side of a trunk that cross on the page, drawn thick."""
    xy = [[0, 0], [-20, 30], [20, 30], [0, 40], [-20, 60], [20, 60], [25, 90], [-25, 90], [0, 80]]
    parent, limb = [-1, 0, 0, 0, 1, 2, 4, 5, 3], [0, 1, 2, 0, 1, 2, 1, 2, 0]
    return factor_graph(sketch(parent, xy, limb, width=np.full(9, 4.0)))


def test_overlapping_limbs_give_way_until_they_are_free():
    graph = _crossing()
    depth = moved_apart(graph, np.zeros(len(graph)))
    assert abs(depth[6] - depth[7]) > 0
    assert depth[0] == 0
    again = moved_apart(graph, depth)
    np.testing.assert_array_equal(again, depth)


def test_limbs_that_are_free_are_left_alone():
    graph = _crossing()
    depth = np.array([0, 0, 0, 0, 0.3, -0.3, 0.5, -0.5, 0])
    np.testing.assert_array_equal(moved_apart(graph, depth), depth)


@pytest.mark.parametrize("make", [small_tree, lone_stroke])
def test_drawings_without_overlap_keep_every_bit(make):
    graph = factor_graph(make())
    depth = np.zeros(len(graph)) if make is lone_stroke else np.where(graph.order > 0, 0.2 * graph.limb, 0.0)
    np.testing.assert_array_equal(moved_apart(graph, depth), depth)
