"""Up is found from how cameras are held and where they stand."""

import numpy as np
import pytest
from ring import camera_at

from sketchtree.multiview.upright import moved_upright, turn_up, up_of

ANY = turn_up(np.array([0.3, 0.5, -0.6]))
RING = [camera_at(30.0 * k, height=1.2) for k in range(8)]
POINTS = np.array([[0.0, 0.5, 0.0], [0.0, 1.5, 0.0]])


@pytest.mark.parametrize("up", [(0, 1, 0), (0, -1, 0), (1, 0, 0), (0.3, 0.5, -0.6)])
def test_any_direction_is_turned_up(up):
    turn = turn_up(np.array(up))
    np.testing.assert_allclose(turn @ (up / np.linalg.norm(up)), [0, 1, 0], atol=1e-12)
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(turn) == pytest.approx(1)


def test_a_ring_of_cameras_tells_up_whichever_way_the_world_lies():
    turned = [camera.moved(ANY, 3.0, np.array([1.0, 2.0, 3.0])) for camera in RING]
    np.testing.assert_allclose(up_of(turned), ANY @ [0, 1, 0], atol=1e-6)


def test_two_cameras_tell_it_by_how_they_are_held():
    assert up_of(RING[:2]) @ [0, 1, 0] > 0.95


def test_the_place_looked_at_is_the_origin_and_the_ring_has_radius_1():
    turned = [camera.moved(ANY, 3.0, np.array([1.0, 2.0, 3.0])) for camera in RING]
    cameras, points, scale = moved_upright(turned, 3.0 * POINTS @ ANY.T + [1, 2, 3], None, metric=False)
    assert np.mean([np.linalg.norm(camera.centre) for camera in cameras]) == pytest.approx(1.0)
    np.testing.assert_allclose(points[0], 0, atol=1e-4)
    np.testing.assert_allclose(points[1] / np.linalg.norm(points[1]), [0, 1, 0], atol=1e-4)
    np.testing.assert_allclose(cameras[0].project(points)[0], RING[0].project(POINTS)[0], atol=1e-6)


def test_metres_stay_metres():
    _, points, scale = moved_upright(RING, POINTS, np.array([0.0, 1.0, 0.0]), metric=True)
    assert scale == 1.0 and np.ptp(points[:, 1]) == pytest.approx(1.0)
