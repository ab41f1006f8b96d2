"""The flowers of a photo's tree in blossom stand in clusters on short shoots, here many and there none."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from combs import comb_of
from sketchtree.dressing import Dress
from sketchtree.foliage.twigs import wood_pieces
from sketchtree.keys import root_key
from sketchtree.parameters import Habit
from sketchtree.photo.leafing import PhotoLeafing
from sketchtree.photo.photo import Photo
from sketchtree.photo.photo_leaves import SeenFoliage
from sketchtree.photo.umbels import BEARING, LONGEST, SHORTEST, SIZES, UMBELS, Flowering, Patches
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.similarity import Similarity
from sketchtree.skeleton import TreeSkeleton

SIZE, HABIT = 0.02, Habit(twig_radius=0.003, twig_length=0.3, height=1.5)


@pytest.fixture(scope="module")
def comb() -> TreeSkeleton:
    return comb_of(0.05)


def flowers(tree: TreeSkeleton, count: int = 3000, seed: int = 0):
    flowering = Flowering.of(tree, HABIT, "cherry_blossom", size=SIZE, key=root_key(seed))
    return flowering.umbels(wood_pieces(tree), count)


def test_umbels_stand_in_clusters_on_short_shoots(comb):
    found = flowers(comb)
    assert len(found) == pytest.approx(3000, rel=0.15) and found.model == "cherry_blossom"
    assert len(found) / len(found.shoot) == pytest.approx(np.mean(UMBELS), rel=0.1)
    long = np.linalg.norm(found.shoot[:, 1] - found.shoot[:, 0], axis=1) / SIZE
    assert long.min() >= SHORTEST - 1e-9 and long.max() <= LONGEST + 1e-9 and long.std() > 0.3
    points = (found.shoot[None, :, 0] + np.linspace(0, 1, 21)[:, None, None] * (found.shoot[:, 1] - found.shoot[:, 0])).reshape(-1, 3)
    assert cKDTree(points).query(found.position)[0].max() < 0.1 * SIZE
    assert found.size.min() >= SIZES[0] * SIZE and found.size.max() <= SIZES[1] * SIZE
    np.testing.assert_allclose(np.einsum("ij,ij->i", found.direction, found.normal), 0.0, atol=1e-9)


def test_twigs_have_bare_stretches_and_full_ones(comb):
    """Along each twig, in bins of a few umbels: shoots that stand every so far, each kept at even odds, would vary by half of their mean."""
    foot = flowers(comb).shoot[:, 0]
    bins = np.histogram2d(foot[:, 0], foot[:, 1], bins=[np.arange(0.3, 1.71, 3 * SIZE), np.arange(0.275, 1.4, 0.05)])[0]
    assert (bins == 0).mean() > 0.1 and bins.var() > 0.8 * bins.mean()


def test_umbels_look_all_ways_and_hang_as_their_model_does(comb):
    direction = flowers(comb).direction
    assert (np.abs(direction.mean(axis=0)) < 0.25).all() and (direction.std(axis=0) > 0.35).all()
    catkins = Flowering.of(comb, HABIT, "hazel_catkin", size=SIZE, key=root_key(0)).umbels(wood_pieces(comb), 500)
    assert catkins.direction[:, 1].mean() < -0.7


def test_a_field_bears_its_share_and_is_much_alike_near_by():
    patches = Patches.of(SIZE, root_key(3))
    place = np.random.default_rng(0).uniform(-1, 1, (2000, 3))
    field, near, limb = patches.field(place, np.arange(2000)), patches.field(place + [0.2 * SIZE, 0, 0], np.arange(2000)), np.arange(2000)
    assert np.corrcoef(field, near)[0, 1] > 0.9 > 0.2 > abs(np.corrcoef(field, patches.field(place + [0.5, 0, 0], limb + 5000))[0, 1])
    assert patches.bearing(field, np.zeros(2000)).mean() == pytest.approx(BEARING, abs=0.01)
    assert len(patches.bearing(np.zeros(0), np.zeros(0))) == 0


def test_the_same_key_gives_the_same_flowers(comb):
    np.testing.assert_array_equal(flowers(comb).position, flowers(comb).position)
    assert not np.array_equal(flowers(comb).shoot[:50], flowers(comb, seed=1).shoot[:50])


def test_a_photos_tree_in_blossom_covers_its_foliage_but_for_gaps_and_every_umbel_has_a_shoot(comb):
    mask = np.zeros((200, 200), bool)
    mask[60:170, 30:170] = True
    seen = SeenFoliage(Photo(np.full((200, 200, 3), (225, 222, 214), np.uint8)), mask, Similarity(0.01, (0.0, 2.0, 0.0)))

    def worn(**asked):
        return PhotoLeafing(seen, PhotoOptions(**asked))(comb, Dress("cherry", "cherry_blossom", "summer", HABIT), root_key(0))[0]

    leaves = worn()
    place = np.floor(seen.pixels(leaves.position + 0.5 * leaves.size[:, None] * leaves.direction)).astype(int)
    assert mask[place[:, 1], place[:, 0]].mean() > 0.95 and len(leaves.shoot) > 100
    shown = np.zeros_like(mask)
    shown[place[:, 1], place[:, 0]] = True
    assert 0.3 < shown[mask].mean() < 0.95
    np.testing.assert_allclose(worn(leaf_size=2.0).size, 2 * leaves.size)
    assert len(worn(leaf_density=0.5)) == pytest.approx(0.5 * len(leaves), rel=0.1)
