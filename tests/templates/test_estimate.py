"""Θ is found again in a tree built from it (§4)."""

import numpy as np
import pytest

from benchmarks.theta import tree_of
from sketchtree.parameters import GENERIC, TreeParameters
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.estimate import (
    SHRINKAGE,
    circular_mean,
    circular_sd,
    estimate,
    estimate_by_order,
    parent_child_pairs,
)

THETA = TreeParameters(0.9, 0.15, np.radians(15), np.radians(4), np.radians(50), np.radians(6), np.radians(40), np.radians(12))


def about_y(t):
    return np.array([[np.cos(t), 0, np.sin(t)], [0, 1, 0], [-np.sin(t), 0, np.cos(t)]])


def test_every_pair_gives_back_its_scale_divergence_and_orientation():
    tree, truth = tree_of(THETA, 3)
    pairs = parent_child_pairs(tree)
    np.testing.assert_allclose(pairs.scale, truth[:, 0], rtol=1e-9)
    np.testing.assert_allclose(pairs.divergence, truth[:, 1], atol=1e-9)
    np.testing.assert_allclose(np.exp(1j * pairs.orientation), np.exp(1j * truth[:, 2]), atol=1e-7)
    np.testing.assert_array_equal(pairs.apical, truth[:, 3].astype(bool))


def test_theta_is_recovered_from_a_tree_built_with_it():
    found = estimate(tree_of(THETA, 3)[0]).as_dict(degrees=True)
    for name, value in THETA.as_dict(degrees=True).items():
        tolerance = 0.03 if name.endswith("_s") else 2.0
        assert found[name] == pytest.approx(value, abs=tolerance), name


def test_theta_does_not_change_when_the_tree_is_turned_about_its_trunk_scaled_or_moved():
    tree, _ = tree_of(THETA, 3)
    turned = tree.replace(tip=7.0 * tree.tip @ about_y(1.1).T + [3.0, 0.0, -2.0])
    before, after = estimate(tree).as_dict(), estimate(turned).as_dict()
    for name in ("mu_gamma", "sigma_gamma"):  # counted from the world's x in the pairs next to the base only
        assert after.pop(name) == pytest.approx(before.pop(name), abs=0.1)
    assert after == pytest.approx(before, rel=1e-6)


def test_orders_are_shrunk_towards_the_whole_tree():
    tree, _ = tree_of(THETA, 3)
    whole, orders = estimate(tree), estimate_by_order(tree)
    pairs = parent_child_pairs(tree)
    of_trunk = pairs.divergence[(tree.order[pairs.parent] == 0) & ~pairs.apical]
    expected = (of_trunk.sum() + SHRINKAGE * whole.mu_beta) / (len(of_trunk) + SHRINKAGE)
    assert orders[0].mu_beta == pytest.approx(expected)
    straight = TreeSkeleton.from_columns([-1, 0, 1, 2], np.outer(np.arange(4), [0, 1, 0]), np.full(4, 0.1))
    assert estimate_by_order(straight)[2] == estimate(straight), "an order without pairs has the tree's own Θ"


def test_a_lone_segment_has_the_generic_theta():
    assert estimate(TreeSkeleton.from_columns([-1, 0], [[0, 0, 0], [0, 1, 0]], [0.1, 0.1])) == GENERIC


def test_where_a_limb_ends_in_several_the_smallest_divergence_is_apical():
    tip = [[0, 0, 0], [0, 1, 0], [1, 1.2, 0], [0.1, 2, 0]]
    tree = TreeSkeleton.from_columns([-1, 0, 1, 1], tip, np.full(4, 0.1), limb=np.array([0, 0, 1, 2]), order=np.array([0, 0, 1, 1]))
    pairs = parent_child_pairs(tree)
    np.testing.assert_array_equal(pairs.apical, [False, True])


def test_segments_of_no_length_are_left_out():
    tip = [[0, 0, 0], [0, 1, 0], [0, 1, 0], [0, 2, 0]]
    pairs = parent_child_pairs(TreeSkeleton.from_columns([-1, 0, 1, 2], tip, np.full(4, 0.1)))
    assert len(pairs.child) == 0
    tree = TreeSkeleton.from_columns([-1, 0, 1, 2, 3], [*tip, [0, 3, 1]], np.full(5, 0.1))
    np.testing.assert_allclose(parent_child_pairs(tree).divergence, np.pi / 4)


def test_circular_statistics_wrap_round():
    angle = np.radians([170, -170, 180])
    assert abs(circular_mean(angle)) == pytest.approx(np.pi)
    assert circular_sd(angle) == pytest.approx(np.std(np.radians([-10, 10, 0])), rel=0.01)
    assert circular_sd(np.zeros(0)) == 0.0
    assert circular_mean(np.array([0.0, np.pi])) in (0.0, pytest.approx(np.pi / 2))
    assert circular_mean(np.zeros(2), weight=2.0, towards=np.pi / 2) == pytest.approx(np.pi / 4)
