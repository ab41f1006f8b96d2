"""Clouds of trees of our own: their points lie where the tree is, and are the same for everybody."""

import numpy as np
from scipy.spatial import cKDTree

from benchmarks.cloud_sheets.own_clouds import own_cloud
from sketchtree.fidelity.sampled import along


def test_points_lie_on_the_bark():
    cloud = own_cloud("apple", 2000, noise=0.0)
    axes, row = along(cloud.tree, 0.01)
    far, near = cKDTree(axes).query(cloud.xyz)
    assert (far <= 2.1 * cloud.tree.radius[row[near]] + 0.02).mean() > 0.98
    assert not cloud.leaf.any()


def test_so_many_points_are_of_leaves_and_lie_off_the_wood():
    cloud = own_cloud("apple", 2000, leafy=0.5, noise=0.0)
    far = cKDTree(along(cloud.tree, 0.01)[0]).query(cloud.xyz)[0]
    assert cloud.leaf.sum() == 1000
    assert np.median(far[cloud.leaf]) > 2 * np.median(far[~cloud.leaf])


def test_one_scanner_sees_the_near_side_best_and_the_same_seed_the_same():
    one, again = (own_cloud("apple", 2000, uneven=True) for _ in range(2))
    assert np.array_equal(one.xyz, again.xyz)
    near = one.xyz @ np.array([1.0, 0.0, 1.0]) > 0
    assert near.sum() > 1.5 * (~near).sum()
