import numpy as np
import pytest

from sketchtree import keys
from sketchtree.errors import OptionError
from sketchtree.foliage.card_shape import hexagon
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaf_materials import leaf_material
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.models import leaf_model, leaf_names, leaf_painting
from sketchtree.foliage.populate import populate
from tests.foliage.trees import HABIT, small_tree

KEY = keys.root_key(1)
BLADES = [name for name in leaf_names() if leaf_model(name).is_blade]


@pytest.fixture(scope="module", params=leaf_names())
def worn(request):
    leaves = populate(small_tree(), HABIT, key=KEY, model=request.param)
    return leaves, leaf_mesh(leaves)


@pytest.fixture(scope="module")
def carded(worn):
    """The same on cards: of flowers there must be many, few wear petals (`test_flower_meshes`)."""
    leaves, mesh = worn
    if not leaf_model(leaves.model).flower:
        return leaves, mesh
    many = select(leaves, np.arange(20_000) % len(leaves))
    return many, leaf_mesh(many)


def test_the_mesh_is_called_leaf_and_its_material_after_the_model(worn):
    leaves, mesh = worn
    assert mesh.name == ("leaf_blossom" if leaf_model(leaves.model).flower else "leaf")
    assert mesh.material.name == f"leaf_{leaves.model}"
    assert mesh.material.alpha_cutoff == 0.4 and mesh.material.double_sided


def cards(leaves, mesh):
    """The corners of every leaf's card; the short shoots stand after them."""
    return mesh.position[: len(mesh.position) - 6 * len(leaves.shoot)].reshape(len(leaves), -1, 3)


def test_a_leaf_is_at_most_six_triangles_and_so_is_a_short_shoot(carded):
    leaves, mesh = carded
    assert len(mesh.triangle) <= 6 * (len(leaves) + len(leaves.shoot))
    assert mesh.triangle.min() == 0 and mesh.triangle.max() == len(mesh.position) - 1


def test_columns_are_finite_normals_unit_and_factors_within_range(worn):
    _, mesh = worn
    assert all(np.isfinite(column).all() for column in (mesh.position, mesh.normal, mesh.uv, mesh.color))
    assert np.allclose(np.linalg.norm(mesh.normal, axis=1), 1)
    assert mesh.uv.min() >= 0 and mesh.uv.max() <= 1
    assert mesh.color.min() >= 0 and mesh.color.max() <= 1


def test_every_leaf_starts_in_the_middle_of_its_cards_foot_edge(carded):
    leaves, mesh = carded
    apart = cards(leaves, mesh)[:, :2].mean(axis=1) - leaves.position
    apart -= np.einsum("li,li->l", apart, leaves.normal)[:, None] * leaves.normal  # both corners of a folded card rise
    assert (np.linalg.norm(apart, axis=1) < 0.04 * leaves.size).all()


def test_a_card_is_as_long_as_its_blade_with_petiole(carded):
    leaves, mesh = carded
    corners = cards(leaves, mesh) - leaves.position[:, None]
    along = np.einsum("lvk,lk->lv", corners, leaves.direction).max(axis=1) / leaves.size
    painting = leaf_painting(leaves.model)
    assert np.allclose(along, along[0]) and 0.9 < along[0] < painting.top - painting.bottom + 0.1


def test_upper_faces_are_counter_clockwise():
    leaves = populate(small_tree(), HABIT, key=KEY, model="oak")
    mesh = leaf_mesh(leaves)
    a, b, c = (mesh.position[mesh.triangle[: 6 * len(leaves), i]] for i in range(3))
    face = np.cross(b - a, c - a)
    assert (np.einsum("ij,ij->i", face, np.repeat(leaves.normal, 6, axis=0)) > 0).all()


