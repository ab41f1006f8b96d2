"""A tree in blossom is told by the colour of what it bears; green, rusty and grey ones are not."""

import numpy as np
import pytest

import leafy
from sketchtree.photo.flowering import is_in_blossom
from sketchtree.photo.photo import Photo

CROWN = np.hypot(*(np.mgrid[: leafy.HIGH, : leafy.WIDE][::-1] - np.array([120.0, 105.0])[:, None, None])) < 75


@pytest.mark.parametrize("leaf, flowers", [((225, 225, 215), True), ((235, 175, 190), True), (leafy.GREEN, False), (leafy.RUSTY, False), ((150, 190, 140), False), ((70, 70, 68), False)])
def test_white_and_pink_are_flowers(leaf, flowers):
    assert is_in_blossom(leafy.leafy_photo(leaf), CROWN) is flowers


def test_grey_photos_and_a_few_pixels_say_nothing():
    white = leafy.leafy_photo((225, 225, 215))
    assert not is_in_blossom(Photo(np.repeat(white.rgb[..., 1:2], 3, axis=2)), CROWN)
    assert not is_in_blossom(white, np.pad(np.ones((10, 10), bool), ((100, leafy.HIGH - 110), (100, leafy.WIDE - 110))))
