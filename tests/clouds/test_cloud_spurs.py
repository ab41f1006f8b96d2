"""Points that lie off the wood are no limbs."""

import numpy as np
import pytest
from scanned import bark, feet

from sketchtree.axes import NULL
from sketchtree.clouds.tracing.joined import joined
from sketchtree.clouds.tracing.layers import layers
from sketchtree.clouds.tracing.limbs import limbs_of
from sketchtree.clouds.tracing.spurs import LEAP, SCATTER, SPACED, USUAL, spurs
from sketchtree.clouds.tracing.traced import traced
from sketchtree.clouds.tracing.ways import ways
from sketchtree.traverse import is_tip

SPACING, THICK, NOISE = 0.1, 0.05, 0.02


def found(parent, centre):
    """What every node is part of, where the wood is 5 cm thick, seen to 2 cm, by points 10 cm apart."""
    parent, centre = np.array(parent), np.array(centre, float)
    every = np.ones(len(parent))
    return spurs(parent, centre, centre, limbs_of(parent, centre), THICK * every, SPACING * every, NOISE)


def stem(more):
    """Forty nodes upwards, and others, the first of which is number 40."""
    return [NULL, *range(39), *(above for above, _ in more)], [[0, 0.1 * k, 0] for k in range(40)] + [place for _, place in more]


@pytest.mark.parametrize(("out", "stays"), [(max(SCATTER * NOISE, SPACED * SPACING) - 0.005, False), (max(SCATTER * NOISE, SPACED * SPACING) + 0.005, True)])
def test_a_point_that_lies_no_farther_off_bark_than_points_scatter_is_part_of_that_wood(out, stays):
    part_of = found(*stem([(4, [THICK + out, 0.5, 0])]))
    assert part_of[40] == (40 if stays else 5)  # of the nearest node, wherever it hung
    assert (part_of[:40] == np.arange(40)).all()


def test_what_bears_a_limb_is_one_too_however_short():
    part_of = found(*stem([(4, [0.06, 0.4, 0]), (40, [0.25, 0.45, 0.0]), (40, [0.06, 0.3, 0.3])]))
    assert part_of[40:].tolist() == [40, 41, 42]


def test_and_what_bears_a_spur_only_is_none():
    part_of = found(*stem([(4, [0.08, 0.4, 0]), (40, [0.1, 0.4, 0.0]), (40, [0.1, 0.42, 0.02])]))
    assert (part_of[part_of[40:]] < 40).all()


def test_points_beyond_a_leap_that_is_longer_than_all_it_leads_to_are_of_no_limb():
    leap = LEAP * SPACING + 0.05
    part_of = found(*stem([(4, [leap, 0.4, 0]), (40, [leap + 0.2, 0.4, 0])]))
    assert part_of[40:].tolist() == [NULL, NULL]


def test_nor_are_those_beyond_a_leap_far_out_on_a_limb():
    near = [(4, [0.1, 0.4, 0]), (40, [0.2, 0.4, 0]), (41, [0.3, 0.4, 0])]
    assert found(*stem([*near, (42, [0.8, 0.4, 0])]))[40:].tolist() == [40, 41, 42, NULL]


def test_a_gap_in_a_limb_that_goes_on_is_none():
    along = np.arange(10)
    far = [(4 if k == 0 else 39 + k, [0.5 + 0.1 * k, 0.4, 0]) for k in along]
    assert (found(*stem(far)) == np.arange(50)).all()


def test_where_points_are_sparse_a_leap_is_told_by_the_trees_own_spacing():
    parent, centre = (np.array(column) for column in stem([(4, [LEAP * USUAL * SPACING + 0.05, 0.4, 0])]))
    spacing = np.where(np.arange(41) == 4, 10 * SPACING, SPACING)
    every = np.ones(41)
    part_of = spurs(parent, centre.astype(float), centre.astype(float), limbs_of(parent, centre), THICK * every, spacing, NOISE)
    assert part_of[40] == NULL


def test_twigs_that_run_side_by_side_are_not_one_node():
    one = np.stack([0.01 * np.arange(60), np.zeros(60), np.zeros(60)], axis=1)
    fork = np.concatenate([one, one[30:] * [1, 0, 1] + [[0, 0.015 + 0.001 * k, 0] for k in range(30)]])
    graph = joined(fork, reach=10.0)
    way, width = ways(fork, graph, [np.array([0])]), np.full(len(fork), 0.008)
    blurred, clear = layers(fork, graph, way, width), layers(fork, graph, way, width, apart=np.full(len(fork), 0.012))
    assert np.bincount(clear.of_point).max() < np.bincount(blurred.of_point).max()
    side = fork[:, 1] > 0
    assert not set(clear.of_point[side & (fork[:, 0] > 0.35)]) & set(clear.of_point[~side])


def test_a_tree_whose_points_scatter_has_few_limbs_more():
    points = bark(0.02, noise=0.01)
    tree = traced(points, feet(points)).skeleton
    assert (is_tip(tree.parent) & ~tree.is_base).sum() < 8  # it has three
