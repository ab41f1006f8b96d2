"""One photo and a few strokes become a whole tree: it covers the foliage, its visible limbs lie where the photo shows them, it has the photo's colours."""

import numpy as np
import pytest

import leafy
import painted
from sketchtree.errors import OptionError
from sketchtree.keys import root_key
from sketchtree.levels.raster import View, silhouette
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.photo.photo import Photo
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.photo_tree import PhotoModel, photo_to_tree
from sketchtree.propagate.attractors.predefined import type_one

READING = ReadingOptions(method="okabe", template="apple", height=6.0)


def grown(photo, marks, *, seed=0, tree=TreeOptions(), mask=None, depths=None, **wanted) -> PhotoModel:
    how = PhotoOptions(**{"replacements": 12} | wanted)
    return photo_to_tree(photo, marks, key=root_key(seed), wanted=how, reading=READING, tree=tree, mask=mask, depths=depths)


@pytest.fixture(scope="module")
def one() -> PhotoModel:
    return grown(leafy.leafy_photo(), [leafy.leafy_marks()])


def shown(model: PhotoModel, meshes) -> np.ndarray:
    """Where meshes are seen in the photo."""
    pixels = max(model.photo.width, model.photo.height)
    left, _, _, top = model.frame
    half = 0.5 * pixels * model.trees[0].seen.similarity.scale
    view = View(np.array([1.0, 0, 0]), np.array([0, 1.0, 0]), np.array([left + half, top - half, 0.0]), half, pixels)
    return silhouette(meshes, view)[: model.photo.height, : model.photo.width]


def test_leaves_and_wood_cover_the_foliage_and_hardly_more(one):
    foliage = one.trees[0].foliage
    found = shown(one, one.model.meshes) & foliage.region
    assert (found & foliage.mask).sum() / (found | foliage.mask).sum() > 0.8


def test_every_leaf_is_confirmed_by_the_photo(one):
    tree = one.trees[0]
    leaves = tree.model.leaves
    middle = tree.seen.pixels(leaves.position + 0.5 * leaves.size[:, None] * leaves.direction)
    column, row = np.floor(middle).astype(int).T
    assert len(leaves) > 1000 and tree.foliage.mask[row, column].mean() > 0.95


def test_the_visible_limbs_are_projected_where_they_were_traced(one):
    tree = one.trees[0]
    at = tree.seen.pixels(tree.grown.skeleton.tip[tree.grown.drawn_row])
    assert max(np.hypot(*(tree.traced.xy - point).T).min() for point in at) < 1e-6


def test_the_root_is_the_origin_and_the_frame_is_the_photo(one):
    left, bottom, right, top = one.frame
    scale = one.trees[0].seen.similarity.scale
    np.testing.assert_allclose(one.model.skeleton.tip[one.model.skeleton.is_base], 0.0, atol=1e-9)
    assert (right - left) / scale == pytest.approx(leafy.WIDE) and (top - bottom) / scale == pytest.approx(leafy.HIGH)
    assert left / scale == pytest.approx(-leafy.TRUNK[0][0]) and bottom / scale == pytest.approx(leafy.TRUNK[0][1] - leafy.HIGH)


def test_leaves_have_the_photos_colour(one):
    seen = one.trees[0].model.leaves.seen
    assert seen is not None and (seen[:, 1] > seen[:, 2]).mean() > 0.98 and (seen[:, 1] > seen[:, 0]).mean() > 0.98


def test_the_same_seed_gives_the_same_tree_and_another_one_another(one):
    again, other = (grown(leafy.leafy_photo(), [leafy.leafy_marks()], seed=seed) for seed in (0, 1))
    for mesh, same in zip(one.model.meshes, again.model.meshes, strict=True):
        np.testing.assert_array_equal(mesh.position, same.position)
        np.testing.assert_array_equal(mesh.color, same.color)
    assert [len(mesh.position) for mesh in other.model.meshes] != [len(mesh.position) for mesh in one.model.meshes]


@pytest.fixture(scope="module")
def autumn() -> PhotoModel:
    return grown(leafy.leafy_photo(leafy.RUSTY, at=(0, 200)), [leafy.leafy_marks(), leafy.leafy_marks(200)], depths=[1.5], replacements=4, libraries=[["I"]])


