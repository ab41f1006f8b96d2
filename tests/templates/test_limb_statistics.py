"""Counts, means and variances of limbs agree with a count by hand."""

import numpy as np
import pytest

from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.limb_statistics import limb_statistics


def small_tree():
    """A trunk of 1 + 1 m; at 1 m a lateral of 0.5 + 0.5 m at 90° that bends 45°, on it one of 0.25 m at 90°."""
    r = 0.5 / np.sqrt(2)
    tip = [[0, 0, 0], [0, 1, 0], [0, 2, 0], [0.5, 1, 0], [0.5 + r, 1 + r, 0], [0.5, 1, 0.25]]
    return TreeSkeleton.from_columns(
        [-1, 0, 1, 1, 3, 3], tip, np.full(6, 0.1), order=np.array([0, 0, 0, 1, 1, 2]), limb=np.array([9, 9, 9, 4, 4, 7])
    )


def test_divergence_length_and_bend_of_a_tree_counted_by_hand():
    found = limb_statistics(small_tree())
    np.testing.assert_array_equal(found.divergence_count, [1, 1])
    np.testing.assert_allclose(found.divergence_mean, np.pi / 2)
    np.testing.assert_allclose(found.divergence_variance, 0)
    np.testing.assert_array_equal(found.length_count, [1, 1])
    np.testing.assert_allclose(found.length_mean, np.log([1 / 2, 0.25 / 1]))
    np.testing.assert_array_equal(found.bend_count, [1, 1, 0])
    np.testing.assert_allclose(found.bend_square, [0, (np.pi / 4) ** 2, 0])


def test_moments_are_of_the_population(shipped):
    tree = shipped.exemplar("hazel").skeleton
    found = limb_statistics(tree)
    rows = [r for r in range(len(tree)) if tree.parent[r] >= 0 and tree.limb[r] != tree.limb[tree.parent[r]]]
    angles = []
    for r in rows:
        if tree.order[r] == 1 and tree.parent[tree.parent[r]] >= 0:
            a, b = tree.vector[r], tree.vector[tree.parent[r]]
            angles.append(np.arccos(np.clip(a @ b / np.linalg.norm(a) / np.linalg.norm(b), -1, 1)))
    assert found.divergence_count[0] == len(angles)
    assert found.divergence_mean[0] == pytest.approx(np.mean(angles), rel=1e-5)
    assert found.divergence_variance[0] == pytest.approx(np.var(angles), rel=1e-4)


def test_a_tree_without_limbs_knows_nothing():
    found = limb_statistics(TreeSkeleton.from_columns([-1, 0], [[0, 0, 0], [0, 1, 0]], [0.1, 0.1]))
    assert found.length_count.sum() == found.divergence_count.sum() == found.bend_count.sum() == 0
    assert found.length_mean.sum() == found.divergence_variance.sum() == found.bend_square.sum() == 0
