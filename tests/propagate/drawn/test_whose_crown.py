"""Outlines go to the trees that are drawn in them."""

import numpy as np

from sketchtree.propagate.drawn.whose_crown import outlines_of_trees
from sketchtree.skeleton_joined import moved
from tests.propagate.worlds import circle, drawn_tree

LEFT = drawn_tree()
RIGHT = moved(drawn_tree(seed=2), np.array([12.0, 0, 0]))


def owners(*outlines, trees=(LEFT, RIGHT)):
    found = outlines_of_trees(list(trees), outlines)
    return [[k for k, outline in enumerate(outlines) if any(outline is its for its in one)] for one in found]


def test_a_single_tree_has_all_outlines():
    assert owners(circle(), circle(x=40.0), trees=(LEFT,)) == [[0, 1]]


def test_each_tree_has_the_outline_around_it():
    assert owners(circle(x=12.0), circle()) == [[1], [0]]


def test_an_outline_around_two_trees_is_both_trees_crown():
    wide = circle(x=6.0, radius=1.0) * [14.0, 7.0] - [78.0, 33.0]
    assert owners(wide) == [[0], [0]]


def test_an_outline_that_only_a_limb_pokes_into_is_not_that_trees():
    assert owners(circle(x=9.0, radius=4.5)) == [[], [0]]


def test_an_outline_above_a_trunk_is_the_nearest_tips():
    assert owners(circle(x=11.0, y=14.0, radius=2.0)) == [[], [0]]
