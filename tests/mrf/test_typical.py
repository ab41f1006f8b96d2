"""What is shown of many samples; and limbs that give way."""

import numpy as np
import pytest

from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.answer.interpenetration import moved_apart
from sketchtree.mrf.answer.crown import LIMIT, extents, reach, stretched_crown
from sketchtree.mrf.answer.stems import TURN, is_stem
from sketchtree.mrf.answer.typical import most_typical, side_view, typical_readings
from sketchtree.mrf.depths import depth_of
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
    z = depth_of(small, np.where(lateral, psi, 0.0))
    inner = lateral & (reach(small, z[:, None])[:, 0] < 0.5)
    np.testing.assert_allclose(np.abs(psi[inner]), 0.5, rtol=0.2)  # what reaches far is stretched, the rest hardly


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_leaning_stem_is_turned_out_of_the_page_in_one_plane(side):
    xy = [[0, 0], [5, 30], [20, 55], [15, 80], [25, 100], [-30, 70], [50, 90]]
    graph = factor_graph(sketch([-1, 0, 1, 2, 3, 1, 2], xy, [0, 0, 0, 0, 0, 1, 2]))
    tree = np.where(graph.is_base, 0.0, np.where(graph.order > 0, 0.4, side * 0.02 * np.sign(graph.direction[:, 0])))
    psi = typical_elevation(graph, tree[None], tree[None])
    stem = is_stem(graph)
    z = depth_of(graph, psi)
    assert stem.sum() == 4
    np.testing.assert_allclose(z[stem], side * TURN * graph.xy[stem, 0], rtol=1e-3)


def test_a_limb_that_hardly_passes_the_page_does_not_zigzag(small):
    """Steep in most samples; in the tree whose signs are taken its first segment lies just behind the page."""
    lateral = small.order > 0
    sample = np.where(lateral, 0.5, 0.0)
    tree = sample.copy()
    tree[small.limb_first[1]] = -0.02
    psi = typical_elevation(small, sample[None], tree[None])
    assert (psi[lateral] > 0).all()


def test_a_planar_tree_keeps_its_stem_on_the_page():
    xy = [[0, 0], [5, 30], [20, 55], [-30, 70], [50, 90]]
    graph = factor_graph(sketch([-1, 0, 1, 1, 2], xy, [0, 0, 0, 1, 2]))
    tree = np.where(graph.order > 0, 0.1, 0.05)[None]
    readings, _ = typical_readings(graph, tree, tree, planar=True)
    np.testing.assert_array_equal(readings[is_stem(graph)], 0.0)


def test_a_straight_upright_stem_stays_where_it_is():
    graph = factor_graph(sketch([-1, 0, 1, 1], [[0, 0], [0, 40], [0, 100], [30, 90]], [0, 0, 0, 1]))
    tree = np.where(graph.is_base, 0.0, 0.2)[None]
    readings, _ = typical_readings(graph, tree, tree)
    np.testing.assert_array_equal(readings[is_stem(graph)], 0.0)


def test_the_crown_is_stretched_towards_its_goal_within_limits(small):
    psi = np.where(small.order > 0, 0.3, 0.0)
    own = extents(small, depth_of(small, psi)[:, None])[0, 0]
    width = np.ptp(small.xy[:, 0])
    for factor in (1.0, 1.5, 10.0):
        sample = np.arctan(factor * np.tan(psi))
        shown = stretched_crown(small, psi[:, None], sample[:, None])
        goal = own * np.clip((np.sqrt(factor * own * width) / own) ** 0.85, 1 / LIMIT, LIMIT)
        np.testing.assert_allclose(extents(small, depth_of(small, shown)), goal, rtol=0.02)
        flat = stretched_crown(small, psi[:, None], sample[:, None], planar=True)
        np.testing.assert_allclose(extents(small, depth_of(small, flat)), own * min(factor**0.85, LIMIT), rtol=0.02)


def test_limbs_in_the_middle_of_the_crown_keep_their_steepness(small):
    psi = np.where(small.order > 0, 0.02, 0.0)
    far = small.limb == np.argmax(small.limb_length * (small.limb_order > 0))
    psi[far] = 0.7
    shown = stretched_crown(small, psi[:, None], np.arctan(3 * np.tan(psi))[:, None])[:, 0]
    away = ~far & (small.order > 0) & (reach(small, depth_of(small, psi)[:, None])[:, 0] < 0.2)
    assert away.any()
    assert (np.tan(shown[far]) > 1.2 * np.tan(psi[far])).all()
    np.testing.assert_allclose(shown[away], psi[away], rtol=0.1)


def test_every_tree_of_a_drawing_is_stretched_by_itself():
    xy = [[0, 0], [0, 50], [-30, 90], [30, 90], [200, 0], [200, 50], [190, 60], [210, 60]]
    graph = factor_graph(sketch([-1, 0, 1, 1, -1, 4, 5, 5], xy, [0, 0, 1, 2, 3, 3, 4, 5], tree=[0, 0, 0, 0, 1, 1, 1, 1]))
    psi = np.where(graph.order > 0, np.where(graph.limb % 2, 0.3, -0.3), 0.0)[:, None]
    shown = stretched_crown(graph, psi, psi)
    alone = factor_graph(sketch([-1, 0, 1, 1], xy[:4], [0, 0, 1, 2]))
    one = np.where(alone.order > 0, np.where(alone.limb % 2, 0.3, -0.3), 0.0)[:, None]
    np.testing.assert_allclose(shown[:4], stretched_crown(alone, one, one), rtol=1e-6, atol=1e-9)


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
