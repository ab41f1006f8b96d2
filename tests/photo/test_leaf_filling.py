"""More leaves grow where the photo shows foliage, none covers it and a twig is near; and what is worn in a photo covers its foliage and nothing else."""

from dataclasses import replace

import numpy as np
import pytest

from combs import comb_of
from sketchtree.axes import NULL
from sketchtree.dressing import Dress
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.twigs import wood_pieces
from sketchtree.keys import root_key
from sketchtree.parameters import Habit
from sketchtree.photo.leaf_cover import Page
from sketchtree.photo.leaf_filling import REACH, filled
from sketchtree.photo.leafing import MOST, PhotoLeafing
from sketchtree.photo.photo import Photo
from sketchtree.photo.photo_leaves import SeenFoliage, middles, on_shoots
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.similarity import Similarity
from sketchtree.skeleton import TreeSkeleton

METRES, SIZE = 0.01, 0.08  # a pixel, a leaf


def seen() -> SeenFoliage:
    """Foliage in a square of 160 pixels, with an opening; the world's origin at the picture's lower left corner."""
    mask = np.zeros((200, 200), bool)
    mask[20:180, 20:180] = True
    mask[80:100, 60:110] = False
    return SeenFoliage(Photo(np.full((200, 200, 3), (60, 120, 40), np.uint8)), mask, Similarity(METRES, (0.0, 2.0, 0.0)))


@pytest.fixture(scope="module")
def comb() -> TreeSkeleton:
    return comb_of(0.025)


def one_leaf() -> Leaves:
    return Leaves("oak", np.array([[1.0, 1.0, 0.0]]), np.array([[1.0, 0, 0]]), np.array([[0, 0, 1.0]]), np.array([SIZE]), np.array([0.5]), np.ones(1, int))


def more(tree: TreeSkeleton, most: int = 5000, seed: int = 0) -> Leaves:
    wood = wood_pieces(tree)
    return filled(one_leaf(), Page.of(seen(), wood), seen(), wood.select(tree.order[wood.row] > 0), np.array([1.0, 0.0, 0.0]), most=most, key=root_key(seed))


def test_leaves_are_put_where_the_foliage_is_open_and_a_twig_is_near(comb):
    leaves = more(comb)
    place = seen().pixels(middles(leaves)[1:])
    assert len(leaves) > 500
    assert seen().mask[place[:, 1].astype(int), place[:, 0].astype(int)].mean() > 0.97
    highest = 200 - (1.375 + 0.02) / METRES  # row of the highest twig
    assert place[:, 1].min() > highest - (REACH + 0.1) * SIZE / METRES


def test_every_leaf_more_stands_on_its_twig_with_its_face_to_the_light(comb):
    leaves = more(comb)
    row = leaves.segment[1:]
    assert (comb.order[row] == 1).all()
    start, end = comb.tip[comb.parent[row]], comb.tip[row]
    share = np.clip(np.einsum("ij,ij->i", leaves.position[1:] - start, end - start) / np.einsum("ij,ij->i", end - start, end - start), 0, 1)
    away = np.linalg.norm(start + share[:, None] * (end - start) - leaves.position[1:], axis=1)
    assert (away <= SIZE / 3).mean() > 0.97
    np.testing.assert_allclose(np.einsum("ij,ij->i", leaves.direction, leaves.normal), 0.0, atol=1e-9)
    assert (leaves.normal[1:, 1] > 0).mean() > 0.85


def test_no_more_than_allowed_and_the_same_for_the_same_key(comb):
    assert len(more(comb, most=300)) == 300
    np.testing.assert_array_equal(more(comb).position, more(comb).position)
    assert not np.array_equal(more(comb, most=300).position, more(comb, most=300, seed=1).position)


def test_where_there_is_no_twig_or_nothing_is_worn_nothing_is_added(comb):
    wood = wood_pieces(comb)
    page, axis = Page.of(seen(), wood), np.zeros(3)
    assert len(filled(one_leaf(), page, seen(), wood.select(np.zeros(len(wood), bool)), axis, most=100, key=root_key(0))) == 1
    assert len(filled(Leaves.none("oak"), page, seen(), wood, axis, most=100, key=root_key(0))) == 0


def test_shoots_stay_while_a_leaf_stands_on_them():
    shoots = np.array([[[1.0, 1.0, 0], [1.0, 1.1, 0]], [[1.5, 1.0, 0], [1.5, 1.1, 0]]])
    kept = on_shoots(replace(one_leaf(), position=np.array([[1.0, 1.06, 0.0]]), shoot=shoots))
    np.testing.assert_array_equal(kept.shoot, shoots[:1])
    assert len(on_shoots(replace(Leaves.none("oak"), shoot=shoots)).shoot) == 0


def covered(leaves: Leaves) -> float:
    """Overlap of the leaves with the foliage that twigs are near."""
    from sketchtree.photo.leaf_spots import LeafSpots

    page = Page.of(seen(), wood_pieces(TreeSkeleton.from_columns(np.array([NULL]), np.zeros((1, 3)), np.ones(1), order=np.zeros(1, int), limb=np.zeros(1, int))))
    spots = LeafSpots.of(leaves, seen(), 18)
    inside, outside = page.covered(page.depth(page.pixels(*spots.at(1.0)), spots.area))
    return inside / (page.room + outside)


@pytest.mark.parametrize("leaf", ["oak", "birch", "willow", "spruce", "rectangle"])
def test_whatever_it_wears_a_tree_covers_its_foliage(comb, leaf):
    habit = Habit(twig_radius=0.003, twig_length=0.3, height=1.5)
    leaves, _ = PhotoLeafing(seen(), PhotoOptions(colours="season"))(comb, Dress("oak", leaf, "summer", habit), root_key(0))
    reached = (1.36 - 0.2 + 0.06) / 1.6 - 0.04
    assert covered(leaves) > 0.75 * reached and len(leaves) <= MOST


def test_leaves_are_as_many_and_as_large_times_what_covers_as_is_asked(comb):
    habit = Habit(twig_radius=0.003, twig_length=0.3, height=1.5)

    def worn(**asked):
        return PhotoLeafing(seen(), PhotoOptions(colours="season", **asked))(comb, Dress("oak", "oak", "summer", habit), root_key(0))[0]

    plain, large, few = worn(), worn(leaf_size=2.0), worn(leaf_density=0.5)
    np.testing.assert_allclose(large.size, 2 * plain.size)
    assert len(few) == pytest.approx(0.5 * len(plain), rel=0.1)
    np.testing.assert_allclose(np.median(few.size), np.median(plain.size), rtol=0.05)
