"""Eq. 1: where the plane seen at a pixel appears in another photo."""

import numpy as np
import pytest
from ring import camera_at

from sketchtree.multiview.homography import homography, normals_of, plane_of, transfer

ONE, OTHER = camera_at(10.0), camera_at(24.0, height=0.9)
NORMAL = np.array([0.3, -0.2, -0.93]) / np.linalg.norm([0.3, -0.2, -0.93])  # in the first camera
POINT = np.array([0.1, -0.2, 3.0])


def on_plane(chance, count=20):
    """Places of the plane in the world, and their pixels."""
    side = np.linalg.svd(NORMAL[None])[2][1:]
    local = POINT + chance.uniform(-0.3, 0.3, (count, 2)) @ side
    return local @ ONE.rotation + ONE.centre


def carried(h, pixel):
    there = np.column_stack([pixel, np.ones(len(pixel))]) @ h.T
    return there[:, :2] / there[:, 2:]


def test_eq1_carries_every_pixel_of_the_plane_over():
    xyz = on_plane(np.random.default_rng(0))
    found = carried(homography(ONE, OTHER, POINT, NORMAL), ONE.project(xyz)[0])
    np.testing.assert_allclose(found, OTHER.project(xyz)[0], atol=1e-9)


def test_eq1_with_the_printed_sign_of_v_does_not():
    xyz = on_plane(np.random.default_rng(0))
    turn = OTHER.rotation @ ONE.rotation.T
    v = -NORMAL @ POINT
    printed = OTHER.matrix @ (turn - np.outer(OTHER.rotation @ (OTHER.centre - ONE.centre), NORMAL) / v) @ np.linalg.inv(ONE.matrix)
    assert np.abs(carried(printed, ONE.project(xyz)[0]) - OTHER.project(xyz)[0]).max() > 5


def test_inverse_depth_is_affine_and_says_the_same():
    xyz = on_plane(np.random.default_rng(1))
    pixel, depth = ONE.project(xyz)
    rho, across, down = plane_of(ONE, pixel[0], POINT, NORMAL)
    inverse = rho + (pixel - pixel[0]) @ [across, down]
    np.testing.assert_allclose(inverse, 1 / depth)
    found = np.column_stack([pixel, np.ones(len(pixel)), inverse]) @ transfer(ONE, OTHER).T
    np.testing.assert_allclose(found[:, :2] / found[:, 2:], OTHER.project(xyz)[0], atol=1e-9)
    np.testing.assert_allclose(found[:, 2], OTHER.project(xyz)[1] / depth)


def test_normals_come_back_and_look_at_the_camera():
    pixel = np.array([[30.0, 40.0], [60.0, 20.0]])
    plane = np.array([plane_of(ONE, at, POINT, NORMAL) for at in pixel])
    np.testing.assert_allclose(normals_of(ONE, pixel, plane), np.tile(NORMAL @ ONE.rotation, (2, 1)) * -np.sign(NORMAL @ POINT))
    assert (normals_of(ONE, pixel, plane) @ (ONE.centre - POINT @ ONE.rotation - ONE.centre) > 0).all()


def test_a_camera_onto_itself_leaves_pixels_where_they_are():
    np.testing.assert_allclose(transfer(ONE, ONE) @ [12.0, 34.0, 1.0, 0.4], [12.0, 34.0, 1.0], atol=1e-9)
    assert homography(ONE, ONE, POINT, NORMAL) == pytest.approx(np.eye(3), abs=1e-9)
