"""Trees that grew each for itself in one table: parents first, curves and generations with their rows."""

import numpy as np
import pytest

from sketchtree.keys import root_key
from sketchtree.propagate.assembled import assembled
from sketchtree.propagate.together import Member, Together
from sketchtree.propagate.wanted import Wanted
from sketchtree.skeleton_joined import moved
from tests.propagate.worlds import HABIT, THETA, drawn_tree

LEFT, RIGHT = drawn_tree(limbs=4), moved(drawn_tree(limbs=6, seed=2), np.array([30.0, 0, 0]))
WANTED = Wanted(HABIT, THETA, generations=2)


@pytest.fixture(scope="module")
def growing():
    return Together([Member(tree, WANTED, root_key(0)) for tree in (LEFT, RIGHT)]).complete()


def test_one_tree_is_its_own_skeleton(growing):
    tree, generation, row = assembled(growing[:1], [np.arange(len(LEFT))])
    np.testing.assert_array_equal(tree.tip, growing[0].skeleton().tip)
    np.testing.assert_array_equal(row, growing[0].drawn.row)
    np.testing.assert_array_equal(generation, growing[0].generation_of_rows())


def test_rows_of_a_drawing_may_be_mixed_and_come_back_in_order(growing):
    whole = np.random.default_rng(0).permutation(np.r_[np.zeros(len(LEFT), int), np.ones(len(RIGHT), int)])
    rows = [np.flatnonzero(whole == k) for k in (0, 1)]
    tree, generation, row = assembled(growing, rows)
    assert (np.diff(row) > 0).all() and (np.diff(generation) >= 0).all()
    for its, drawn in zip(rows, (LEFT, RIGHT), strict=True):
        np.testing.assert_array_equal(tree.tip[row[its]], drawn.tip)
    assert len(tree) == sum(one.rows for one in growing)
    assert tree.curve_start[-1] == sum(one.drawn.tree.curve_start[-1] for one in growing)


def test_every_row_keeps_the_place_it_starts_from(growing):
    tree, _, _ = assembled(growing, [np.arange(len(LEFT)), len(LEFT) + np.arange(len(RIGHT))])
    pairs = {(*start, *tip) for start, tip in zip(tree.start.tolist(), tree.tip.tolist(), strict=True)}
    for one in growing:
        alone = one.skeleton()
        assert {(*start, *tip) for start, tip in zip(alone.start.tolist(), alone.tip.tolist(), strict=True)} <= pairs