def test_the_texture_stands_upright_on_the_card():
    mesh = leaf_mesh(Leaves("oak", np.zeros((1, 3)), np.array([[0, 1.0, 0]]), np.array([[0, 0, 1.0]]), np.ones(1), np.zeros(1), np.zeros(1, int)))
    top, right = np.argmax(mesh.position[:, 1]), np.argmax(mesh.position[:, 0])
    assert mesh.uv[top, 1] < 0.1 and mesh.uv[right, 0] > 0.9


@pytest.mark.parametrize("name", BLADES)
def test_the_hexagon_holds_the_whole_drawing(name):
    painting = leaf_painting(name)
    corners = hexagon(painting)
    foot, waist, tip = corners[[1, 4, 6]]
    rows, columns = np.nonzero(painting.coverage > 0.5)
    height, width = painting.coverage.shape
    x = np.abs(painting.left + (columns + 0.5) / width * (painting.right - painting.left))
    y = painting.top + (rows + 0.5) / height * (painting.bottom - painting.top)
    limit = np.interp(y, [foot[1], waist[1], tip[1]], [foot[0], waist[0], tip[0]])
    assert (x <= limit + 1e-6).all()


def test_texture_places_are_linear_in_the_card(worn):
    leaves, mesh = worn
    painting, count = leaf_painting(leaves.model), len(cards(leaves, mesh)[0])
    if leaf_model(leaves.model).is_blade:
        u = (hexagon(painting)[:, 0] - painting.left) / (painting.right - painting.left)
        assert np.allclose(mesh.uv[:count, 0], u)


@pytest.mark.parametrize("name", BLADES)
def test_the_hexagon_wastes_less_than_the_rectangle(name):
    painting, corners = leaf_painting(name), hexagon(leaf_painting(name))
    foot, waist, tip = corners[[1, 4, 6]]
    area = (foot[0] + waist[0]) * (waist[1] - foot[1]) + (waist[0] + tip[0]) * (tip[1] - waist[1])
    assert area <= 1.02 * (painting.right - painting.left) * (painting.top - painting.bottom)


def test_every_season_has_its_own_colour():
    means = [leaf_material("maple", s).base_color_texture[..., :3].mean(axis=(0, 1)) for s in ("spring", "summer", "autumn")]
    assert all(np.abs(a - b).max() > 15 for a, b in [(means[0], means[1]), (means[1], means[2])])


def test_short_shoots_are_opaque_tubes_that_look_outward():
    leaves = populate(small_tree(), HABIT, key=KEY)
    mesh = leaf_mesh(leaves)
    assert len(leaves.shoot)
    tube = mesh.triangle[6 * len(leaves) :]
    a, b, c = (mesh.position[tube[:, i]] for i in range(3))
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), mesh.normal[tube].mean(axis=1)) > 0).all()
    texture = mesh.material.base_color_texture
    rows, columns = (mesh.uv[np.unique(tube)][:, ::-1] * texture.shape[:2]).astype(int).T
    assert texture[rows, columns, 3].min() > 127


@pytest.mark.parametrize("name", [name for name in BLADES if leaf_model(name).spur > 1])
def test_every_model_with_short_shoots_has_a_petiole_to_paint_them_with(name):
    leaves = populate(small_tree(), HABIT, key=KEY, model=name)
    mesh = leaf_mesh(leaves)
    uv = mesh.uv[len(mesh.uv) - 6 * len(leaves.shoot) :]
    texture = mesh.material.base_color_texture
    rows, columns = (uv[:, ::-1] * texture.shape[:2]).astype(int).T
    assert texture[rows, columns, 3].min() > 127


def test_no_leaf_gives_an_empty_mesh():
    mesh = leaf_mesh(populate(small_tree(), HABIT, key=KEY, season="bare"), season="bare")
    assert mesh.position.shape == (0, 3) and mesh.triangle.shape == (0, 3) and mesh.color.shape == (0, 4)


def test_an_unknown_season_is_refused():
    with pytest.raises(OptionError, match="There is no season called 'noon'"):
        leaf_mesh(Leaves.none("oak"), season="noon")
