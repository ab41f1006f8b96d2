"""Flowers as meshes (Guo et al. 2018, §5.3: "flowers (3D mesh)"), by species."""

from dataclasses import replace

import numpy as np
import pytest

from sketchtree import keys
from sketchtree.errors import TemplateError
from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.flowers.atlas import HEART, PETAL, STEM, atlas
from sketchtree.foliage.flowers.pieces import BOWL, FINE, PLAIN, bud, flower, petal
from sketchtree.foliage.flowers.recipe import names, read_recipe, recipe
from sketchtree.foliage.flowers.shape import axes_along, grid, joined
from sketchtree.foliage.flowers.worn import INSTANCED, MERGED, flower_for, flower_painting, flower_shape
from sketchtree.foliage.instanced import leaf_instances
from sketchtree.foliage.leaf_cards import leaf_cards
from sketchtree.foliage.leaf_materials import leaf_material
from sketchtree.foliage.leaves import select
from sketchtree.foliage.models import leaf_model, leaf_names, leaf_painting
from sketchtree.rig.leaf_rows import leaf_rows
from tests.foliage.trees import HABIT, small_tree

KEY = keys.root_key(3)
FLOWERS = [name for name in leaf_names() if leaf_model(name).flower]


def test_every_blossom_has_a_recipe_and_no_recipe_is_without_one():
    assert sorted(FLOWERS) == list(names())


@pytest.mark.parametrize("name", FLOWERS)
def test_a_blossom_is_about_as_long_as_its_model_says_and_starts_at_its_foot(name):
    for level in (FINE, PLAIN, BOWL):
        shape = flower_shape(name, level)
        assert 0.55 < shape.position[:, 1].max() < 1.15 and np.abs(shape.position).max() < 1.15
        assert np.linalg.norm(shape.position, axis=1).min() < 0.1
        assert (shape.uv >= 0).all() and (shape.uv <= 1).all()
        assert np.allclose(np.linalg.norm(shape.normals(), axis=1), 1.0)


@pytest.mark.parametrize("name", FLOWERS)
def test_it_comes_in_three_finenesses_each_of_fewer_triangles(name):
    fine, plain, bowl = (len(flower_shape(name, level).triangle) for level in (FINE, PLAIN, BOWL))
    assert fine > 1.4 * plain > 1.4 * bowl and bowl < 200


@pytest.mark.parametrize("level", [FINE, PLAIN])
def test_a_rose_s_flower_has_five_petals_alike_round_its_heart(level):
    made, one = flower(recipe("cherry_blossom"), level), petal(recipe("cherry_blossom"), level, 0.0, 20.0, 2.0)
    out = np.linalg.norm(made.position[:, [0, 2]], axis=1)
    tips = made.position[out > 0.93 * out.max()]
    turn = np.degrees(np.arctan2(tips[:, 0], tips[:, 2]))
    assert len(np.unique(np.round(turn / 72.0) % 5)) == 5
    assert len(made.position) > 5 * len(one.position)


def test_petals_of_an_open_flower_lie_flat_and_those_of_a_bud_close_over_it():
    made = recipe("apple_blossom")
    open_, shut = flower(made, PLAIN), bud(made, PLAIN)
    wide = lambda shape: np.linalg.norm(shape.position[:, [0, 2]], axis=1).max()  # noqa: E731
    assert wide(shut) < 0.5 * wide(open_)


def test_a_pea_flower_has_its_standard_above_and_its_keel_below():
    made = flower(recipe("cercis_blossom"), FINE)
    assert made.position[:, 2].max() > 0.1 > -0.1 > made.position[:, 2].min()
    assert np.abs(made.position[:, 0] + 0).max() == pytest.approx(np.abs(made.position[:, 0]).max())
    assert made.position[:, 0].max() == pytest.approx(-made.position[:, 0].min(), abs=0.15)