def test_autumn_leaves_are_rusty(autumn):
    for tree in autumn.trees:
        assert (tree.model.leaves.seen[:, 0] > 1.5 * tree.model.leaves.seen[:, 1]).mean() > 0.95


def test_two_trees_of_a_photo_stand_apart_as_it_shows_and_in_depth_as_asked(autumn):
    scale = autumn.trees[0].seen.similarity.scale
    np.testing.assert_allclose(autumn.place, [[0, 0, 0], [200 * scale, 0, 1.5]], atol=1e-9)
    forest = autumn.model
    assert len(forest.names) == 2 and forest.names == ("leafy.png (1)", "leafy.png (2)")
    for tree, place in zip(autumn.trees, autumn.place, strict=True):
        base = tree.model.skeleton.tip[tree.model.skeleton.is_base]
        np.testing.assert_allclose(base[0], place, atol=1e-9)
        assert abs(np.median(tree.model.leaves.position[:, 0]) - place[0]) < 1.0


def test_each_tree_of_a_photo_grows_with_its_own_library(autumn):
    first, second = (next(iter(tree.grown.grown.values())).library for tree in autumn.trees)
    forks = {one.name for one in type_one()}
    assert set(second) == forks < set(first)


@pytest.mark.parametrize("more", [{"depths": [1.0]}, {"libraries": (("I",),)}])
def test_what_is_given_for_more_trees_than_are_marked_is_refused(more):
    with pytest.raises(OptionError, match="is given for 2 trees, and 1 is marked. Give it once for each tree."):
        grown(leafy.leafy_photo(), [leafy.leafy_marks()], **more)


def test_further_trees_stand_level_with_the_first_where_nothing_else_is_said():
    trees = [leafy.leafy_marks(), leafy.leafy_marks(200)]
    model = grown(leafy.leafy_photo(at=(0, 200)), trees, replacements=0, tree=TreeOptions(leaf="none"))
    np.testing.assert_allclose(model.place[:, 2], 0.0)


def test_skeletons_in_pixels_lie_on_the_photo(autumn):
    visible = autumn.visible_in_pixels()
    assert set(visible.tree.tolist()) == {0, 1}
    np.testing.assert_allclose(visible.tip[visible.is_base][:, :2], [[120, -240], [320, -240]], atol=1e-6)
    whole = autumn.in_pixels()
    assert len(whole) > len(visible) and whole.tip[:, 0].max() <= autumn.photo.width and whole.tip[:, 1].max() <= 0


def test_a_mask_says_where_leaves_are():
    mask = np.zeros((leafy.HIGH, leafy.WIDE), bool)
    mask[30:150, 60:120] = True
    half = grown(leafy.leafy_photo(), [leafy.leafy_marks()], mask=mask, replacements=3)
    tree = half.trees[0]
    np.testing.assert_array_equal(tree.foliage.mask, mask & tree.foliage.region)
    assert (tree.seen.pixels(tree.model.leaves.position)[:, 0] < 126).all() and len(tree.model.leaves) > 50


def test_a_grey_photo_gets_the_seasons_colours_and_the_papers_leaves_are_rectangles():
    grey = Photo(np.repeat(np.asarray(leafy.leafy_photo().rgb[..., 1:2]), 3, axis=2), name="grey")
    model = grown(grey, [leafy.leafy_marks()], tree=TreeOptions(leaf="rectangle"), replacements=2, fit_leaves=False)
    leaves, tree = model.model.leaves, model.trees[0]
    assert leaves.model == "rectangle" and leaves.seen is None and len(leaves) > 500
    trunk = tree.model.skeleton.radius[tree.model.skeleton.is_base].max()
    np.testing.assert_allclose(leaves.size, 0.1 * trunk / np.sqrt(leaves.kept))


def test_a_bare_tree_stays_bare_unless_a_leaf_or_a_season_is_asked_for():
    bare = grown(painted.bare_tree(), [painted.marked("left", "right")], replacements=2)
    assert bare.trees[0].foliage.bare and len(bare.model.leaves) == 0
    assert all(not mesh.name.startswith("leaf") for mesh in bare.model.meshes)
    dressed = grown(painted.bare_tree(), [painted.marked("left", "right")], replacements=2, bare_as_seen=False)
    assert len(dressed.model.leaves) > 100
