"""Limbs run smoothly from their bearer's axis to their ends."""

import numpy as np
import pytest
from silhouettes import capsules

from sketchtree.trunk.limbs import between_forks, limb_of, own_radius
from sketchtree.trunk.skeletonise import trunk_skeleton

STEM = ((100.0, 240.0), (100.0, 20.0), 9.0)


def limbs_of(skeleton):
    """(limb of every node, parent)."""
    assert np.all(skeleton.parent < np.arange(len(skeleton)))  # parents first
    return limb_of(skeleton.parent, skeleton.xy, skeleton.radius)[0], skeleton.parent


@pytest.mark.parametrize("side", [1, -1])
def test_a_trunk_runs_straight_past_its_limbs(side):
    skeleton = trunk_skeleton(capsules([STEM, ((100.0, 170.0), (100.0 + 70 * side, 100.0), 7.0), ((100.0, 120.0), (100.0 + 70 * side, 60.0), 6.0)], (250, 200)))
    limb, _ = limbs_of(skeleton)
    assert np.abs(skeleton.xy[limb == 0, 0] - 100.0).max() < 1.6


@pytest.mark.parametrize("rise", [20.0, 70.0, 110.0])
def test_a_limb_leaves_its_bearer_at_the_angle_at_which_it_is_seen(rise):
    skeleton = trunk_skeleton(capsules([STEM, ((100.0, 160.0), (165.0, 160.0 - rise), 4.0)], (250, 200)))
    limb, parent = limbs_of(skeleton)
    first = int(np.flatnonzero((limb == 1) & (limb[parent] == 0))[0])
    step = skeleton.xy[first] - skeleton.xy[parent[first]]
    assert np.degrees(np.arctan2(-step[1], step[0])) == pytest.approx(np.degrees(np.arctan2(rise, 65.0)), abs=9.0)
    assert skeleton.xy[parent[first]] == pytest.approx([100.0, 160.0], abs=7.0)


def test_along_a_fork_a_limb_is_as_thick_as_before_and_behind_it():
    parent = np.array([-1, 0, 1, 2, 3, 4, 5, 2, 7, 8])
    xy = np.array([[0, 0], [0, -20], [0, -40], [0, -60], [0, -80], [0, -100], [0, -120], [8, -50], [20, -70], [32, -90]], float)
    radius = np.array([8, 8, 12, 13, 8, 7, 6, 9, 5, 4], float)
    limb = np.array([0] * 7 + [1] * 3)
    own = own_radius(parent, xy, radius, limb)
    thick = between_forks(parent, xy, radius, own, limb)
    assert thick[:7].max() <= 8.0 and np.all(np.diff(thick[:7]) <= 1e-9)
    assert thick[[0, 1, 4, 5, 6]].tolist() == [8, 8, 8, 7, 6]


def test_a_thin_twig_makes_no_fork_in_a_thick_limb():
    parent, limb = np.array([-1, 0, 1, 2, 1]), np.array([0, 0, 0, 0, 1])
    xy, radius = np.array([[0, 0], [0, -20], [0, -40], [0, -60], [30, -30]], float), np.array([8, 8.2, 8, 8, 1.0])
    assert between_forks(parent, xy, radius, radius, limb).tolist() == radius.tolist()
