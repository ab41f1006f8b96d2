"""How much of a pixel a twig fills is read to a fraction, and what photos look past is no place of it."""

import numpy as np
import pytest
from ring import camera_at

from sketchtree.multiview.outline import brought_in, filled, looked_past, outlines_of

SKY, BARK = np.array([0.55, 0.66, 0.8]), np.array([0.3, 0.25, 0.2])
RING = [camera_at(15.0 * k, size=(200, 200)) for k in range(24)]


def stem(left, right, shape=(24, 24)):
    """(a picture of an upright stem between two columns, as a camera mixes its colours; how much of each pixel it fills)."""
    column = np.arange(shape[1])
    share = np.clip(np.minimum(right, column + 1) - np.maximum(left, column), 0.0, 1.0)
    share = np.broadcast_to(share, shape)
    return (share[..., None] * BARK + (1 - share[..., None]) * SKY).astype(np.float32), share


def empty_beside(share, gap=1):
    """What is even: the sky, but for some pixels beside the stem."""
    columns = np.flatnonzero(share[0] > 0)
    even = np.ones(share.shape, bool)
    even[:, columns[0] - gap : columns[-1] + 1 + gap] = False
    return even


@pytest.mark.parametrize(("left", "right"), [(10.3, 12.5), (10.0, 12.0), (8.6, 14.1)])
def test_a_stem_fills_of_its_pixels_what_it_covers(left, right):
    rgb, share = stem(left, right)
    np.testing.assert_allclose(filled(rgb, empty_beside(share)), share, atol=0.02)


def test_noise_beside_it_is_empty():
    rgb, share = stem(10.3, 12.5)
    rgb = rgb + np.random.default_rng(0).normal(0, 0.015, rgb.shape).astype(np.float32)
    assert (filled(rgb, empty_beside(share, 2))[share == 0] < 0.5).all()


def test_a_pale_twig_beside_a_dark_limb_is_no_sky():
    rgb, share = stem(8.0, 14.0)
    rgb[:, 16] = SKY + 0.4 * (BARK - SKY)
    empty = empty_beside(share)
    empty[:, 14:18] = False
    assert (filled(rgb, empty)[:, 16] > 0.9).all()


def test_where_no_contrast_tells_all_is_plant():
    rgb, share = stem(10.0, 12.0)
    pale = SKY + 0.05 * (rgb - SKY)
    assert (filled(pale.astype(np.float32), empty_beside(share))[:, 8:14][:, 1:-1] == 1.0).all()
    assert (filled(rgb, np.zeros(share.shape, bool)) == 1.0).all()


def thin_stem(camera):
    """α of an upright stem at the origin, 2 pixels wide."""
    middle = camera.project(MIDDLE[None])[0][0, 0]
    rgb, share = stem(middle - 1, middle + 1, (200, 200))
    return filled(rgb, empty_beside(share))


MIDDLE = np.array([0.0, 0.5, 0.0])
STEM = outlines_of(RING, [thin_stem(camera) for camera in RING])
PIXEL = 3.0 / RING[0].matrix[0, 0]
ROUND = np.array([(np.cos(a), 0.0, np.sin(a)) for a in np.linspace(0, 2 * np.pi, 8, endpoint=False) + 0.1])


def test_points_beside_a_thin_stem_are_looked_past_and_those_in_it_stay():
    for pixels, past in ((0.0, 0.0), (0.8, 0.0), (1.6, 1.0), (4.0, 1.0)):
        assert looked_past(MIDDLE + pixels * PIXEL * ROUND, STEM).mean() == past, pixels


def test_a_photo_is_read_between_the_middles_of_its_pixels():
    (camera,) = RING[:1]
    alpha = np.where(np.arange(200) < 100, 1.0, 0.0) * np.ones((200, 1))
    for column, past in ((99.9, False), (100.1, True)):
        there = camera.unproject(np.array([[column, 50.0]]), np.array([3.0]))
        assert looked_past(there, outlines_of(4 * [camera], 4 * [alpha])) == past


def test_a_point_off_the_stem_is_brought_in_along_its_ray():
    eye = RING[0].centre
    off = MIDDLE + np.outer([-5.0, -2.0, 0.0, 3.0, 9.0], PIXEL * (MIDDLE - eye) / 3.0)
    found, there = brought_in(off, eye, PIXEL / 3.0, STEM)
    assert there.tolist() == [True, True, True, True, False]
    assert np.linalg.norm((found - MIDDLE)[:4], axis=1).max() < 1.3 * PIXEL
    np.testing.assert_array_equal(found[2], off[2])
    np.testing.assert_allclose(np.cross(found - eye, off - eye), 0.0, atol=1e-9)


def test_a_few_photos_may_be_wrong():
    alpha = [thin_stem(camera) for camera in RING]
    alpha[::6] = 4 * [np.zeros((200, 200))]  # took bark for an even place
    assert not looked_past(MIDDLE[None], outlines_of(RING, alpha)).any()
    assert looked_past(MIDDLE[None], outlines_of(RING, 24 * [np.zeros((200, 200))])).all()


def test_what_no_photo_shows_is_not_looked_past():
    assert not looked_past(np.array([[0.0, 90.0, 0.0]]), STEM).any()
