"""What is not the plant goes by stated rules."""

import numpy as np
from ring import camera_at

from sketchtree.clouds.cloud import PointCloud
from sketchtree.keys import root_key
from sketchtree.multiview.sky_and_ground import behind, far_off, ground, sky, within

CHANCE = np.random.default_rng(2)
TREE = np.column_stack([CHANCE.normal(0, 0.1, 800), CHANCE.uniform(0, 3, 800), CHANCE.normal(0, 0.1, 800)])
MEADOW = np.column_stack([CHANCE.uniform(-2, 2, 900), CHANCE.normal(0, 0.006, 900), CHANCE.uniform(-2, 2, 900)])


def test_points_far_from_the_plant_are_told_and_its_own_twigs_are_not():
    chance = np.random.default_rng(0)
    plant = chance.uniform([-0.3, 0.0, -0.3], [0.3, 4.0, 0.3], (3000, 3))
    twig = np.array([0.3, 3.0, 0.0]) + np.linspace(0, 0.8, 30)[:, None] * [1.0, 0.2, 0.0]
    strays = np.array([4.0, 1.0, 0.5]) + chance.normal(0, 0.02, (15, 3))
    found = far_off(np.concatenate([plant, twig, strays]))
    assert found[-15:].all() and not found[:-15].any()
    other = plant + [6.0, 0.0, 0.0]  # a second plant is no stray
    assert not far_off(np.concatenate([plant, other])).any()


def test_blue_or_bright_and_even_to_the_upper_border_is_sky():
    rgb = np.full((40, 40, 3), [0.4, 0.6, 0.9], np.float32)
    rgb[:, 20:] = 0.95
    rgb[25:] = [0.3, 0.4, 0.2]
    found = sky(rgb)
    assert found[:23, :18].all() and found[:23, 23:].all() and not found[25:].any()


def test_a_dark_limb_before_the_sky_and_a_bright_leaf_below_it_are_not():
    rgb = np.full((40, 40, 3), 0.9, np.float32)
    rgb[:, 18:22] = 0.2
    rgb[30:] = 0.2
    rgb[33:37, 5:15] = 0.9
    found = sky(rgb)
    assert not found[:, 18:22].any() and not found[30:].any()


def test_what_stands_behind_the_cameras_ring_is_behind():
    cameras = [camera_at(60.0 * k) for k in range(6)]
    np.testing.assert_array_equal(within(np.array([[0.2, 1.0, 0.0], [9.0, 0.5, 0.0]]), cameras), [True, False])


def test_level_ground_goes_and_the_tree_stays():
    found = ground(PointCloud(np.concatenate([TREE, MEADOW])), key=root_key(0))
    assert found[800:].mean() > 0.99
    assert found[:800][TREE[:, 1] > 0.06].mean() == 0.0


def test_ground_on_a_gentle_slope_goes_too():
    slope = np.array([[np.cos(0.15), -np.sin(0.15), 0], [np.sin(0.15), np.cos(0.15), 0], [0, 0, 1]])
    assert ground(PointCloud(np.concatenate([TREE, MEADOW @ slope.T])), key=root_key(0))[800:].mean() > 0.99


def test_strays_far_out_do_not_save_the_ground():
    strays = np.array([[30.0, 1.0, 0.0], [-30.0, 2.0, 5.0], [0.0, 1.0, 40.0]])
    assert ground(PointCloud(np.concatenate([TREE, MEADOW, strays])), key=root_key(0))[800:1700].mean() > 0.99


def test_a_tree_without_ground_loses_nothing():
    assert not ground(PointCloud(TREE), key=root_key(0)).any()


def test_a_low_tier_of_branches_stays():
    tier = np.column_stack([CHANCE.uniform(-1, 1, 900), CHANCE.normal(0.6, 0.006, 900), CHANCE.uniform(-1, 1, 900)])
    assert not ground(PointCloud(np.concatenate([TREE, tier])), key=root_key(0)).any()


def test_sparse_ground_under_a_dense_tree_goes():
    dense = np.repeat(TREE, 6, axis=0) + CHANCE.normal(0, 0.02, (4800, 3))
    assert ground(PointCloud(np.concatenate([dense, MEADOW[::3]])), key=root_key(0))[4800:].mean() > 0.95


def test_a_pot_that_is_no_wider_than_a_part_of_the_plant_stays():
    crown = np.column_stack([CHANCE.uniform(-1, 1, 900), CHANCE.uniform(2, 3, 900), CHANCE.uniform(-1, 1, 900)])
    pot = MEADOW * [0.1, 1, 0.1]
    assert not ground(PointCloud(np.concatenate([crown, TREE, pot])), key=root_key(0)).any()


def test_the_same_key_gives_the_same_ground():
    cloud = PointCloud(np.concatenate([TREE, MEADOW]))
    np.testing.assert_array_equal(ground(cloud, key=root_key(4)), ground(cloud, key=root_key(4)))


def test_a_smooth_leaf_is_even_but_not_behind_and_a_hole_in_a_fork_is():
    y, x = np.indices((40, 40))
    leaf, hole = np.hypot(x - 12, y - 20) < 8, np.hypot(x - 28, y - 20) < 5
    bark = np.hypot(x - 28, y - 20) < 9
    rgb = np.where(leaf[..., None], [0.3, 0.5, 0.2], np.where((bark & ~hole)[..., None], [0.3, 0.25, 0.2], [0.55, 0.66, 0.8]))
    even = ~(bark & ~hole)
    even[np.hypot(x - 12, y - 20) < 10] = False
    even[np.hypot(x - 12, y - 20) < 6] = True
    found = behind(rgb, even)
    assert not found[leaf].any() and found[hole].all() and found[:, 0].all()
    assert not behind(rgb, even & (leaf | hole)).any()  # nothing reaches the rim
