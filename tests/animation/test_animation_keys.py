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


def one_by_one(time, value, tolerance):
    """The moments kept of one track, a stretch at a time."""

    def within(low, high):
        if high - low < 2:
            return []
        share = (time[low + 1 : high] - time[low]) / (time[high] - time[low])
        away = np.abs(value[low + 1 : high] - (value[low] + share[:, None] * (value[high] - value[low]))).max(axis=1)
        at = low + 1 + int(away.argmax())
        return [*within(low, at), at, *within(at, high)] if away.max() > tolerance else []

    return [0, *within(0, len(time) - 1), len(time) - 1]


def test_all_tracks_at_once_are_cut_as_each_by_itself():
    rng = np.random.default_rng(3)
    value = np.cumsum(rng.normal(0, 0.02, (9, 61, 4)), axis=1)
    value[3], value[4, 20:50], value[5] = np.round(value[3], 1), value[4, 20], np.linspace(0, 1, 61)[:, None]  # moments that are as far as others; a stretch at rest; a line
    tolerance = rng.uniform(0.005, 0.05, 9)
    keys = fewest_keys(np.arange(9), TIME, value, np.full((9, 4), -9.0), tolerance)
    for track in range(9):
        kept = one_by_one(TIME, value[track], tolerance[track])
        assert keys.time[keys.start[track] : keys.start[track + 1]].tolist() == TIME[kept].tolist()
