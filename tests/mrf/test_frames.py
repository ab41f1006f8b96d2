"""Chen §4 and Eq. 1: from angles to vectors and back."""

import numpy as np
import pytest

from sketchtree.mrf.frames import child_vector, least_rotation, local_angles, turn_then_tilt, wrap
from sketchtree.mrf.measure import rotations

RNG = np.random.default_rng(3)


def _frames(count):
    unit = RNG.normal(size=(count, 3))
    return least_rotation(unit / np.linalg.norm(unit, axis=1, keepdims=True))


def test_eq1_angles_and_scale_come_back():
    frame, size = _frames(50), RNG.uniform(0.1, 3, 50)
    s, tilt, turn = RNG.uniform(0.2, 2, 50), RNG.uniform(0.01, 3.1, 50), RNG.uniform(-3.1, 3.1, 50)
    v = child_vector(frame, size, s, tilt, turn)
    np.testing.assert_allclose(np.linalg.norm(v, axis=1) / size, s)
    for found, given in zip(local_angles(frame, v), (tilt, turn), strict=True):
        np.testing.assert_allclose(found, given, atol=1e-12)


def test_the_divergence_is_the_angle_between_child_and_parent():
    frame, one = _frames(50), np.ones(50)
    v = child_vector(frame, one, one, tilt := RNG.uniform(0, 3, 50), RNG.uniform(-3, 3, 50))
    cosine = np.einsum("pa,pa->p", v, frame[:, :, 1])
    np.testing.assert_allclose(np.arccos(cosine), tilt, atol=1e-7)


def test_the_child_s_frame_has_y_along_the_child():
    frame, tilt, turn = _frames(20), RNG.uniform(0, 3, 20), RNG.uniform(-3, 3, 20)
    child = frame @ turn_then_tilt(turn, tilt)
    np.testing.assert_allclose(child[..., 1], child_vector(frame, np.ones(20), np.ones(20), tilt, turn))
    np.testing.assert_allclose(child @ np.swapaxes(child, 1, 2), np.broadcast_to(np.eye(3), (20, 3, 3)), atol=1e-12)
    np.testing.assert_allclose(np.linalg.det(child), 1)


@pytest.mark.parametrize("unit", [[0, 1, 0], [1, 0, 0], [0, 0, -1], [0.6, -0.8, 0], [0, -1, 0]])
def test_the_least_rotation_carries_y_there(unit):
    r = least_rotation(np.array(unit, float))
    np.testing.assert_allclose(r @ [0, 1, 0], unit, atol=1e-12)
    np.testing.assert_allclose(r @ r.T, np.eye(3), atol=1e-12)
    angle = np.arccos(np.clip((np.trace(r) - 1) / 2, -1, 1))
    np.testing.assert_allclose(angle, np.arccos(unit[1]), atol=1e-6)


def test_a_straight_child_has_no_orientation():
    assert local_angles(np.eye(3), np.array([0.0, 2.0, 0.0])) == (0.0, 0.0)


def test_wrap_keeps_the_angle_within_half_a_turn():
    found = wrap(np.array([np.pi + 0.1, -np.pi - 0.1, 7.0]))
    np.testing.assert_allclose(found, [0.1 - np.pi, np.pi - 0.1, 7 - 2 * np.pi])


def test_measuring_a_tree_made_of_frames_finds_its_angles():
    s, tilt, turn = [1.2, 0.7], [0.3, 0.9], [0.5, -2.0]
    frame, vector = np.eye(3), [[0.0, 0, 0], [0, 2.0, 0]]
    for k in range(2):
        v = child_vector(frame, np.linalg.norm(vector[-1]), np.array(s[k]), np.array(tilt[k]), np.array(turn[k]))
        frame = frame @ turn_then_tilt(np.array(turn[k]), np.array(tilt[k]))
        vector.append(v)
    parent = np.array([-1, 0, 1, 2])
    found = rotations(parent, parent < 0, np.array(vector))
    np.testing.assert_allclose(found[0], s)
    np.testing.assert_allclose(found[1], tilt)
    np.testing.assert_allclose(found[2], turn)
