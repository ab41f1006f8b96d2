import numpy as np
import pytest

from sketchtree.geometry.frames import perpendicular, rotation_minimising


def helix(count, radius=1.0, pitch=0.5, turns=2.0):
    """Points and unit tangents of a helix, and its arc length per radian."""
    angle = np.linspace(0, 2 * np.pi * turns, count)
    speed = np.hypot(radius, pitch)
    point = np.stack([radius * np.cos(angle), pitch * angle, radius * np.sin(angle)], axis=1)
    tangent = np.stack([-radius * np.sin(angle), np.full(count, pitch), radius * np.cos(angle)], axis=1) / speed
    return angle, point, tangent, pitch / speed


def exact(angle, tangent, torsion_share):
    """The helix' rotation-minimising frame: its Frenet frame turned back by the integral of the torsion."""
    normal = np.stack([-np.cos(angle), 0 * angle, -np.sin(angle)], axis=1)
    binormal = np.cross(tangent, normal)
    back = torsion_share * angle  # ∫ τ ds, counter-clockwise in this helix seen against the tangent
    sign = -np.sign(np.sum(np.cross(tangent[0], normal[0]) * np.gradient(normal, angle, axis=0)[0]))
    return np.cos(back)[:, None] * normal + sign * np.sin(back)[:, None] * binormal


def test_frames_are_orthonormal():
    _, point, tangent, _ = helix(200)
    reference = rotation_minimising(point, tangent, np.array([0, 200]), np.array([[1.0, 0.0, 0.0]]))
    np.testing.assert_allclose(np.linalg.norm(reference, axis=1), 1.0, atol=1e-12)
    np.testing.assert_allclose(np.sum(reference * tangent, axis=1), 0.0, atol=1e-12)


def test_double_reflection_follows_the_exact_frame_of_a_helix():
    angle, point, tangent, share = helix(400)
    truth = exact(angle, tangent, share)
    found = rotation_minimising(point, tangent, np.array([0, 400]), truth[:1])
    np.testing.assert_allclose(found, truth, atol=2e-5)


def test_error_is_of_fourth_order():
    errors = []
    for count in (50, 99):
        angle, point, tangent, share = helix(count)
        truth = exact(angle, tangent, share)
        errors.append(np.abs(rotation_minimising(point, tangent, np.array([0, count]), truth[:1])[-1] - truth[-1]).max())
    assert errors[0] / errors[1] > 10


def test_a_plane_curve_does_not_twist():
    angle = np.linspace(0, 1.5, 40)
    point = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    tangent = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=1)
    reference = rotation_minimising(point, tangent, np.array([0, 40]), np.array([[0.0, 0.0, 1.0]]))
    np.testing.assert_allclose(reference, np.broadcast_to([0.0, 0.0, 1.0], (40, 3)), atol=1e-12)


def test_curves_of_different_length_advance_together_as_alone():
    _, p, t, _ = helix(30)
    _, q, u, _ = helix(11, radius=0.3)
    first = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    both = rotation_minimising(np.concatenate([q, p]), np.concatenate([u, t]), np.array([0, 11, 41]), first)
    np.testing.assert_array_equal(both[:11], rotation_minimising(q, u, np.array([0, 11]), first[:1]))
    np.testing.assert_array_equal(both[11:], rotation_minimising(p, t, np.array([0, 30]), first[1:]))


def test_a_point_that_stands_twice_keeps_its_frame():
    point = np.array([[0, 0, 0], [0, 1, 0], [0, 1, 0], [0, 2, 0.0]])
    tangent = np.broadcast_to([0.0, 1.0, 0.0], (4, 3))
    reference = rotation_minimising(point, tangent, np.array([0, 4]), np.array([[0.0, 0.0, -1.0]]))
    np.testing.assert_allclose(reference, np.broadcast_to([0.0, 0.0, -1.0], (4, 3)), atol=1e-12)


@pytest.mark.parametrize("tangent", [(0, 0, 1), (0, 0, -1), (0, 1, 0), (0.6, 0, 0.8)])
def test_perpendicular_is_perpendicular_even_to_a_parallel_wish(tangent):
    found = perpendicular(np.array([[0.0, 0.0, -1.0]]), np.array([tangent], float))
    assert np.linalg.norm(found) == pytest.approx(1.0)
    assert np.dot(found[0], tangent) == pytest.approx(0.0, abs=1e-12)
