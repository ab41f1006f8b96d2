"""What does a tree look like on eight cards?"""

import numpy as np
import pytest
from test_raster import square

from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.levels.impostor import SIDES, impostor
from sketchtree.levels.outline_error import overlap, views_round
from sketchtree.levels.raster import render, silhouette


def bush(seed=0, count=400):
    """A round cloud of little squares, red in front, green behind."""
    rng = np.random.default_rng(seed)
    place = rng.normal(size=(count, 3)) * [0.6, 0.8, 0.6] + [0.2, 2.0, 0.0]
    size = 0.12
    corner = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * size
    turn = rng.uniform(0, np.pi, count)
    across = np.stack([np.cos(turn), 0 * turn, -np.sin(turn)], axis=1)
    position = place[:, None] + corner[None, :, :1] * across[:, None] + corner[None, :, 1:2] * [0, 1.0, 0]
    color = np.where(place[:, 2:] > 0, [[1.0, 0, 0, 1]], [[0, 1.0, 0, 1]])
    normal = np.repeat(np.stack([np.sin(turn), 0 * turn, np.cos(turn)], axis=1), 4, axis=0)
    triangle = (np.array([[0, 1, 2], [0, 2, 3]])[None] + 4 * np.arange(count)[:, None, None]).reshape(-1, 3)
    material = Material("leaf", double_sided=True)
    return Mesh("leaf", position.reshape(-1, 3), normal, np.zeros((4 * count, 2)), triangle, material, np.repeat(color, 4, axis=0))


@pytest.fixture(scope="module")
def made():
    full = bush()
    return full, impostor([full], pixels=128)


def test_it_has_sixteen_triangles_and_one_material(made):
    _, card = made
    assert card.triangle_count == 2 * SIDES == 16 and card.name == card.material.name == "impostor"
    assert card.material.base_color_texture.shape[2] == 4 and not card.material.double_sided


def test_its_outline_is_the_trees_from_every_side(made):
    full, card = made
    for view in views_round([full], SIDES, 128):
        assert overlap(silhouette([full], view), silhouette([card], view)) > 0.7


def test_the_cards_together_cover_as_much_as_the_tree(made):
    """From the sides that cards face; those seen askew fill holes, so each card alone covers less."""
    full, card = made
    views = views_round([full], SIDES, 256)
    areas = [[silhouette(meshes, view).sum() for view in views] for meshes in ([full], [card])]
    assert np.mean(areas[1]) == pytest.approx(np.mean(areas[0]), rel=0.08)


def test_each_side_shows_its_own_colours(made):
    full, card = made
    views = views_round([full], SIDES, 128)
    for rank, reddish in ((0, True), (4, False)):
        seen = render([card], views[rank])
        shown = np.isfinite(seen.depth)
        red, green = seen.color[shown][:, 0].mean(), seen.color[shown][:, 1].mean()
        assert bool(red > green) == reddish


def test_every_card_faces_outwards_and_is_lit_from_above(made):
    _, card = made
    for rank in range(SIDES):
        a, b, c = card.position[card.triangle[2 * rank]]
        front = np.cross(b - a, c - a)
        angle = 2 * np.pi * rank / SIDES
        assert np.dot(front, [np.sin(angle), 0, np.cos(angle)]) > 0
    assert np.allclose(np.linalg.norm(card.normal, axis=1), 1) and (card.normal[2::4, 1] > card.normal[1::4, 1]).all()


def test_the_same_tree_makes_the_same_bytes(made):
    full, card = made
    again = impostor([full], pixels=128)
    assert (again.material.base_color_texture == card.material.base_color_texture).all()
    assert (again.material.normal_texture == card.material.normal_texture).all() and (again.position == card.position).all()


def test_a_slim_tree_has_a_slim_picture():
    slim = impostor([square(half=0.5)], pixels=128)
    tall = square(half=0.5)
    tall = Mesh("leaf", tall.position * [0.2, 3.0, 1.0], tall.normal, tall.uv, tall.triangle, tall.material)
    texels = impostor([tall], pixels=128).material.base_color_texture.size
    assert texels < 0.4 * slim.material.base_color_texture.size


def test_nothing_makes_an_empty_impostor():
    assert impostor([]).triangle_count == 0
