"""Flowers have the hue of the petals that a photo shows, not that of the sky or the wood between them, and the light of their place."""

from dataclasses import replace

import numpy as np
import pytest

from sketchtree.foliage.leaves import Leaves
from sketchtree.photo.petals import DARKEST, SHADE, flower_colours, petal_pixels
from sketchtree.photo.photo import Photo
from sketchtree.photo.photo_leaves import SeenFoliage
from sketchtree.similarity import Similarity

WHITE, PINK, SKY, WOOD, LEAF = (235, 232, 222), (240, 190, 200), (120, 190, 240), (60, 45, 35), (110, 140, 60)


def speckled(petal, *between) -> Photo:
    """A chequer of squares of two pixels: petals, and in turn what is between them."""
    square = (np.add.outer(np.arange(40) // 2, np.arange(40) // 2)) % (2 * len(between))
    colours = np.array([colour for other in between for colour in (petal, other)], np.uint8)
    return Photo(colours[square])


@pytest.mark.parametrize("petal", [WHITE, PINK])
def test_petals_are_told_from_sky_wood_and_leaves(petal):
    photo = speckled(petal, SKY, WOOD, LEAF)
    found = petal_pixels(photo, np.ones((40, 40), bool))
    np.testing.assert_array_equal(found, (photo.rgb == petal).all(axis=2))


def test_where_nothing_is_like_petals_all_is_asked():
    mask = np.zeros((40, 40), bool)
    mask[5:30] = True
    np.testing.assert_array_equal(petal_pixels(Photo(np.full((40, 40, 3), SKY, np.uint8)), mask), mask)


def flowers_at(columns) -> Leaves:
    """Umbels of a pixel that are seen in row 20."""
    position = np.column_stack([np.asarray(columns, float) + 0.5, np.full(len(columns), -20.0), np.zeros(len(columns))])
    up, out = np.tile([0.0, 1.0, 0.0], (len(columns), 1)), np.tile([0.0, 0.0, 1.0], (len(columns), 1))
    return Leaves("cherry_blossom", position, up, out, np.full(len(columns), 0.1), np.zeros(len(columns)), np.zeros(len(columns), int))


def seen(photo: Photo) -> SeenFoliage:
    return SeenFoliage(photo, np.ones(photo.rgb.shape[:2], bool), Similarity(1.0, (0.0, 0.0, 0.0)))


def test_flowers_before_the_sky_and_the_wood_are_as_white_as_petals():
    colour = flower_colours(seen(speckled(WHITE, SKY, WOOD)), flowers_at(range(4, 36)))
    hue = colour / colour.mean(axis=1, keepdims=True)
    assert np.abs(hue - 1).max() < 0.12 and colour.max() > 0.9


def test_shade_is_kept_for_the_most_part_and_never_black():
    rgb = np.full((40, 40, 3), WHITE, np.uint8)
    rgb[:, 20:] = WOOD
    lit, dark = flower_colours(seen(Photo(rgb)), flowers_at([8] * 9 + [30]))[[0, 9]]
    assert 0.9 * DARKEST ** (1 - SHADE) < dark.mean() / lit.mean() < 0.6


def test_pink_stays_pink():
    colour = flower_colours(replace(seen(speckled(PINK, SKY))), flowers_at(range(4, 36)))
    assert (colour[:, 0] > 1.2 * colour[:, 1]).all()
