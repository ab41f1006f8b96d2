"""§4: only leaves that project into the foliage are kept, and they take their colours from where they project."""

import numpy as np
import pytest

from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.instanced import leaf_instances
from sketchtree.foliage.leaf_cards import leaf_cards
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.painting import to_linear
from sketchtree.photo.photo import Photo
from sketchtree.photo.photo_leaves import SeenFoliage, middles
from sketchtree.similarity import Similarity

RED, SKY = (200, 40, 30), (120, 170, 240)
METRES = 0.01  # a pixel


def seen() -> SeenFoliage:
    """A red square, columns 40-79 and rows 20-59, in the sky; the root at pixel (60, 100)."""
    rgb = np.full((100, 120, 3), SKY, np.uint8)
    rgb[20:60, 40:80] = RED
    mask = np.zeros((100, 120), bool)
    mask[20:60, 40:80] = True
    return SeenFoliage(Photo(rgb), mask, Similarity(METRES, (-60 * METRES, 100 * METRES, 0.0)))


def leaves_at(x, y, size=0.02) -> Leaves:
    place = np.column_stack([x, np.asarray(y, float) - 0.5 * size, np.random.default_rng(0).normal(size=len(x))])
    up, front = np.tile([0.0, 1.0, 0.0], (len(x), 1)), np.tile([0.0, 0.0, 1.0], (len(x), 1))
    return Leaves("oak", place, up, front, np.full(len(x), size), np.full(len(x), 0.5), np.zeros(len(x), int))


def test_a_place_is_seen_where_the_orthographic_camera_has_it():
    np.testing.assert_allclose(seen().pixels(np.array([[0.0, 0.0, 3.0], [0.1, 0.5, -2.0]])), [(60, 100), (70, 50)])


def test_only_leaves_whose_middle_is_seen_in_the_foliage_are_kept():
    leaves = leaves_at([0.0, 0.15, 0.25, 0.0], [0.6, 0.6, 0.6, 0.2])
    kept = seen().confirmed(leaves)
    np.testing.assert_array_equal(kept.position, leaves.position[:2])
    assert (seen().pixels(middles(kept))[:, 0] < 80).all()


def test_leaves_take_the_colour_they_are_seen_in_and_no_sky():
    coloured = seen().coloured(leaves_at([0.0, 0.19, -0.19], [0.6, 0.41, 0.79]))
    np.testing.assert_allclose(coloured.seen, np.tile(to_linear(np.array(RED) / 255.0), (3, 1)), atol=1e-3)


def test_a_leaf_off_the_foliage_takes_the_nearest_colour_of_it():
    np.testing.assert_allclose(seen().coloured(leaves_at([0.5], [0.1])).seen[0], to_linear(np.array(RED) / 255.0), atol=1e-3)


@pytest.mark.parametrize("made", [lambda worn: leaf_mesh(worn), lambda worn: leaf_cards(worn, triangles=len(worn)), lambda worn: leaf_instances(worn)[0]])
def test_meshes_of_leaves_seen_in_a_photo_show_those_colours_in_every_level(made):
    """The pale texture times the factor is the colour of the photo."""
    worn = seen().coloured(leaves_at(np.linspace(-0.1, 0.1, 40), np.full(40, 0.6)))
    part = made(worn)
    mesh = getattr(part, "mesh", part)
    texture = mesh.material.base_color_texture
    blade = np.median(texture[texture[..., 3] > 250][:, :3], axis=0) / 255.0
    factor = part.color[0, :3]
    shown = to_linear(blade) * factor
    assert shown[0] > 5 * shown[1] and shown[0] == pytest.approx(to_linear(np.array(RED[:1]) / 255.0)[0], rel=0.35)


def test_a_tree_without_leaves_stays_without():
    assert len(seen().coloured(Leaves.none("oak"))) == 0
