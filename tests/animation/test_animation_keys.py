"""Keys are as few as the tolerance lets them be, and nowhere farther from the motion."""

import numpy as np
import pytest

from sketchtree.animation.keys import fewest_keys, one_sided

TIME = np.linspace(0, 1, 61)


def between(keys, track):
    low, high = keys.start[track], keys.start[track + 1]
    return np.stack([np.interp(TIME, keys.time[low:high], channel) for channel in keys.value[low:high].T], axis=1)


@pytest.mark.parametrize("seed", range(5))
def test_no_moment_is_farther_than_the_tolerance(seed):
    rng = np.random.default_rng(seed)
    value = np.cumsum(rng.normal(0, 0.02, (7, 61, 3)), axis=1)
    tolerance = rng.uniform(0.005, 0.05, 7)
    keys = fewest_keys(np.arange(7), TIME, value, np.zeros((7, 3)), tolerance)
    for track, joint in enumerate(keys.joint):
        assert np.abs(between(keys, track) - value[joint]).max() <= tolerance[joint] + 1e-12


def test_a_straight_way_between_two_rests_needs_four_keys():
    way = np.clip((TIME - 0.25) / 0.5, 0, 1)[None, :, None]
    keys = fewest_keys(np.array([4]), TIME, way, np.zeros((1, 1)), 1e-6)
    assert len(keys.time) == 4 and keys.joint.tolist() == [4]


def test_what_stays_at_rest_has_no_track():
    value = np.ones((3, 61, 3))
    value[1, 30:] = 2.0
    assert fewest_keys(np.arange(3), TIME, value, np.ones((3, 3)), 1e-3).joint.tolist() == [1]


def test_neighbouring_turns_are_on_one_side():
    turn = np.random.default_rng(0).normal(size=(4, 20, 4))
    sided = one_sided(turn)
    assert (np.sum(sided[:, 1:] * sided[:, :-1], axis=2) >= 0).all()
    assert np.allclose(np.abs(np.sum(sided * turn, axis=2)), np.sum(turn * turn, axis=2))
