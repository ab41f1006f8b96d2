"""Leaves are as large as the foliage asks for, lie in it for the most part, and the paper's own are rectangles of a tenth of the trunk's radius, 50 to 200 a branch (§4)."""

from dataclasses import replace

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaf_materials import leaf_material
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_model, leaf_names, leaf_painting, plain_names
from sketchtree.foliage.populate import populate
from sketchtree.foliage.triangles import drawn_area
from sketchtree.foliage.twigs import wood_pieces
from sketchtree.keys import root_key
from sketchtree.parameters import Habit
from sketchtree.photo.leaf_cover import BROAD, INSIDE, LONGEST, SHORTEST, Page, best_size, worthwhile
from sketchtree.photo.leaf_filling import followed
from sketchtree.photo.leaf_spots import LeafSpots, spots_of
from sketchtree.photo.paper_leaves import paper_leaves
from sketchtree.photo.photo import Photo
from sketchtree.photo.photo_leaves import VIVID, SeenFoliage, without_shadows
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


def bare_page(of: SeenFoliage) -> Page:
    return Page.of(of, wood_pieces(TreeSkeleton.from_columns(np.array([NULL]), np.zeros((1, 3)), np.ones(1), order=np.zeros(1, int), limb=np.zeros(1, int))))


def size_of(leaves: Leaves, *, height: float = 40.0, most: int = 0) -> float:
    return best_size(leaves, bare_page(seen()), seen(), height=height, most=most)


def test_few_leaves_become_large_and_many_small():
    few, many = size_of(scattered(800, 0.08)), size_of(scattered(12_000, 0.08))
    assert SHORTEST * METRES / 0.08 <= many < 1 < few


def test_leaves_are_smaller_where_more_of_them_may_fill_what_is_open():
    leaves = scattered(6000, 0.04)
    assert size_of(leaves, most=30_000) < size_of(leaves)


def test_no_leaf_becomes_longer_than_a_tree_bears():
    leaves, longest = scattered(500, 0.08), LONGEST * 4.0 * max(np.sqrt(BROAD / drawn_area(leaf_painting("oak"))), 1.0)
    assert 0.08 * size_of(leaves, height=4.0) <= longest < 0.08 * size_of(leaves)


def test_a_leaf_that_leaves_the_foliage_is_dropped():
    leaves, page = scattered(4000, 0.2), bare_page(seen())
    kept = worthwhile(leaves, page, seen())
    assert 0 < len(kept) < len(leaves)
    spots = LeafSpots.of(kept, seen(), 18)
    assert (page.mask[page.pixels(*spots.at(1.0))].mean(axis=1) >= INSIDE - 0.12).all()


def test_a_leaf_that_sticks_out_stays_only_where_no_other_covers_what_it_covers():
    right, front = np.array([[1.0, 0.0, 0.0]]), np.array([[0.0, 0.0, 1.0]])
    out = Leaves("rectangle", np.array([[1.768, 1.0, 0.0]]), right, front, np.array([0.05]), np.array([0.5]), np.zeros(1, int))
    place = np.array([1.742, 1.0, 0.1]) + np.random.default_rng(0).uniform(-0.006, 0.006, (12, 3))
    inner = Leaves("rectangle", place, np.repeat(right, 12, axis=0), np.repeat(front, 12, axis=0), np.full(12, 0.05), np.full(12, 0.5), np.zeros(12, int))
    page = bare_page(seen())
    assert len(worthwhile(out, page, seen())) == 1
    together = worthwhile(followed(inner, out), page, seen())
    np.testing.assert_array_equal(together.position, inner.position)


def test_spots_stand_for_equal_parts_of_the_drawing():
    spot = spots_of("rectangle", 9)
    assert np.abs(spot[:, 0]).max() < 0.5 and 0 < spot[:, 1].min() and spot[:, 1].max() < 1.0
    apart = np.linalg.norm(spot[:, None] - spot, axis=2) + np.eye(9)
    assert apart.min(axis=1).min() > 0.6 * apart.min(axis=1).max()


def test_the_spots_of_a_leaf_have_its_area_as_it_is_seen():
    flat = scattered(1, 0.2)
    turned = replace(flat, normal=np.array([[0.0, 0.6, 0.8]]), direction=np.array([[1.0, 0.0, 0.0]]))
    whole, less = (LeafSpots.of(one, seen(), 9).area.sum() for one in (flat, turned))
    assert whole == pytest.approx(drawn_area(leaf_painting("oak")) * 20.0**2, rel=1e-5) and less == pytest.approx(0.8 * whole, rel=1e-5)


def test_a_tuft_is_seen_from_the_side_of_each_of_its_planes():
    tuft = replace(scattered(1, 0.2), model="spruce")
    spots = LeafSpots.of(tuft, seen(), 9)
    planes = leaf_model("spruce").planes
    assert spots.right.shape == (1, 9 * planes)
    expected = drawn_area(leaf_painting("spruce")) * 20.0**2 * np.abs(np.cos(np.pi * np.arange(planes) / planes)).sum()
    assert spots.area.sum() == pytest.approx(expected, rel=1e-4)


def test_wood_covers_the_foliage_it_is_seen_in_front_of():
    tree = TreeSkeleton.from_columns(np.array([NULL, 0]), np.array([[1.0, 0.3, 0], [1.0, 1.7, 0]]), np.array([0.05, 0.05]), order=np.zeros(2, int), limb=np.zeros(2, int))
    page = Page.of(seen(), wood_pieces(tree))
    hidden = 1.0 - page.beside_wood.reshape(page.shape)
    assert hidden[100, 97:104].min() > 0.9 and hidden[100, :93].max() == 0.0 and hidden[100, 109:].max() == 0.0
    inside, outside = page.covered(np.zeros(len(page.mask), np.float32))
    assert outside == 0.0 and inside == pytest.approx(1400, rel=0.1)


def test_no_leaves_ask_for_nothing():
    none = Leaves.none("oak")
    assert size_of(none) == 1.0 and len(worthwhile(none, bare_page(seen()), seen())) == 0


def test_shadows_are_halved_and_shaded_leaves_are_no_bluer_than_lit_ones():
    green, sky = np.array([0.10, 0.25, 0.05]), np.array([0.02, 0.03, 0.09])
    shown = without_shadows(np.array([green] * 8 + [0.25 * green, sky]))
    light = shown.sum(axis=1)
    np.testing.assert_allclose(light[8] / light[0], 0.5, rtol=1e-6)
    luminance = np.array([0.2126, 0.7152, 0.0722])
    np.testing.assert_allclose(shown[0] / (shown[0] @ luminance) - 1, VIVID * (green / (green @ luminance) - 1), atol=1e-9)
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
