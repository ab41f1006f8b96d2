"""Of a traced tree, Θ is told by its forks: noise within the layers of its points, spurs, and forks that layers tear apart say nothing."""

import numpy as np
import pytest

from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.templates.estimate import estimate
from sketchtree.templates.importing.forks import forked

LAYER, ANGLE = 0.02, np.radians(50)


def traced(noise=0.0, spurs=0, torn=0, bow=0.0):
    """A trunk of 2 m that bears a lateral of 1 m every .4 m, left and right in turn, in rows of a layer.

    `noise`: of every point, metres; `spurs`: on every lateral, 3 layers long; `torn`: layers above its fork in which another lateral leaves; `bow`: how far
    the laterals lie from straight."""
    random = np.random.default_rng(0)
    parent, tip, radius, limb, order = [-1], [np.zeros(3)], [0.05], [0], [0]

    def path(foot, points, thick, rank):
        number = max(limb) + (rank > 0)
        for point in points:
            parent.append(foot)
            tip.append(point + noise * random.normal(size=3))
            radius.append(thick)
            limb.append(number)
            order.append(rank)
            foot = len(tip) - 1

    steps = np.arange(1, 51)[:, None] * LAYER
    path(0, np.arange(1, 101)[:, None] * LAYER * (0, 1, 0), 0.05, 0)
    for k in range(1, 5):
        for foot in {20 * k, 20 * k + torn}:
            side = (-1) ** (k + foot)
            out = np.array([side * np.sin(ANGLE), np.cos(ANGLE), 0.0])
            across = np.array([-side * np.cos(ANGLE), np.sin(ANGLE), 0.0])
            path(foot, foot * LAYER * np.array([0, 1, 0]) + steps * out + 4 * bow * steps * (1 - steps) * across, 0.02, 1)
            for spur in range(spurs):
                at = len(tip) - 50 + 12 * (spur + 1)
                path(at, tip[at] + steps[:3] * (0, 0, 1), 0.004, 2)
    return TreeSkeleton.from_columns(np.array(parent), np.array(tip), np.array(radius), limb=np.array(limb), order=np.array(order), kind=np.full(len(tip), int(Kind.OBSERVED)))


@pytest.mark.parametrize("harm", [{}, {"noise": 0.002}, {"spurs": 2}, {"noise": 0.002, "spurs": 2}])
def test_the_angle_of_laterals_is_that_of_the_tree(harm):
    tree = forked(traced(**harm))
    theta = estimate(tree)
    assert np.degrees([theta.mu_beta, theta.mu_alpha]) == pytest.approx([50, 0], abs=2)
    assert len(tree) == 1 + 5 + 4, "a base, five segments of the trunk and a lateral at each of its four forks"


def test_what_was_traced_told_another_angle():
    theta = estimate(traced(noise=0.002, spurs=2))
    assert abs(np.degrees(theta.mu_beta) - 50) > 10


def test_laterals_that_layers_tear_apart_leave_at_one_fork():
    tree = forked(traced(torn=3))
    assert np.bincount(tree.parent[tree.order == 1]).max() == 2 and len(tree) == 1 + 5 + 8


def test_a_limb_bends_where_it_is_bent():
    tree = forked(traced(bow=0.1))
    assert (np.bincount(tree.limb[tree.order == 1])[np.unique(tree.limb[tree.order == 1])] >= 3).all()
    points = traced(bow=0.1)
    assert all(_distance(tree, point) < 0.02 + 1e-9 for point in points.tip), "its radius"


def _distance(tree, point):
    along = np.clip(((point - tree.start) * tree.vector).sum(1) / np.maximum(tree.length**2, 1e-12), 0, 1)
    return np.linalg.norm(tree.start + along[:, None] * tree.vector - point, axis=1).min()


def test_a_short_limb_that_bears_a_long_one_stays():
    """A trunk, a stub of three layers on it, and on the stub's end a limb of a metre that is told as another."""
    tree = traced()
    first = int(np.flatnonzero(tree.order == 1)[0])
    limb, order = tree.limb.copy(), tree.order.copy()
    later = (tree.limb == tree.limb[first]) & (np.arange(len(tree)) >= first + 3)
    limb[later], order[later] = limb.max() + 1, 2
    long = [told.length[told.tip[:, 1] > 0].sum() for told in (forked(tree.replace(limb=limb, order=order)), forked(tree))]
    assert long[0] == pytest.approx(long[1])


@pytest.mark.parametrize(("thick", "lead"), [(0.6, 2), (0.4, 3)], ids=["the straightest of those about as thick", "the thickest of others"])
def test_which_child_carries_on_a_limb(thick, lead):
    """Above a metre of trunk a limb leads straight on and another, that was traced as the trunk's end, aside."""
    ends = [np.array([0, 1.0, 0]), np.array([0, 2.0, 0]), np.array([0.8, 1.6, 0])]
    steps = np.arange(1, 51)[:, None] / 50
    tip = np.concatenate([[np.zeros(3)], steps * ends[0], ends[0] + steps * (ends[1] - ends[0]), ends[0] + steps * (ends[2] - ends[0])])
    parent = np.arange(-1, 150)
    parent[101] = 50
    radius = np.repeat([0.04, 0.04 * thick, 0.04], [51, 50, 50])
    limb = np.repeat([0, 1, 0], [51, 50, 50])
    told = forked(TreeSkeleton.from_columns(parent, tip, radius, limb=limb, order=limb))
    assert len(told) == 4 and np.flatnonzero(told.limb == told.limb[1]).tolist() == [0, 1, lead]
    assert told.order.tolist() == [int(row in (2, 3) and row != lead) for row in range(4)]
