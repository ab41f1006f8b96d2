"""The compiled drawing: normalised, and with the right relations."""

import numpy as np
import pytest

from sketchtree.mrf.factor_graph import SHORTEST, factor_graph
from tests.mrf.drawings import random_tree, shrub, sketch, small_tree


def test_height_is_one_and_the_first_base_is_at_the_origin(small):
    assert small.scale == 105
    assert np.ptp(small.xy, axis=0).max() == pytest.approx(1.0, abs=1e-6)
    assert (small.xy[0] == 0).all()


@pytest.mark.parametrize("scale, shift", [(1e6, 0.0), (1e-3, 0.0), (0.1, 1e4), (3.7, -55.5)])
def test_units_and_place_on_the_page_do_not_matter(scale, shift):
    plain, other = factor_graph(small_tree()), factor_graph(small_tree().replace(xy=small_tree().xy * scale + shift))
    for name in ("xy", "length", "direction", "insertion", "trunk_x", "half_width", "competitor", "sibling", "radius"):
        np.testing.assert_allclose(getattr(plain, name), getattr(other, name), rtol=0, atol=1e-12, err_msg=name)
    assert (plain.xy == other.xy).all()


def test_a_mirrored_drawing_differs_in_the_sign_of_x_alone():
    plain, other = factor_graph(small_tree()), factor_graph(small_tree().replace(xy=small_tree().xy * [-1, 1]))
    assert (plain.xy == other.xy * [-1, 1]).all()
    assert (plain.trunk_x == -other.trunk_x).all()
    assert (plain.half_width == other.half_width).all()
    assert (plain.competitor == other.competitor).all()


def test_directions_and_lengths_are_those_of_the_drawing(small):
    row = 5
    drawn = small_tree().xy[row] - small_tree().xy[1]
    np.testing.assert_allclose(small.length[row], np.linalg.norm(drawn) / 105, atol=1e-6)
    np.testing.assert_allclose(small.direction[row], drawn / np.linalg.norm(drawn), atol=1e-5)


def test_a_segment_without_length_is_clamped_and_takes_its_parent_s_direction():
    xy = small_tree().xy.copy()
    xy[2] = xy[1]
    graph = factor_graph(small_tree().replace(xy=xy))
    assert graph.length[2] == SHORTEST
    np.testing.assert_array_equal(graph.direction[2], graph.direction[1])


def test_insertions_are_shares_of_the_parent_limb(small):
    assert small.insertion[0] == 0
    assert 0 < small.insertion[1] < small.insertion[2] < small.insertion[4] < 1
    assert small.insertion[2] == small.insertion[3]


def test_siblings_are_ranked_along_their_parent_limb_up_to_three_apart(small):
    pairs = {tuple(pair): int(gap) for pair, gap in zip(small.sibling, small.rank_gap)}
    assert pairs == {(1, 2): 1, (2, 3): 1, (3, 4): 1, (1, 3): 2, (2, 4): 2, (1, 4): 3}


def test_sixty_siblings_at_one_node_give_at_most_three_pairs_each():
    n = 60
    xy = [[0, 0], [0, 50], *[[np.cos(k) * 40, 60 + np.sin(k) * 40] for k in range(n)]]
    graph = factor_graph(sketch([-1, 0] + [1] * n, xy, [0, 0, *range(1, n + 1)]))
    assert len(graph.sibling) == 3 * n - 6


def test_kin_do_not_compete(small):
    for i, k in small.competitor:
        assert small.limb[i] != small.limb[k]
        assert small.parent[i] != small.parent[k]
        assert k not in (small.parent[i],) and i not in (small.parent[k],)


def test_competition_pairs_stay_proportional_to_the_drawing():
    small, large = (factor_graph(random_tree(0, limbs)) for limbs in (100, 400))
    assert len(large.competitor) <= 16 * 2 * large.limb_count
    assert len(small.competitor) > 0


def test_the_half_width_is_that_of_a_drawn_crown():
    t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    circle = np.c_[60 * np.cos(t), 70 + 60 * np.sin(t)]
    graph = factor_graph(small_tree().replace(crown=(circle,)))
    y = graph.xy[graph.limb_tip[1], 1] * graph.scale
    assert graph.half_width[1] * graph.scale == pytest.approx(np.sqrt(60**2 - (y - 70) ** 2), rel=2e-3)


def test_the_trunk_line_is_the_trunk_s_own_x(small):
    trunk = small.outline.trunk_x(small.xy[:5, 1], np.zeros(5, int))
    np.testing.assert_allclose(trunk, small.xy[:5, 0], atol=1e-12)


def test_drawn_widths_become_radii_and_the_rest_tapers():
    width = np.full(11, np.nan)
    width[5] = 6.0
    graph = factor_graph(small_tree().replace(width=width))
    assert graph.radius[5] * graph.scale == 3.0
    assert (graph.radius > 0).all()
    assert graph.radius[1] > graph.radius[4]
    assert graph.radius[8] < graph.radius[4] * 1.3


def test_it_prints_as_one_line(small):
    assert str(small) == (
        "FactorGraph: 10 segments, 6 limbs up to order 2, 6 sibling pairs, "
        f"{len(small.competitor)} competition pairs; H = 105 sketch units"
    )


def test_the_stems_of_a_shrub_spread_and_are_siblings():
    graph = factor_graph(shrub())
    assert graph.limb_spreads.all()
    assert {tuple(sorted(pair)) for pair in graph.sibling.tolist()} == {(0, 1), (1, 2), (2, 3), (0, 2), (1, 3), (0, 3)}


def test_one_or_two_stems_do_not_spread(small):
    assert small.limb_spreads.tolist() == [False, True, True, True, True, True]


def test_two_trees_each_have_their_own_trunk_line():
    left = small_tree()
    parent = np.r_[left.parent, np.where(left.parent < 0, -1, left.parent + 11)]
    graph = factor_graph(
        sketch(parent, np.r_[left.xy, left.xy + [300, 0]], np.r_[left.limb, left.limb + 6], tree=np.repeat([0, 1], 11))
    )
    np.testing.assert_allclose(graph.trunk_x[6:] - graph.trunk_x[:6], 300 / graph.scale, atol=1e-5)
    np.testing.assert_allclose(graph.half_width[6:], graph.half_width[:6], atol=1e-5)
