import numpy as np
import pytest

from sketchtree.errors import OptionError
from sketchtree.geometry.bark import bark_material, bark_names
from sketchtree.geometry.bark.noise import clouds, dashes, scales
from sketchtree.geometry.bark.relief import Relief, normal_map
from sketchtree.geometry.bark.young import YOUNG

every_bark = pytest.mark.parametrize("name", bark_names())


def test_twenty_three_barks():
    assert bark_names() == (
        "oak", "beech", "birch", "willow", "poplar", "apple", "spruce", "pine", "palm", "ash", "lime", "elm", "maple", "plane", "cherry", "chestnut",
        "cypress", "cedar", "larch", "coconut", "fan_palm", "dragon_tree", "dead",
    )  # fmt: skip


def test_every_bark_has_a_skin_for_its_young_twigs():
    assert set(YOUNG) == set(bark_names())


def test_no_two_barks_look_alike():
    """By mean colour and by how rough they are across and along the stem, some difference is plain between any two."""
    looks = []
    for name in bark_names():
        image = bark_material(name, 128).base_color_texture.astype(float)
        rough = [10 * np.log2(np.abs(np.diff(image.mean(axis=2), axis=axis)).mean()) for axis in (0, 1)]
        looks.append([*image.mean(axis=(0, 1)), image.mean(axis=2).std(), *rough])
    apart = np.linalg.norm(np.array(looks)[:, None] - np.array(looks)[None], axis=2)
    assert apart[np.triu_indices(len(looks), 1)].min() > 5


@every_bark
def test_textures_are_whole(name):
    material = bark_material(name, 128)
    assert material.name == f"wood_{name}" and material.alpha_cutoff is None
    assert material.base_color_texture.shape == (128, 128, 3)
    assert material.normal_texture.shape == (128, 128, 3)
    assert material.roughness_texture.shape == (128, 128)


@every_bark
def test_it_repeats_without_a_seam(name):
    image = bark_material(name, 256).base_color_texture.astype(float)
    for axis in (0, 1):
        step = np.abs(image - np.roll(image, 1, axis)).mean(axis=(1 - axis, 2))  # the first is the step across the edge
        assert step[0] <= 1.1 * step[1:].max()


@every_bark
def test_normals_are_unit_and_point_outwards(name):
    normal = bark_material(name, 128).normal_texture.astype(float) / 127.5 - 1.0
    np.testing.assert_allclose(np.linalg.norm(normal, axis=-1), 1.0, atol=0.02)
    assert (normal[..., 2] > 0).all()
    np.testing.assert_allclose(normal[..., :2].mean(axis=(0, 1)), 0.0, atol=0.04)


@every_bark
def test_colours_are_those_of_bark(name):
    red, green, blue = bark_material(name, 128).base_color_texture.reshape(-1, 3).mean(axis=0)
    assert 55 < green < 215 and red >= green - 4 and green >= blue - 4


def test_birch_is_white_and_pine_is_orange():
    birch, pine = (bark_material(name, 128).base_color_texture.reshape(-1, 3).mean(axis=0) for name in ("birch", "pine"))
    assert birch.min() > 175 and pine[0] > 1.7 * pine[2]


def test_a_bark_is_drawn_once():
    assert bark_material("oak", 128) is bark_material("oak", 128)


def test_textures_cannot_be_changed_by_accident():
    with pytest.raises(ValueError, match="read-only"):
        bark_material("oak", 128).base_color_texture[0, 0] = 0


def test_clouds_have_mean_0_and_variance_1_and_their_direction():
    noise = clouds(128, 5, 0.01, 0.1)
    assert noise.mean() == pytest.approx(0, abs=1e-9) and noise.std() == pytest.approx(1)
    assert np.abs(np.diff(noise, axis=1)).mean() > 3 * np.abs(np.diff(noise, axis=0)).mean()


def test_patterns_depend_on_their_seed_alone():
    np.testing.assert_array_equal(clouds(64, 5, 0.1, 0.1), clouds(64, 5, 0.1, 0.1))
    np.testing.assert_array_equal(dashes(64, 1, 9, (0.1, 0.2), (0.02, 0.03)), dashes(64, 1, 9, (0.1, 0.2), (0.02, 0.03)))
    assert not np.array_equal(clouds(64, 5, 0.1, 0.1), clouds(64, 6, 0.1, 0.1))


def test_scales_cover_the_tile():
    border, value, place = scales(128, 1, 40, 2.0, 0.1)
    assert border.min() >= 0 and 25 < len(np.unique(value)) < 60 and np.isfinite(place).all()


def test_a_slope_rising_to_the_right_leans_left():
    row = np.broadcast_to(np.sin(np.linspace(0, 2 * np.pi, 64, endpoint=False)), (64, 64))
    relief = Relief(0.01 * row, np.zeros((64, 64, 3)), np.zeros((64, 64)))
    assert normal_map(relief)[0, 0, 0] < 128 < normal_map(relief)[0, 32, 0]


def test_a_slope_rising_upwards_leans_down():
    column = np.broadcast_to(np.sin(np.linspace(0, 2 * np.pi, 64, endpoint=False))[:, None], (64, 64))
    relief = Relief(0.01 * column, np.zeros((64, 64, 3)), np.zeros((64, 64)))
    assert normal_map(relief)[0, 0, 1] > 128 > normal_map(relief)[32, 0, 1]  # rows run down the image


def test_unknown_bark_is_named():
    with pytest.raises(OptionError, match="There is no bark called `teak`. Choose one of: oak"):
        bark_material("teak")


def test_size_out_of_range_is_named():
    with pytest.raises(OptionError, match="`pixels` is 8, outside 64 to 4096"):
        bark_material("oak", 8)
