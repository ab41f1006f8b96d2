"""A trunk from a picture through the plug-in door, and what its crowns have in common."""

import numpy as np
import pytest
from PIL import Image, ImageDraw

from sketchtree import growth_tree, keys, stage
from sketchtree.errors import OptionError, SkeletonError
from sketchtree.growth_tree import GrowthOptions, TrunkSource, grown_tree, of_skeleton
from sketchtree.matting.scribbles import Scribbles
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.photo.photo import Photo
from sketchtree.skeleton import TreeSkeleton

KEY = keys.root_key(2)


@pytest.fixture(scope="module")
def picture():
    """A forked trunk before a plain sky, and a line on and beside it."""
    drawn = Image.new("RGB", (90, 120), (190, 205, 225))
    for start, end, width in (((45, 119), (45, 50), 9), ((45, 70), (20, 25), 5), ((45, 50), (66, 14), 5)):
        ImageDraw.Draw(drawn).line([start, end], (70, 55, 40), width)
    photo = Photo(np.asarray(drawn), None, "tree.png")
    return photo, Scribbles((np.array([(45, 115), (45, 60)]),), (np.array([(8, 8), (8, 110)]), np.array([(82, 8), (82, 110)])))


def bare() -> TreeSkeleton:
    from sketchtree.skeleton_rows import observed

    tip = np.array([(0, 0, 0), (0, 3, 0), (1, 5, 0.2), (-1, 5, -0.2)], float)
    return observed("bare", np.array([-1, 0, 1, 1]), tip, np.array([0.2, 0.15, 0.05, 0.04]))


def test_a_picture_and_scribbles_come_through_the_plug_in_door_as_a_trunk(picture):
    assert stage.sources()["growth"] is TrunkSource
    source = TrunkSource(reading=ReadingOptions(template="none", height=4.0))
    assert isinstance(source, stage.SkeletonSource)
    tree = source(picture, key=KEY)
    assert isinstance(tree, TreeSkeleton) and tree.height == pytest.approx(4.0) and tree.tip[0] == pytest.approx([0, 0, 0])
    assert len(np.unique(tree.limb)) == 2
    again = source(picture, key=KEY)
    assert np.array_equal(tree.tip, again.tip) and np.array_equal(tree.radius, again.radius)


def test_crowns_differ_and_stand_on_one_trunk():
    begun = of_skeleton(bare(), TreeOptions(), None, key=KEY)
    crowns = [grown_tree(begun, GrowthOptions(levels=1), crown=k).model.skeleton for k in range(3)]
    assert all(np.array_equal(crown.tip[: len(bare())], bare().tip) for crown in crowns)
    assert len({crown.tip.tobytes() for crown in crowns}) == 3


def test_a_tree_that_nothing_is_grafted_on_is_the_one_that_was_given():
    grown = grown_tree(of_skeleton(bare(), TreeOptions(), None, key=KEY))
    assert np.array_equal(grown.model.skeleton.tip, bare().tip) and grown.levels == 0
    assert grown.plan.at(1.0) is grown.model.skeleton


def test_levels_that_would_be_too_many_segments_are_told(monkeypatch):
    monkeypatch.setattr(growth_tree, "_LARGE", 10)
    grown = grown_tree(of_skeleton(bare(), TreeOptions(), None, key=KEY), GrowthOptions(levels=5), TreeOptions(max_segments=400))
    assert len(grown.model.skeleton) <= 400 and any("not all were grafted on" in told for told in grown.warnings)


def test_what_can_not_grow_is_refused():
    flat = bare().replace(tip=bare().tip * [1, 0, 1])
    with pytest.raises(SkeletonError, match="can't scale it"):
        of_skeleton(flat, TreeOptions(), None, key=KEY, height=3.0)
    with pytest.raises(OptionError, match="`--bend 90` is out of range"):
        GrowthOptions(bend=90.0)
