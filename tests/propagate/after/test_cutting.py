import numpy as np
import pytest
from tests.propagate.after.hanging import grown, rod
from tests.propagate.worlds import drawn_tree

from sketchtree.propagate.after.cutting import bears, borne, cut, path_length, pieces, start_radius


def test_nothing_to_cut_leaves_the_very_tree():
    tree = grown()
    assert cut(tree, np.ones(len(tree))).skeleton is tree


def test_a_row_cut_at_its_middle_ends_there_with_the_radius_there_and_bears_nothing():
    tree = rod([[1, 3, 0], [2, 3, 0], [3, 3, 0]])
    tree = tree.replace(radius=np.array([0.1, 0.1, 0.04, 0.02, 0.01]))
    left = cut(tree, np.array([1, 1, 1, 0.25, 1]))
    np.testing.assert_array_equal(left.rows, [0, 1, 2, 3])
    np.testing.assert_allclose(left.skeleton.tip[3], [1.25, 3, 0])
    assert left.skeleton.radius[3] == pytest.approx(0.035)


def test_a_share_of_0_drops_the_row_and_all_it_bears():
    tree = grown()
    share = np.ones(len(tree))
    share[5] = 0.0
    left = cut(tree, share)
    gone = np.setdiff1d(np.arange(len(tree)), left.rows)
    at = np.arange(len(tree)) == 5
    np.testing.assert_array_equal(gone, np.flatnonzero(at | borne(tree.parent, at)))


def test_a_drawn_curve_is_cut_along_its_own_path():
    tree = drawn_tree(4)
    row = int(np.flatnonzero(np.diff(tree.curve_start) > 0)[0])
    path = tree.curve(row)
    for share in (0.1, 0.5, 0.9):
        only = np.ones(len(tree))
        only[row] = share
        left = cut(tree, only)
        new = int(np.flatnonzero(left.rows == row)[0])
        kept = left.skeleton.curve(new)
        np.testing.assert_array_equal(kept[:-1], path[: len(kept) - 1])
        assert path_length(left.skeleton)[new] == pytest.approx(share * path_length(tree)[row])


def test_a_stump_too_short_to_see_is_left_out():
    tree = rod([[1, 3, 0], [2, 3, 0]])
    assert len(cut(tree, np.array([1, 1, 1, 1e-5])).rows) == 3


def test_pieces_are_the_polylines_of_the_rows():
    tree = drawn_tree(5)
    row, start, end, number = pieces(tree)
    for one in np.flatnonzero(~tree.is_base):
        of = row == one
        np.testing.assert_array_equal(np.vstack([start[of][:1], end[of]]), tree.curve(one))
        np.testing.assert_array_equal(number[of], np.arange(of.sum()))
    assert not np.isin(row, np.flatnonzero(tree.is_base)).any()


def test_wood_starts_as_thick_as_the_limb_it_goes_on_from_and_a_new_limb_as_its_own():
    tree = rod([[1, 3, 0], [2, 3, 0]], 0.02)
    np.testing.assert_array_equal(start_radius(tree), [0.1, 0.1, 0.02, 0.02])


def test_bears_and_borne_look_down_and_up_the_tree():
    parent = np.array([-1, 0, 1, 1, 3])
    three = np.arange(5) == 3
    np.testing.assert_array_equal(bears(parent, three), [True, True, False, True, False])
    np.testing.assert_array_equal(borne(parent, three), [False, False, False, False, True])
