"""Leaves are as large as the foliage asks for, lie in it for the most part, and the paper's own are rectangles of a tenth of the trunk's radius, 50 to 200 a branch (§4)."""

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaf_materials import leaf_material
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_model, leaf_names, plain_names
from sketchtree.foliage.populate import populate
from sketchtree.keys import root_key
from sketchtree.parameters import Habit
from sketchtree.photo.leaf_cover import INSIDE, SIZES, SMALLER, best_size, mostly_inside, points_of
from sketchtree.photo.paper_leaves import paper_leaves
from sketchtree.photo.photo import Photo
from sketchtree.photo.photo_leaves import SeenFoliage, without_shadows
from sketchtree.similarity import Similarity
from sketchtree.skeleton import TreeSkeleton

METRES = 0.01  # a pixel


def seen(side: int = 200) -> SeenFoliage:
    """Foliage in a square of 160 pixels; the world's origin at the picture's lower left corner."""
    mask = np.zeros((side, side), bool)
    mask[20:180, 20:180] = True
    return SeenFoliage(Photo(np.full((side, side, 3), 90, np.uint8)), mask, Similarity(METRES, (0.0, side * METRES, 0.0)))


def scattered(count: int, size: float, *, seed: int = 0) -> Leaves:
    draw = np.random.default_rng(seed)
    place = np.column_stack([draw.uniform(0.2, 1.8, (count, 2)), draw.normal(size=count)])
    turn = draw.uniform(0, 2 * np.pi, count)
    direction = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(count)])
    return Leaves("oak", place, direction, np.tile([0.0, 0.0, 1.0], (count, 1)), np.full(count, size), draw.uniform(size=count), np.zeros(count, np.int64))


def test_few_leaves_become_large_and_many_small():
    few, overlap_few, _ = best_size(scattered(800, 0.08), seen())
    many, overlap_many, _ = best_size(scattered(12_000, 0.08), seen())
    assert SIZES[0] <= many < few <= SIZES[-1]
    assert overlap_many > 0.75 and overlap_few > 0.5


def test_no_leaf_becomes_longer_than_a_tree_bears():
    size, _, asked = best_size(scattered(500, 0.08), seen(), height=4.0)
    assert size <= 1.2 < asked


def test_a_leaf_that_leaves_the_foliage_is_made_smaller_or_is_dropped():
    leaves = scattered(4000, 0.2)
    kept = mostly_inside(leaves, seen())
    assert 0 < len(kept) < len(leaves)
    assert set(np.round(np.unique(kept.size / 0.2), 6)) == {SMALLER, 1.0}
    middle = kept.position[:, :2] + 0.5 * kept.size[:, None] * kept.direction[:, :2]
    assert (np.abs(middle - 1.0) <= 0.8 + 0.2 * (1 - INSIDE)).all()


def test_points_stand_for_the_drawing():
    point = points_of("rectangle")
    assert np.abs(point[:, 0]).max() <= 0.5 and 0 <= point[:, 1].min() and point[:, 1].max() <= 1.0
    assert np.ptp(point, axis=0).min() > 0.8


def test_no_leaves_ask_for_nothing():
    assert best_size(Leaves.none("oak"), seen()) == (1.0, 0.0, 1.0) and len(mostly_inside(Leaves.none("oak"), seen())) == 0


def test_shadows_are_halved_and_shaded_leaves_are_no_bluer_than_lit_ones():
    green, sky = np.array([0.10, 0.25, 0.05]), np.array([0.02, 0.03, 0.09])
    shown = without_shadows(np.array([green] * 8 + [0.25 * green, sky]))
    light = shown.sum(axis=1)
    np.testing.assert_allclose(light[8] / light[0], 0.5, rtol=1e-6)
    np.testing.assert_allclose(shown[0] / shown[0].sum(), green / green.sum(), atol=1e-9)
    assert shown[9, 2] / shown[9].sum() <= 1.11 * shown[0, 2] / shown[0].sum()


