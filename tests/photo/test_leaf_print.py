"""§4: "Leaves are textured according to their projected position on the input image": the paper's rectangles bear the photo itself."""

from dataclasses import replace

import numpy as np

from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.instanced import leaf_instances
from sketchtree.foliage.leaf_cards import leaf_cards
from sketchtree.foliage.leaves import Leaves
from sketchtree.photo.leaf_print import LONGEST, leaf_print
from sketchtree.photo.photo import Photo
from sketchtree.photo.photo_leaves import SeenFoliage
from sketchtree.similarity import Similarity

METRES = 0.01  # a pixel
GREEN, RED, SKY = (60, 120, 40), (190, 60, 40), (120, 170, 240)


def seen(size: int = 100, leafy=None) -> SeenFoliage:
    """A square of foliage in the sky, its left half green, its right half red; the sky left and above."""
    rgb = np.full((size, size, 3), SKY, np.uint8)
    low, middle = size // 4, 5 * size // 8
    rgb[low:, low:middle], rgb[low:, middle:] = GREEN, RED
    mask = np.zeros((size, size), bool)
    mask[low:, low:] = True
    return SeenFoliage(Photo(rgb), mask, Similarity(METRES, (-0.5, 1.0, 0.0)), leafy)


def leaves_at(x, y, size=0.05, printed=None) -> Leaves:
    place = np.column_stack([x, y, np.random.default_rng(0).normal(size=len(x))])
    up, front = np.tile([0.0, 1.0, 0.0], (len(x), 1)), np.tile([0.0, 0.0, 1.0], (len(x), 1))
    return Leaves("rectangle", place, up, front, np.full(len(x), size), np.full(len(x), 0.5), np.zeros(len(x), int), seen=np.full((len(x), 3), 0.3), printed=printed)


def colours_at(mesh) -> np.ndarray:
    """The picture's colour at every vertex."""
    picture = mesh.material.base_color_texture
    rows, columns = picture.shape[:2]
    return picture[(mesh.uv[:, 1] * rows).astype(int), (mesh.uv[:, 0] * columns).astype(int)].astype(int)


def test_each_corner_of_a_leaf_has_the_colour_that_the_photo_has_there():
    mesh = leaf_mesh(leaves_at([-0.15, 0.35], [0.3, 0.3], printed=leaf_print(seen())))
    red, green, _ = colours_at(mesh).T
    left = mesh.position[:, 0] < 0.125
    assert (green[left] > red[left]).all() and (red[~left] > green[~left]).all()
    assert mesh.color is None


def test_a_leaf_across_two_colours_bears_both():
    mesh = leaf_mesh(leaves_at([0.125], [0.3], printed=leaf_print(seen())))
    assert len(np.unique(colours_at(mesh), axis=0)) == 2


def test_depth_changes_nothing_and_what_sticks_out_of_the_picture_takes_its_edge():
    printed = leaf_print(seen())
    uv = printed.uv(np.array([[0.0, 0.3, -5.0], [0.0, 0.3, 5.0], [-9.0, 9.0, 0.0], [9.0, -9.0, 0.0]]))
    np.testing.assert_array_equal(uv[0], uv[1])
    assert (uv > 0).all() and (uv < 1).all()


def test_the_picture_is_the_foliage_alone_without_the_sky_between():
    """Where the photo shows no leaf the nearest leaf's colour is printed."""
    hole = seen()
    leafy = hole.mask.copy()
    leafy[40:60, 30:50] = False
    rgb = hole.photo.rgb.copy()
    rgb[40:60, 30:50] = SKY
    printed = leaf_print(replace(hole, photo=Photo(rgb), leafy=leafy))
    red, _, blue = printed.picture.reshape(-1, 3).astype(int).T
    assert (blue < np.maximum(red, 90)).all()
    assert printed.picture.shape == (75, 75, 3)


def test_a_large_photo_is_printed_smaller_where_it_is():
    large = leaf_print(seen(3000))
    assert max(large.picture.shape) <= LONGEST
    np.testing.assert_allclose([large.left, large.top], [-0.5 + 750 * METRES, 1.0 - 750 * METRES])
    assert large.pixel * large.picture.shape[1] >= 2250 * METRES


def test_no_leaf_prints_nothing():
    assert leaf_print(seen(leafy=np.zeros((100, 100), bool))) is None


def test_coarser_levels_and_instances_bear_the_leafs_one_colour():
    """Their cards have holes or are shared: the picture can't be on them."""
    leaves = leaves_at([0.0, 0.1], [0.3, 0.3], printed=leaf_print(seen()))
    for material in (leaf_cards(leaves, triangles=4).material, leaf_instances(leaves)[0].mesh.material):
        assert material.base_color_texture.shape[-1] == 4


def test_materials_of_different_pictures_have_different_names():
    names = {leaf_mesh(leaves_at([0.0], [0.3], printed=leaf_print(seen(size)))).material.name for size in (100, 120)}
    assert len(names) == 2
