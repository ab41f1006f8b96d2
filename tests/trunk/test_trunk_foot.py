"""Where a trunk stands, and that it is bare below its crown."""

import numpy as np
import pytest
from silhouettes import LEFT, RIGHT, STEM, capsules

from sketchtree.trunk.edits import VertexEdits
from sketchtree.trunk.foot import LIMB, bare_below, stands_at
from sketchtree.trunk.rooted import Rooted
from sketchtree.trunk.skeletonise import trunk_skeleton

FRINGE = [((50.0, 104.0), (66.0, 100.0), 1.5), ((50.0, 100.0), (35.0, 98.0), 1.5)]


def standing(*sides: tuple[float, float]) -> Rooted:
    """A stem of 100 pixels with level side branches: (height of the fork, length)."""
    heights = sorted({height for height, _ in sides} | {0.0, 100.0})
    xy, parent = [(0.0, -height) for height in heights], [-1, *range(len(heights) - 1)]
    for height, length in sides:
        parent.append(heights.index(height)), xy.append((length, -height))
    return Rooted(np.array(parent), np.array(xy), np.ones(len(xy)))


def left_out(tree: Rooted, asked=()) -> int:
    return bare_below(tree, np.isin(np.arange(len(tree.parent)), asked))[1]


def test_a_trunk_stands_in_the_widest_circle_near_the_ground_not_in_its_lowest_corner():
    xy, radius = np.array([[0.0, 0.0], [0.0, 90.0], [9.0, 99.0], [0.0, 40.0]]), np.array([3.0, 9.0, 0.5, 20.0])
    assert stands_at(xy, radius) == 1


def test_branches_below_the_first_limb_are_left_out():
    assert left_out(standing((10.0, 8.0), (20.0, 12.0), (50.0, 60.0), (60.0, 8.0))) == 2


def test_a_limb_carries_a_quarter_of_the_trees_height():
    assert left_out(standing((20.0, 100 * LIMB + 0.1), (50.0, 80.0))) == 0
    assert left_out(standing((20.0, 100 * LIMB - 0.1), (50.0, 80.0))) == 1


def test_a_tree_of_short_branches_keeps_them():
    assert left_out(standing((20.0, 8.0), (40.0, 10.0), (60.0, 9.0))) == 0


def test_a_branch_that_was_asked_for_stays_below_the_crown():
    tree = standing((20.0, 10.0), (50.0, 60.0))
    assert left_out(tree) == 1 and left_out(tree, asked=(4,)) == 0


def test_a_bare_stem_stays_as_it_is():
    tree = standing()
    assert bare_below(tree, np.zeros(2, bool))[0] is tree


def test_a_fringe_at_the_foot_of_a_matte_is_no_limb_and_told():
    skeleton = trunk_skeleton(capsules([STEM, LEFT, RIGHT, *FRINGE]))
    assert len(skeleton.tips) == 3 and skeleton.xy[skeleton.root] == pytest.approx([50.0, 120.0], abs=1.5)
    assert "2 short branches below the crown were left out." in skeleton.warnings


def test_but_it_is_where_a_vertex_asks_for_it():
    skeleton = trunk_skeleton(capsules([STEM, LEFT, RIGHT, *FRINGE]), edits=VertexEdits(add=((67.5, 99.6),)))
    assert np.hypot(*(skeleton.xy[skeleton.tips] - (67.5, 99.6)).T).min() < 2.0
