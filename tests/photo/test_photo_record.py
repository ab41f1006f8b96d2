"""Where a pixel is: x right, y down, its middle at a half."""

import numpy as np
import pytest

from sketchtree.photo.photo import Photo, at_pixels, turned_over


def test_the_middle_of_a_pixel_is_half_a_pixel_in():
    mask = np.zeros((3, 4), bool)
    mask[1, 2] = True
    assert at_pixels(mask, np.array([[2.5, 1.5], [2.01, 1.99], [3.5, 1.5], [2.5, 0.5]])).tolist() == [True, True, False, False]


def test_off_the_picture_a_mask_says_no():
    assert not at_pixels(np.ones((3, 4), bool), np.array([[-0.1, 1.0], [4.0, 1.0], [1.0, -3.0], [1.0, 3.0]])).any()


def test_turning_over_negates_y_and_shifts_nothing():
    np.testing.assert_array_equal(turned_over(np.array([[1.5, 2.5]])), [[1.5, -2.5]])


def test_a_photo_is_grey_when_its_channels_agree_and_can_not_be_written_to():
    grey = Photo(np.full((4, 5, 3), 90, np.uint8))
    assert grey.is_grey and (grey.height, grey.width) == (4, 5)
    assert not Photo(np.tile(np.array([1, 2, 3], np.uint8), (4, 5, 1))).is_grey
    with pytest.raises(ValueError, match="read-only"):
        grey.rgb[0, 0] = 0
