"""Where a place appears, and what lies behind a pixel."""

import numpy as np
import pytest
from ring import camera_at

from sketchtree.errors import ViewsError
from sketchtree.multiview.cameras import Camera

PLACES = np.random.default_rng(1).uniform(-0.4, 0.9, (50, 3))


def test_what_is_projected_comes_back():
    camera = camera_at(35.0)
    pixel, depth = camera.project(PLACES)
    np.testing.assert_allclose(camera.unproject(pixel, depth), PLACES, atol=1e-12)


def test_what_lies_ahead_is_in_the_middle_and_what_is_higher_is_higher():
    camera = camera_at(0.0)
    pixel, depth = camera.project(np.array([[0.0, 0.5, 0.0], [0.0, 0.9, 0.0], [0.4, 0.5, 0.0]]))
    np.testing.assert_allclose(pixel[0], [48, 48])
    assert depth[0] == pytest.approx(3.0)
    assert pixel[1, 1] < 48 and pixel[2, 0] > 48
    np.testing.assert_allclose(camera.up, [0, 1, 0], atol=1e-12)
    np.testing.assert_allclose(camera.ahead, [0, 0, -1], atol=1e-12)


def test_what_lies_behind_is_not_in_the_picture():
    camera = camera_at(0.0)
    assert not camera.holds(*camera.project(np.array([[0.0, 0.5, 9.0]])))[0]


def test_pixels_are_their_middles():
    np.testing.assert_array_equal(camera_at(0.0, size=(3, 2)).pixels()[:4], [[0.5, 0.5], [1.5, 0.5], [2.5, 0.5], [0.5, 1.5]])


def test_a_smaller_picture_shows_the_same_places():
    camera = camera_at(20.0)
    pixel, _ = camera.project(PLACES)
    smaller, _ = camera.resized((48, 24)).project(PLACES)
    np.testing.assert_allclose(smaller, pixel * [0.5, 0.25])


def test_a_moved_world_looks_the_same():
    camera, turn = camera_at(20.0), camera_at(77.0).rotation
    moved = camera.moved(turn, 2.0, np.array([1.0, 2.0, 3.0]))
    np.testing.assert_allclose(moved.project(2.0 * PLACES @ turn.T + [1, 2, 3])[0], camera.project(PLACES)[0])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rotation": 2 * np.eye(3)}, "The rotation of a camera is no rotation. Write the cameras again: rows of length 1, right-handed."),
        ({"rotation": np.diag([1.0, 1.0, -1.0])}, "The rotation of a camera is no rotation. Write the cameras again: rows of length 1, right-handed."),
        ({"centre": np.array([0.0, np.nan, 0.0])}, "The `centre` of a camera is not 3 finite numbers. Write the cameras again."),
        ({"matrix": np.diag([0.0, 1.0, 1.0])}, "A camera of 4 × 3 pixels has the focal length 0. Both must be positive."),
    ],
)
def test_what_is_no_camera_is_named(change, message):
    good = {"matrix": np.eye(3), "rotation": np.eye(3), "centre": np.zeros(3), "size": (4, 3)}
    with pytest.raises(ViewsError) as error:
        Camera(**(good | change))
    assert str(error.value) == message
