"""A photo comes through the door of sources: the grown wood of every tree marked in it, or of the one that it seems to show."""

import dataclasses

import numpy as np
import pytest

import painted
from sketchtree import stage
from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.photo_tree import GrownInPhoto, PhotoSource, grow_in_photo
from sketchtree.planting import tree_key
from sketchtree.skeleton import Kind, TreeSkeleton

KEY = root_key(3)
SOURCE = PhotoSource(PhotoOptions(replacements=3), ReadingOptions(method="okabe", template="none", height=6.0))


@pytest.fixture(scope="module")
def one() -> TreeSkeleton:
    return SOURCE((painted.bare_tree(), [painted.marked("left")]), key=KEY)


def test_a_photo_comes_through_the_plug_in_door():
    assert stage.sources()["photo"] is PhotoSource
    assert isinstance(SOURCE, stage.SkeletonSource)


def test_it_gives_the_visible_limbs_and_what_grew(one):
    assert isinstance(one, TreeSkeleton) and {Kind.DRAWN, Kind.PROPAGATED} <= set(one.kind.tolist())
    np.testing.assert_allclose(one.tip[one.is_base], 0.0, atol=1e-12)


@pytest.fixture(scope="module")
def found() -> GrownInPhoto:
    return grow_in_photo(painted.bare_tree(), painted.marked("left"), key=tree_key(KEY, 0), wanted=SOURCE.wanted, reading=SOURCE.reading)


def test_the_visible_limbs_lie_where_the_photo_shows_them(found):
    """§3.1: orthographic camera; the foot of the trunk is the world's origin."""
    shown = found.seen.pixels(found.grown.skeleton.tip[found.grown.drawn_row])
    pixels = np.concatenate([found.traced.xy[[0]], found.traced.xy])
    assert max(np.hypot(*(pixels - at).T).min() for at in shown) < 1e-6


def test_the_same_key_gives_the_same_wood(one):
    again = SOURCE((painted.bare_tree(), [painted.marked("left")]), key=KEY)
    for column in ("parent", "tip", "radius", "limb", "curve_points"):
        np.testing.assert_array_equal(getattr(one, column), getattr(again, column))


def test_two_trees_stand_as_far_apart_as_the_photo_shows(one, found):
    mark = painted.marked("left")
    aside = dataclasses.replace(mark, branches=tuple(line + [60.0, 0.0] for line in mark.branches))
    both = SOURCE((painted.bare_tree(), [mark, aside]), key=KEY)
    assert set(both.tree.tolist()) == {0, 1}
    np.testing.assert_array_equal(both.tip[both.tree == 0], one.tip)
    np.testing.assert_allclose(both.tip[both.is_base][1], [60.0 * found.seen.similarity.scale, 0.0, 0.0], atol=1e-9)
