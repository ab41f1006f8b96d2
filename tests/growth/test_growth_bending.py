"""Eq. 6-8: how does a branch bend as it grows?"""

import numpy as np
import pytest
from growth_trees import crown

from sketchtree.growth import bending
from sketchtree.growth.layers import Layers
from sketchtree.growth.plan import GrowthPlan
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import is_tip, sum_from_root


def chain_of(ways) -> TreeSkeleton:
    tip = np.r_[np.zeros((1, 3)), np.cumsum(np.array(ways, float), axis=0)]
    return TreeSkeleton.from_columns(np.arange(-1, len(ways)), tip, np.full(len(tip), 0.01))


def bent(tree, degrees):
    layers = Layers.of(tree.parent)
    turn = np.radians(np.broadcast_to(degrees, len(tree)).astype(float))[layers.order][:, None]
    ones = np.ones((len(tree), 1))
    tips = bending.bent(layers, tree.tip[tree.is_base], tree.vector[layers.order], ones, turn)
    return tips[:, layers.place, 0].T


def twin(tree, degrees):
    """Eq. 6-8 unit by unit in frames: T = Π U_i, the axis in the unit's own frame, T ← T R."""
    turned, tip, up = np.eye(3), [tree.tip[0]], np.array([0.0, 1.0, 0.0])
    for row in range(1, len(tree)):
        local = tree.vector[row]
        way = turned @ local
        length = np.linalg.norm(way)
        toward = up if degrees > 0 else -up
        steep = np.hypot(way[0], way[2]) / length
        angle = np.radians(abs(degrees)) * min(1.0, steep / np.sin(np.radians(20)))
        axis = turned.T @ np.cross(way, toward)  # T⁻¹((T ζ) × g)
        axis /= np.linalg.norm(axis)
        cross = np.cross(np.eye(3), axis)  # [γ]×
        a, b, c = np.cos(angle), np.sin(angle), 1 - np.cos(angle)
        turned = turned @ (a * np.eye(3) + b * cross + c * np.outer(axis, axis))
        tip.append(tip[-1] + turned @ local)
    return np.array(tip)


@pytest.mark.parametrize("degrees", [8.0, -8.0])
def test_eq6_to_8_tips_are_those_of_the_product_of_unit_transformations(degrees):
    tree = chain_of([[1, 0.4, 0.2], [1, 0.1, 0.6], [0.7, -0.1, 0.4], [0.9, 0.3, -0.5]])
    assert bent(tree, degrees) == pytest.approx(twin(tree, degrees))


def test_a_level_unit_turns_up_by_a_positive_strength_and_down_by_a_negative_one():
    tree = chain_of([[1, 0, 0]])
    assert bent(tree, 10)[1] == pytest.approx([np.cos(np.radians(10)), np.sin(np.radians(10)), 0])
    assert bent(tree, -10)[1] == pytest.approx([np.cos(np.radians(10)), -np.sin(np.radians(10)), 0])


def test_a_unit_carries_all_that_it_bears():
    tree = chain_of([[1, 0, 0], [1, 0, 0]])
    tips = bent(tree, [0, 10, 0])
    assert tips[2] == pytest.approx(2 * tips[1])


@pytest.mark.parametrize("degrees", [19, -19])
def test_no_unit_turns_past_the_vertical(degrees):
    side = np.diff(bent(chain_of([[1, 0.2, 0.0]] * 30), degrees), axis=0)[:, 0]
    assert (side > 0).all()


def test_a_vertical_unit_stays():
    tree = chain_of([[0, 1, 0], [0, 1, 0]])
    assert np.array_equal(bent(tree, -15), tree.tip)


def test_lengths_stay():
    tree = crown()
    hung = GrowthPlan.of(tree, mode="age", bend=-25).at(1.0)
    assert hung.length == pytest.approx(tree.length)


def test_a_branch_in_the_middle_turns_by_delta_altogether():
    tree = crown()
    assert np.median(sum_from_root(tree.parent, bending.yielding(tree))[is_tip(tree.parent)]) == pytest.approx(1.0)


def test_a_metre_of_thin_wood_gives_way_more_than_a_metre_of_thick_and_the_trunk_least():
    tree = crown()
    per_metre = bending.yielding(tree)[1:] / tree.length[1:]
    thin, thick, trunk = tree.radius[1:] < 0.01, tree.radius[1:] > 0.04, tree.order[1:] == 0
    assert np.median(per_metre[thin]) > 1.5 * np.median(per_metre[thick])
    assert per_metre[trunk & (tree.radius[1:] > 0.15)].max() < 0.3 * np.median(per_metre[thin])


def test_delta_0_leaves_the_tree_as_it_is():
    tree = crown()
    assert GrowthPlan.of(tree, bend=0).at(1.0) is tree


def test_tips_hang_lower_the_lower_delta():
    tree = crown()
    heights = [GrowthPlan.of(tree, bend=delta).at(1.0).tip[:, 1].mean() for delta in (20, 0, -7, -14, -25)]
    assert (np.diff(heights) < 0).all()
