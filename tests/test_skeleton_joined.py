"""Skeletons put together, put in another order, moved: nothing of a row is lost."""

import numpy as np

from sketchtree.skeleton_joined import joined, moved, reordered
from tests.propagate.worlds import drawn_tree

A, B = drawn_tree(limbs=4), drawn_tree(limbs=6, seed=2)


def test_joined_trees_are_the_trees_they_were():
    both = joined([A, B])
    first, second = np.arange(len(both)) < len(A), np.arange(len(both)) >= len(A)
    for part, tree in ((both.select(first), A), (both.select(second), B)):
        for name in ("parent", "tip", "radius", "limb", "stroke", "curve_points", "curve_start"):
            np.testing.assert_array_equal(getattr(part, name), getattr(tree, name))


def test_rows_in_another_order_keep_parents_and_curves():
    both = joined([A, B])
    order = np.argsort(np.r_[np.arange(len(A)), np.arange(len(B))], kind="stable")
    turned = reordered(both, order)
    np.testing.assert_array_equal(turned.tip, both.tip[order])
    np.testing.assert_array_equal(turned.start, both.start[order])
    for new, old in enumerate(order):
        np.testing.assert_array_equal(turned.curve(new), both.curve(old))


def test_a_moved_tree_has_the_same_shape():
    far = moved(A, np.array([5.0, 0.0, -2.0]))
    np.testing.assert_allclose(far.vector, A.vector, atol=1e-14)
    np.testing.assert_array_equal(far.tip, A.tip + [5.0, 0.0, -2.0])
    np.testing.assert_array_equal(far.curve_points, A.curve_points + [5.0, 0.0, -2.0])
