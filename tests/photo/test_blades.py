"""Long, narrow blades are told from round ones where a photo shows single leaves; of grey pictures nothing is told."""

import numpy as np
import pytest
from PIL import Image, ImageDraw

from sketchtree.photo.blades import NARROW, blades_are_narrow, elongation
from sketchtree.photo.photo import Photo

EVERYWHERE = np.ones((300, 300), bool)


def leaves(long: float, wide: float, *, times: int = 1, grey: bool = False) -> Photo:
    """Leaves of so many pixels, lit by chance, in all directions on a dark ground."""
    draw, side = np.random.default_rng(0), 300 * times
    image = Image.new("RGB", (side, side), (20, 40, 16))
    pen = ImageDraw.Draw(image)
    for x, y, turn, light in zip(*draw.uniform(0, side, (2, 2500)), draw.uniform(0, np.pi, 2500), draw.uniform(0.3, 1.0, 2500), strict=True):
        around = np.linspace(0, 2 * np.pi, 12, endpoint=False)
        at = np.column_stack([0.5 * times * long * np.cos(around), 0.5 * times * wide * np.sin(around)]) @ [[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]]
        pen.polygon([(float(x + u), float(y + v)) for u, v in at], fill=(int(120 * light), int(190 * light), int(60 * light)))
    return Photo(np.asarray(image.convert("L").convert("RGB") if grey else image))


def test_lanceolate_blades_are_narrow_and_round_ones_are_not():
    assert elongation(leaves(14, 3.5), EVERYWHERE) > NARROW > elongation(leaves(7, 6), EVERYWHERE)
    assert blades_are_narrow(leaves(14, 3.5), EVERYWHERE) and not blades_are_narrow(leaves(7, 6), EVERYWHERE)


def test_a_larger_photo_of_the_same_tree_says_the_same():
    assert blades_are_narrow(leaves(14, 3.5, times=4), np.ones((1200, 1200), bool))


@pytest.mark.parametrize("mask", [np.zeros((300, 300), bool), np.pad(np.ones((12, 12), bool), 144)])
def test_too_little_foliage_says_nothing(mask):
    assert elongation(leaves(14, 3.5), mask) is None


def test_a_grey_picture_is_not_asked():
    assert not blades_are_narrow(leaves(14, 3.5, grey=True), EVERYWHERE)
