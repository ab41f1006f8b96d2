"""What does a tree look like from all sides?"""

import numpy as np

from sketchtree.view.picture import frame_camera
from sketchtree.view.turntable import whirled

def test_the_camera_keeps_its_distance_all_the_way_round():
    points = np.random.default_rng(0).normal(size=(500, 3)) * [3, 2, 1] + [0, 4, 0]
    hull = whirled(points)
    cameras = np.array([frame_camera(hull, 15.0 * k, 6.0, 1.0) for k in range(24)])
    distance = np.linalg.norm(cameras[:, :3] - cameras[:, 3:6], axis=1)
    assert np.ptp(distance) < 1e-6 * distance.mean() and np.ptp(cameras[:, 1]) < 1e-6 * distance.mean()


def test_the_circles_hold_the_tree_in_every_turn():
    points = np.random.default_rng(1).normal(size=(300, 3))
    hull = whirled(points)
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    assert hull[:, 1].min() <= points[:, 1].min() + 1e-9 and hull[:, 1].max() >= points[:, 1].max() - 1e-9
    assert np.hypot(*(hull - middle)[:, [0, 2]].T).max() >= np.hypot(*(points - middle)[:, [0, 2]].T).max() - 1e-9
