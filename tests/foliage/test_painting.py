import numpy as np
import pytest

from sketchtree.foliage.leaf_materials import card_material, leaf_material
from sketchtree.foliage.models import leaf_model, leaf_names, leaf_painting
from sketchtree.foliage.painting import to_linear, to_srgb


@pytest.fixture(scope="module", params=leaf_names())
def name(request):
    return request.param


def test_alpha_has_full_and_empty_pixels_and_a_transparent_border(name):
    alpha = card_material(name).base_color_texture[..., 3]
    assert alpha.min() == 0 and alpha.max() == 255
    assert max(alpha[0].max(), alpha[-1].max(), alpha[:, 0].max(), alpha[:, -1].max()) == 0


def test_the_drawing_fills_its_texture(name):
    rows, columns = np.nonzero(card_material(name).base_color_texture[..., 3] > 127)
    height, width = leaf_painting(name).coverage.shape
    assert 256 <= height <= 512 or 256 <= width <= 512
    assert np.ptp(rows) > 0.9 * height or np.ptp(columns) > 0.9 * width
    assert np.ptp(columns) > 0.55 * width


def test_colour_runs_on_under_the_transparent_area(name):
    texture = card_material(name).base_color_texture.astype(float)
    solid, empty = texture[..., 3] >= 128, texture[..., 3] == 0
    for channel in range(3):
        seen = texture[..., channel][solid]
        assert texture[..., channel][empty].min() >= seen.min() - 1
        assert texture[..., channel][empty].max() <= seen.max() + 1


@pytest.mark.parametrize("name", [name for name in leaf_names() if not leaf_model(name).flower])
def test_greens_are_neither_neon_nor_grey(name):
    texture = leaf_material(name, "summer").base_color_texture
    red, green, blue = texture[texture[..., 3] > 200][:, :3].mean(axis=0) / 255
    saturation = (max(red, green, blue) - min(red, green, blue)) / max(red, green, blue)
    assert green > blue and 0.15 < green < 0.70 and 0.15 < saturation < 0.75


def test_normals_are_unit_and_look_up(name):
    texture = card_material(name).normal_texture
    normal = texture / 127.5 - 1
    assert np.allclose(np.linalg.norm(normal, axis=2), 1, atol=0.02)
    assert normal[..., 2].min() > 0.1
    flat = leaf_painting(name).coverage == 0
    assert (texture[flat] == (128, 128, 255)).all()


def test_light_that_passes_is_brighter_in_the_blade_than_in_stem_and_vein(name):
    material, painting = card_material(name), leaf_painting(name)
    passed = material.translucency_texture.astype(float).sum(axis=2)
    assert material.translucency_texture.shape == (*painting.coverage.shape, 3) and 0 < material.translucency < 0.5
    blade = (painting.coverage > 0.9) & (painting.vein < 0.1) & (painting.stem < 0.1)
    for other in (painting.vein * (1 - painting.stem) * (painting.coverage > 0.9) > 0.8, painting.stem > 0.9):
        assert not other.any() or passed[other].mean() < passed[blade].mean()


def test_leaves_let_yellower_light_through_than_they_throw_back():
    material = leaf_material("lime")
    solid = material.base_color_texture[..., 3] > 250
    back, passed = (t[solid][:, :3].astype(float).mean(axis=0) for t in (material.base_color_texture, material.translucency_texture))
    assert passed[1] / passed[2] > 1.15 * back[1] / back[2]


def test_the_drawing_is_the_same_every_time(name):
    assert np.array_equal(leaf_model(name).draw().coverage, leaf_painting(name).coverage)


def test_srgb_and_linear_are_inverse():
    values = np.linspace(0, 1, 256)
    assert np.allclose(to_srgb(to_linear(values)), values, atol=1e-6)
    assert np.isclose(to_linear(np.array(0.5)), 0.21404, atol=1e-4)