@pytest.fixture(scope="module")
def tree() -> TreeSkeleton:
    """A trunk of 20 cm with a long and a short branch."""
    parent = np.array([NULL, 0, 1, 1])
    tip = np.array([[0.0, 0, 0], [0, 4, 0], [2, 5, 0], [-1, 4, 0]])
    return TreeSkeleton.from_columns(parent, tip, np.array([0.2, 0.1, 0.03, 0.03]), order=np.array([0, 0, 1, 1]), limb=np.array([5, 5, 7, 9]))


def test_section_4_rectangles_are_a_tenth_of_the_trunks_radius(tree):
    leaves = paper_leaves(tree, key=root_key(0))
    assert leaves.model == "rectangle" and np.allclose(leaves.size, 0.02) and leaves.kept == 1.0
    np.testing.assert_allclose(np.einsum("ij,ij->i", leaves.direction, leaves.normal), 0.0, atol=1e-12)


def test_section_4_a_branch_has_50_to_200_by_its_length_and_the_trunk_none(tree):
    limb = tree.limb[paper_leaves(tree, key=root_key(0)).segment]
    long, short = np.sqrt(5.0), 1.0
    assert (limb == 5).sum() == 0 and (limb == 7).sum() == 200
    assert (limb == 9).sum() == pytest.approx(50 + 150 * short / long, abs=4)


def test_section_4_leaves_stand_along_the_whole_branch_at_random(tree):
    leaves = paper_leaves(tree, key=root_key(0))
    along = np.sort(leaves.position[tree.limb[leaves.segment] == 7, 0]) / 2.0
    assert np.abs(along - np.linspace(0, 1, len(along))).max() < 0.12
    assert np.linalg.norm(leaves.direction.mean(axis=0)) < 0.15
    other = paper_leaves(tree, key=root_key(1))
    assert len(other) == len(leaves) and not np.array_equal(other.position, leaves.position)
    np.testing.assert_array_equal(paper_leaves(tree, key=root_key(0)).position, leaves.position)


def test_fewer_rectangles_have_the_same_area(tree):
    whole, few = paper_leaves(tree, key=root_key(0)), paper_leaves(tree, key=root_key(0), most=100)
    assert len(few) < 0.6 * len(whole) and few.kept < 1
    assert (few.size**2).sum() == pytest.approx((whole.size**2).sum(), rel=0.15)


def test_the_rectangle_is_a_model_that_nobody_is_offered():
    assert plain_names() == ("rectangle",) and "rectangle" not in leaf_names()
    assert leaf_model("rectangle").fold == 0 and leaf_model("rectangle").is_blade
    alpha = leaf_material("rectangle").base_color_texture[..., 3]
    assert alpha[20:-20, 20:-20].min() == 255 and alpha[0].max() == 0


def test_a_rectangle_is_drawn_as_a_flat_square(tree):
    leaves = paper_leaves(tree, key=root_key(0))
    mesh = leaf_mesh(leaves)
    corner = mesh.position.reshape(len(leaves), -1, 3)[0]
    flat = (corner - corner.mean(axis=0)) @ leaves.normal[0]
    assert np.abs(flat).max() < 1e-9 and np.ptp(corner @ leaves.direction[0]) == pytest.approx(0.02, rel=0.1)


def test_leaves_are_as_many_times_as_large_as_asked(tree):
    plain, large = (populate(tree, Habit(twig_radius=0.02), key=root_key(0), scale=scale) for scale in (1.0, 1.7))
    assert len(plain) > 0
    np.testing.assert_allclose(large.size, 1.7 * plain.size)
    with pytest.raises(OptionError) as caught:
        populate(tree, Habit(), key=root_key(0), scale=0.0)
    assert str(caught.value) == "The leaves' scale is 0.0, but it must be above 0. Use 1 for the species' own."
