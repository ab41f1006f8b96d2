import dataclasses

import numpy as np
import pytest
from tests.propagate.worlds import HABIT, THETA

from sketchtree import keys, limb_ids
from sketchtree.propagate.blocks.attach_block import LARGEST_REACH, MINIMUM_LENGTH, Nodes, attach
from sketchtree.propagate.blocks.block import blocks_of_parameters

KEY = keys.root_key(0)


def nodes(count=40, order=1, frame=None):
    frame = np.tile(np.eye(3), (count, 1, 1)) if frame is None else frame
    return Nodes(
        row=np.arange(count), tip=np.zeros((count, 3)), frame=frame, limb=np.full(count, 77), order=np.full(count, order),
        tree=np.zeros(count, int), number=np.arange(count), position=np.linspace(0, 1, count),
        zone=np.linspace(0, 1, count), whole=np.full(count, 4.0), radius=np.full(count, 0.1),
    )  # fmt: skip


def attached(habit=HABIT, theta=THETA, key=KEY, spread=0.35, **kwargs):
    blocks = blocks_of_parameters(theta, habit)
    some = np.flatnonzero((blocks.order == 1) & (np.abs(blocks.position - 0.35) < 0.06))
    at = nodes(**kwargs)
    return attach(at, np.resize(some, len(at)), blocks, habit, theta, key, spread=spread)


def test_laterals_are_one_order_up_on_limbs_of_their_own():
    new = attached()
    assert (new.order == 2).all()
    assert len(np.unique(new.limb)) == len(new) == 40
    expected = limb_ids.child_limb_id(np.full(40, 77), np.arange(40) * 64 + 1)
    np.testing.assert_array_equal(new.limb, expected)


def test_a_whorl_puts_all_its_laterals_on_one_node():
    new = attached(dataclasses.replace(HABIT, arrangement="opposite", whorl=2))
    np.testing.assert_array_equal(np.bincount(new.row), np.full(40, 2))
    assert len(np.unique(new.limb)) == 80


def test_angles_are_the_blocks_with_spread_zero():
    habit = dataclasses.replace(HABIT, lateral_angle=50.0)
    new = attached(habit, dataclasses.replace(THETA, sigma_beta=0.0), spread=0.0)
    np.testing.assert_allclose(np.arccos(new.frame[:, 1, 1]), np.radians(50.0), atol=1e-9)


def test_theta_spreads_the_angles():
    theta = dataclasses.replace(THETA, sigma_beta=0.2)
    still, moved = attached(theta=theta, spread=0.0, count=2000), attached(theta=theta, spread=1.0, count=2000)
    change = np.arccos(np.clip(moved.frame[:, 1, 1], -1, 1)) - np.arccos(np.clip(still.frame[:, 1, 1], -1, 1))
    assert np.std(change) == pytest.approx(0.2, rel=0.1)


def test_successive_laterals_of_a_limb_alternate():
    new = attached(dataclasses.replace(HABIT, phyllotaxis=0.0), dataclasses.replace(THETA, sigma_gamma=0.3), spread=0.0)
    side = np.sign(new.frame[:, 0, 1])
    moved = np.abs(new.frame[:, 0, 1]) > 1e-9
    pairs = moved[1:] & moved[:-1]
    assert (side[1:][pairs] == -side[:-1][pairs]).all()


def test_laterals_of_a_trunk_turn_by_the_phyllotaxis():
    habit = dataclasses.replace(HABIT, phyllotaxis=137.5)
    new = attached(habit, spread=0.0, order=0, count=12)
    azimuth = np.arctan2(new.frame[:, 0, 1], new.frame[:, 2, 1])
    turned = np.degrees(np.diff(azimuth)) % 360
    np.testing.assert_allclose(turned, 137.5, atol=1e-6)


def test_no_lateral_is_shorter_than_a_bud_or_longer_than_the_habit_lets_it():
    blocks = blocks_of_parameters(THETA, HABIT)
    blocks = dataclasses.replace(blocks, reach=np.where(blocks.apical, np.nan, np.linspace(0.0, 3.0, len(blocks.apical))))
    at = nodes(len(blocks))
    new = attach(at, np.arange(len(blocks)), blocks, HABIT, THETA, KEY)
    assert len(new) < len(blocks)
    assert new.length.min() >= MINIMUM_LENGTH * HABIT.twig_length
    assert new.length.max() <= LARGEST_REACH * HABIT.lateral_ratio * 4.0 * np.exp(0.5)


def test_the_same_key_draws_the_same_and_another_does_not():
    one, two, other = attached(), attached(), attached(key=keys.root_key(1))
    np.testing.assert_array_equal(one.frame, two.frame)
    assert not np.array_equal(one.frame, other.frame)


def test_a_word_serves_as_the_key():
    np.testing.assert_array_equal(attached().length, attached(key=keys.draw_key(KEY)).length)


@pytest.mark.parametrize("order, axis", [(0, 2), (0, 1), (2, 1)])
def test_turning_the_nodes_turns_what_is_attached(order, axis):
    """A block is oriented in the frame it is attached to: on a trunk however that stands, on a limb turned about the vertical."""
    c, s = np.cos(0.7), np.sin(0.7)
    turned = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]]) if axis == 2 else np.array([[c, 0, s], [0, 1.0, 0], [-s, 0, c]])
    plain = attached(order=order)
    moved = attached(frame=np.tile(turned, (40, 1, 1)) @ nodes(40, order).frame, order=order)
    np.testing.assert_allclose(moved.frame, turned @ plain.frame, atol=1e-12)


def test_on_a_limb_above_and_below_are_those_of_the_vertical_however_it_was_spun():
    lying = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
    c, s = np.cos(1.1), np.sin(1.1)
    spun = lying @ np.array([[c, 0, s], [0, 1.0, 0], [-s, 0, c]])
    one, other = (attached(frame=np.tile(frame, (40, 1, 1)), order=2) for frame in (lying, spun))
    np.testing.assert_allclose(one.frame, other.frame, atol=1e-12)