def test_the_flower_from_above_has_holes_between_its_petals_and_the_petal_has_none():
    painting = flower_painting("cherry_blossom")
    rows, columns = painting.coverage.shape
    face = painting.coverage[:, : columns // 2]
    assert 0.3 < face.mean() < 0.6
    left, top, right, bottom = PETAL
    assert painting.coverage[int(top * rows) : int(bottom * rows), int(left * columns) : int(right * columns)].min() == 1.0
    for patch, mask in ((STEM, painting.stem), (HEART, painting.vein)):
        assert mask[int(patch[1] * rows), int(patch[0] * columns)] == 1.0


def test_a_notch_cuts_the_petals_tips():
    full, notched = (atlas(replace(recipe("cherry_blossom"), notch=depth)).coverage for depth in (0.0, 0.3))
    assert notched.sum() < full.sum()


def test_few_blossoms_are_fine_many_are_simpler_and_very_many_are_cards():
    shapes = [flower_for("cherry_blossom", count, MERGED) for count in (100, 2000, 10_000, 100_000)]
    assert [None if shape is None else len(shape.triangle) for shape in shapes] == [
        *(len(flower_shape("cherry_blossom", level).triangle) for level in (FINE, PLAIN, BOWL)), None,
    ]  # fmt: skip
    assert flower_for("oak", 1, MERGED) is None
    assert len(flower_for("cherry_blossom", 2000, INSTANCED).triangle) > len(shapes[1].triangle)


@pytest.fixture(scope="module")
def blossoms():
    return blossom(small_tree(twigs=6), HABIT, key=KEY, model="cherry", season="spring")


def test_a_tree_in_spring_wears_meshes_in_the_textures_of_petals(blossoms):
    mesh = leaf_mesh(blossoms, season="spring")
    one = flower_shape("cherry_blossom", FINE)
    assert mesh.name == "leaf_blossom" and mesh.material is leaf_material("cherry_blossom", "spring")
    assert len(mesh.triangle) == len(blossoms) * len(one.triangle)


def test_drawn_many_times_it_is_written_once(blossoms):
    (found,) = leaf_instances(blossoms, season="spring")
    assert len(found) == len(blossoms)
    assert len(found.mesh.triangle) == len(flower_shape("cherry_blossom", FINE).triangle)
    assert np.abs(found.merged().position - leaf_mesh(blossoms, season="spring").position).max() < 1e-9


def test_coarser_levels_are_cards_of_the_drawn_cluster(blossoms):
    few = leaf_cards(blossoms, season="spring", triangles=2 * len(blossoms))
    assert few.triangle_count <= 2 * len(blossoms) and few.material.name == "leaf_cherry_blossom_simple"


def test_wind_knows_which_blossom_each_vertex_is_part_of(blossoms):
    found = leaf_rows(leaf_mesh(blossoms, season="spring"), blossoms)
    assert (np.bincount(found.leaf) == len(flower_shape("cherry_blossom", FINE).position)).all()


def test_too_many_for_meshes_are_crossed_cards_in_the_drawn_cluster(blossoms):
    many = select(blossoms, np.zeros(20_000, int))
    mesh = leaf_mesh(many, season="spring")
    assert len(mesh.triangle) == 4 * len(many) and mesh.material.name == "leaf_cherry_blossom_cards"


def test_short_shoots_that_bear_flowers_have_the_colour_of_stems_in_either_texture(blossoms):
    shoot = np.array([[[0.0, 1, 0], [0.0, 1.1, 0]]])
    few, many = replace(blossoms, shoot=shoot), replace(select(blossoms, np.zeros(20_000, int)), shoot=shoot)
    assert leaf_mesh(few).uv[-6:].tolist() == [list(STEM)] * 6
    assert leaf_instances(few)[-1].mesh.uv.tolist() == [list(STEM)] * 6
    at = (leaf_mesh(many).uv[-6:] * leaf_painting("cherry_blossom").stem.shape[::-1]).astype(int)
    assert leaf_painting("cherry_blossom").stem[at[:, 1], at[:, 0]].mean() > 0.8


def test_a_redbud_flowers_out_of_its_old_wood_and_to_all_sides():
    tree = small_tree(twigs=8)
    found = blossom(tree, replace(HABIT, twig_radius=0.004), key=KEY, model="cercis", season="spring")
    assert found.model == "cercis_blossom" and len(found) > 20
    assert (tree.radius[tree.parent[found.segment]] > 0.9 * 0.004).all()  # where the piece that bears it begins
    assert (found.direction[:, 1] < 0).any() and (found.direction[:, 1] > 0.5).any()


def test_pieces_are_joined_in_the_order_that_they_are_given():
    square = grid(np.array([[[0.0, 0, 0], [1, 0, 0]], [[0, 1, 0], [1, 1, 0]]]), np.zeros((2, 2, 2)))
    both = joined([square, square.placed([0, 0, 5], axes_along([0, 1, 0]), 2.0)])
    assert len(both.position) == 8 and (both.triangle[2:] == square.triangle + 4).all()
    assert both.position[4:, 2].tolist() == [5.0] * 4 and both.position[7, 1] == 2.0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "Flower f.toml: `form` is missing. Give one of: umbel, plate, panicle, catkin, cluster."),
        ('form = "bunch"', "Flower f.toml: `form` is 'bunch'. Give one of: umbel, plate, panicle, catkin, cluster."),
        ('form = "umbel"\npetal = 5', "Flower f.toml: `petal` is not known. Leave it out; known are: form, flower, petals, flowers, buds, radius, width, notch, cup, heart, throat, stamens, "
         "stamen, stalk, spread, wide."),
        ('form = "umbel"\npetals = 5.5', "Flower f.toml: `petals` is 5.5. Give a whole number from 3 to 8."),
        ('form = "umbel"\nradius = 7', "Flower f.toml: `radius` is 7. Give a number from 0.01 to 1."),
    ],
)  # fmt: skip
def test_a_recipe_at_fault_is_named(tmp_path, text, message):
    (tmp_path / "f.toml").write_text(text, encoding="utf-8")
    with pytest.raises(TemplateError) as caught:
        read_recipe(tmp_path / "f.toml")
    assert str(caught.value) == message


def test_a_recipe_that_can_t_be_read_is_named(tmp_path):
    (tmp_path / "f.toml").write_text("form =", encoding="utf-8")
    with pytest.raises(TemplateError, match=r"^Flower f.toml: it can't be read \(.*\)\. Give a readable TOML file\.$"):
        read_recipe(tmp_path / "f.toml")
