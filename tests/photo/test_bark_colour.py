"""The bark of a photo's tree has the colour of its trunk, half of its shade taken out; where the photo says nothing, its species' own."""

import numpy as np
import pytest

import painted
from sketchtree.geometry.bark import bark_colour, bark_material, twig_material
from sketchtree.photo.bark_colour import SeenBark, seen_bark
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.appearance import Mixture
from sketchtree.photo.photo import Photo
from sketchtree.photo.trace.traced import Traced

NOTHING = Mixture(np.ones(1), np.full((1, 3), 128.0), np.eye(3)[None] * 100.0)


def seen(photo: Photo, radius: float = 10.0, mask=None) -> SeenBark:
    trunk = np.array(painted.TRUNK, float)
    traced = Traced(np.arange(len(trunk)) - 1, trunk, np.full(len(trunk), radius), np.zeros(len(trunk), int), np.zeros(len(trunk), int))
    mask = np.zeros((photo.height, photo.width), bool) if mask is None else mask
    return seen_bark(photo, Foliage(mask, mask, NOTHING, NOTHING), traced)


def linear(colour) -> np.ndarray:
    value = np.array(colour) / 255
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def test_it_is_the_colour_along_the_trunk():
    np.testing.assert_allclose(seen(painted.bare_tree()).colour, linear(painted.BARK), rtol=0.1)


def test_what_leaves_hide_is_not_asked_while_some_is_clear():
    photo = painted.bare_tree(0.0)
    rgb, mask = np.array(photo.rgb), np.zeros((600, 600), bool)
    rgb[:400], mask[:400] = painted.LEAF, True
    np.testing.assert_allclose(seen(Photo(rgb), mask=mask).colour, linear(painted.BARK), rtol=1e-6)


def test_a_grey_photo_and_a_trunk_of_a_pixel_say_nothing():
    assert seen(Photo(np.repeat(painted.bare_tree().rgb[..., :1], 3, axis=2))).colour is None
    assert seen(painted.bare_tree(), radius=1.0).colour is None
    assert SeenBark(None)("oak") is None


def test_the_bark_has_the_hue_that_was_seen_and_lightness_between_that_and_its_own():
    asked = SeenBark((0.06, 0.03, 0.015))
    own, worn = (np.array(colour) for colour in (bark_colour("oak"), asked("oak")))
    np.testing.assert_allclose(worn / worn.sum(), np.array(asked.colour) / sum(asked.colour), atol=0.01)
    assert 0.034 < worn @ [0.2126, 0.7152, 0.0722] < own @ [0.2126, 0.7152, 0.0722]


def test_of_a_trunk_in_the_dark_the_hue_is_hardly_believed():
    own, worn = (np.array(colour) for colour in (bark_colour("oak"), SeenBark((0.0, 0.0, 0.004))("oak")))
    np.testing.assert_allclose(worn / worn.sum(), own / own.sum(), atol=0.08)


@pytest.mark.parametrize("colour", [(0.2, 0.12, 0.05), (0.05, 0.05, 0.06)])
def test_a_material_of_that_mean_is_the_same_bark_under_a_name_of_its_own(colour):
    own, other = bark_material("oak"), bark_material("oak", colour=colour)
    np.testing.assert_allclose(linear(other.base_color_texture).mean(axis=(0, 1)), colour, rtol=0.05)
    assert other.normal_texture is own.normal_texture and other.name.startswith("wood_oak_") and other.name != own.name
    assert bark_material("oak", colour=colour) is other
    assert twig_material("oak", colour=colour).name.startswith("wood_oak_young_")
