"""What a lens bends is unbent."""

import numpy as np
import pytest
from ring import camera_at
from scipy.optimize import fsolve

from sketchtree.multiview.lenses import Lens, undistorted

LENSES = [Lens((-0.12, 0.03)), Lens((0.1, -0.02, 0.01), (0.004, -0.003)), Lens((0.05, 0.0, 0.0, 0.1, 0.0, 0.01)), Lens((0.05, -0.01, 0.002, 0.001), fisheye=True)]


def test_without_numbers_nothing_is_bent():
    xy = np.array([[0.3, -0.2], [0.0, 0.0]])
    np.testing.assert_array_equal(Lens().distort(xy), xy)
    assert not Lens().bends


def test_brown_by_hand():
    x, y, k1, k2, p1, p2 = 0.3, -0.2, 0.1, -0.05, 0.01, 0.02
    square = x * x + y * y
    q = 1 + k1 * square + k2 * square**2
    expected = [q * x + 2 * p1 * x * y + p2 * (square + 2 * x * x), q * y + p1 * (square + 2 * y * y) + 2 * p2 * x * y]
    np.testing.assert_allclose(Lens((k1, k2), (p1, p2)).distort(np.array([[x, y]]))[0], expected)


def test_a_fisheye_by_hand():
    theta = np.arctan(0.5)
    np.testing.assert_allclose(Lens((0.1,), fisheye=True).distort(np.array([[0.3, 0.4]]))[0], theta * (1 + 0.1 * theta**2) * np.array([0.6, 0.8]))


def painted(pixel):
    """A picture that is known between pixels."""
    return (0.5 + 0.25 * np.sin(0.3 * pixel[:, 0]) + 0.25 * np.cos(0.3 * pixel[:, 1]))[:, None]


@pytest.mark.parametrize("lens", LENSES)
def test_a_bent_picture_comes_back(lens):
    camera = camera_at(10.0, size=(40, 30), focal=0.8)
    focal, middle = camera.matrix[[0, 1], [0, 1]], camera.matrix[:2, 2]
    pixels = (camera.pixels() - middle) / focal
    straight = np.array([fsolve(lambda xy, at=at: lens.distort(xy[None])[0] - at, at) for at in pixels]) * focal + middle
    flat, bent = (painted(pixel).reshape(30, 40, 1) for pixel in (camera.pixels(), straight))
    found, seen = undistorted(bent, camera, lens)
    assert np.abs(bent - flat).max() > 0.06
    assert np.abs(found - flat)[3:-3, 3:-3][seen[3:-3, 3:-3]].max() < 0.03
    assert seen[3:-3, 3:-3].all()


def test_what_the_photo_does_not_show_is_told():
    _, seen = undistorted(np.zeros((40, 40, 3), np.float32), camera_at(0.0, size=(40, 40)), Lens((0.8,)))
    assert not seen[0, 0] and seen[20, 20]
