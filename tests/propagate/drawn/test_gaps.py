import dataclasses

import numpy as np
from tests.propagate.worlds import HABIT, THETA

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.propagate.drawn.drawn_laterals import DrawnLaterals
from sketchtree.propagate.drawn.ends import open_tips
from sketchtree.propagate.drawn.gaps import WIDEST, into_gaps
from sketchtree.propagate.generations import propagate
from sketchtree.propagate.blocks.open_branch import frames
from sketchtree.skeleton import TreeSkeleton

KEY = keys.root_key(0)


def one_sided(azimuths=(0.1, 0.3, 0.2)):
    """A trunk whose limbs all point the same way."""
    parent, tip, order, limb = [NULL, 0, 1, 2, 3], [[0, y, 0] for y in (0.0, 2.0, 3.0, 4.0, 6.0)], [0] * 5, [1] * 5
    for i, azimuth in enumerate(azimuths):
        parent.append(i + 1)
        tip.append([2 * np.cos(azimuth), tip[i + 1][1] + 1.5, 2 * np.sin(azimuth)])
        order.append(1)
        limb.append(10 + i)
    return TreeSkeleton.from_columns(
        np.array(parent), np.array(tip, float), np.full(len(parent), 0.1), order=np.array(order), limb=np.array(limb),
        kind=np.zeros(len(parent), int),
    )  # fmt: skip


def replicas(tree):
    spacing = np.full(len(tree), 0.4)
    none = open_tips(tree, spacing, HABIT, None, KEY).select(slice(0, 0))
    return into_gaps(tree, frames(tree), DrawnLaterals.of(tree), none, KEY)


def test_no_gap_wider_than_the_widest_is_left():
    new = replicas(one_sided())
    azimuth = np.r_[np.arctan2(new.frame[:, 2, 1], new.frame[:, 0, 1]), 0.1, 0.2, 0.3]
    around = np.sort(azimuth)
    assert np.diff(np.r_[around, around[0] + 2 * np.pi]).max() <= WIDEST + 1e-9


def test_replicas_keep_the_angle_from_the_trunk_and_nearly_the_length():
    tree = one_sided()
    new = replicas(tree)
    rise = 1.5 / np.hypot(2.0, 1.5)
    np.testing.assert_allclose(new.frame[:, 1, 1], rise, atol=1e-9)
    assert (new.length <= 1.05 * np.hypot(2.0, 1.5) + 1e-9).all() and (new.length >= 0.8 * np.hypot(2.0, 1.5)).all()
    assert (new.order == 1).all() and len(np.unique(new.limb)) == len(new)


def test_limbs_all_round_leave_nothing_to_do():
    azimuths = np.arange(3) * 2 * np.pi / 7
    tree = one_sided(azimuths)
    around = TreeSkeleton.from_columns(
        np.r_[tree.parent, [1, 2, 3, 3]], np.concatenate([tree.tip, [
            [2 * np.cos(a), 4.5, 2 * np.sin(a)] for a in np.arange(3, 7) * 2 * np.pi / 7]]),
        np.full(12, 0.1), order=np.r_[tree.order, np.ones(4, int)], limb=np.r_[tree.limb, [20, 21, 22, 23]],
    )  # fmt: skip
    assert len(replicas(around)) == 0


def test_one_limb_is_no_pattern():
    assert len(replicas(one_sided((0.3,)))) == 0


def test_a_one_sided_drawing_becomes_a_tree_with_depth():
    habit = dataclasses.replace(HABIT, height=6.0)
    result = propagate(one_sided(), habit, THETA, key=KEY)
    tip = result.skeleton.tip[result.generation > 0]
    assert np.ptp(tip[:, 2]) > 0.5 * np.ptp(tip[:, 0])
