"""Eq. 5: when does each piece of wood grow?"""

import numpy as np
import pytest
from growth_trees import crown, trunk_and_branch

from sketchtree.growth.age import FASTEST, MOST_WOOD, PICTURE, TAIL, WHOLE, growth_age, timeline
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import child_count

TREES = {"two limbs": trunk_and_branch, "a crown": crown}


def test_eq5_age_is_one_over_the_way_from_the_root_plus_the_weighted_radius_in_pixels():
    tree, pixels = trunk_and_branch(), PICTURE / 3
    way = np.array([1, 2, 3, 2, 3]) * pixels
    assert growth_age(tree, 0.001)[1:] == pytest.approx(1 / way + 0.001 * tree.radius[1:] * pixels)


def test_the_root_is_infinitely_old():
    assert np.isinf(growth_age(trunk_and_branch())[0])


def test_age_is_the_same_whatever_the_unit_of_length():
    tree = trunk_and_branch()
    inches = tree.replace(tip=tree.tip * 39.37, radius=tree.radius * 39.37)
    assert growth_age(inches) == pytest.approx(growth_age(tree))


@pytest.mark.parametrize("make", TREES.values(), ids=TREES)
def test_age_falls_along_every_way_from_the_root(make):
    tree = make()
    age, rows = growth_age(tree), ~tree.is_base
    assert (age[rows] <= age[tree.parent[rows]]).all()


def test_wood_that_swells_towards_its_tip_is_no_older_than_what_bears_it():
    tree = trunk_and_branch(limb=[0, 0, 0, 0, 1, 1]).replace(radius=np.array([0.1, 0.02, 0.02, 0.02, 0.02, 0.9]))
    age = growth_age(tree, 0.1)
    assert age[5] == age[4]
    times = timeline(tree, 0.1)
    assert (times.begin[1:] >= times.end[tree.parent[1:]]).all()


@pytest.mark.parametrize("make", TREES.values(), ids=TREES)
def test_no_piece_begins_before_its_parent_ends(make):
    tree = make()
    times, rows = timeline(tree), ~tree.is_base
    assert (times.begin[rows] >= times.end[tree.parent[rows]]).all()
    assert (times.end >= times.begin).all()
    assert times.begin.min() == 0 and times.end.max() == WHOLE


def test_thin_wood_grows_later_than_thick_wood_as_far_from_the_root():
    tree = trunk_and_branch()
    times = timeline(tree)
    assert times.end[4] > times.end[2]


def test_thin_wood_without_branches_grows_at_one_speed():
    tree = TreeSkeleton.from_columns([-1, 0, 1, 2], np.array([[0, 0, 0], [0, 1, 0], [0, 3, 0], [0, 4, 0]], float), np.full(4, 1e-9))
    assert timeline(tree).end == pytest.approx(WHOLE * np.array([0, 0.25, 0.75, 1]))


def test_nothing_grows_faster_than_the_bound():
    tree = crown()
    times, scale = timeline(tree), PICTURE / np.ptp(tree.tip, axis=0).max()
    span = times.end - times.begin
    way = (tree.length * scale)[~tree.is_base] / span[~tree.is_base]
    longest = 1.0 / growth_age(tree)[~tree.is_base].min()
    assert way.max() <= 1.01 * FASTEST * longest / WHOLE * 1.5


def test_eq5_size_at_each_branching_node_goes_with_one_over_its_age_and_ends_at_one():
    tree = crown()
    times, age = timeline(tree), growth_age(tree)
    forks = np.flatnonzero((child_count(tree.parent) > 1) & ~tree.is_base)
    clock = times.end[forks] * age[forks]
    free = forks[np.isclose(clock, np.median(clock))]  # those that neither wait for what bears them nor for the fastest growth
    assert len(free) > 0.5 * len(forks)
    size = times.size(times.end[free])
    assert size * age[free] == pytest.approx(np.full(len(free), size[0] * age[free[0]]))
    assert (size > 0).all() and times.size(times.end[forks]).max() == 1


def test_a_few_late_twigs_make_nobody_wait():
    tree = crown(3)
    late = tree.append({"parent": [len(tree) - 1], "tip": [tree.tip[-1] + [0, 0.3 * tree.height, 0]], "radius": [1e-5], "limb": [7], "order": [9]})
    with_late, without = timeline(late, bud_rest=0.3), timeline(tree, bud_rest=0.3)
    others = np.quantile(with_late.end[:-1], 0.9)
    assert with_late.end[-1] == WHOLE
    assert np.quantile(without.end, 0.9) > others > 0.6 * np.quantile(without.end, 0.9)
    wood = np.cumsum(tree.length[np.argsort(without.end)])
    assert np.sort(without.end)[np.searchsorted(wood, MOST_WOOD * wood[-1])] >= (1 - TAIL) * WHOLE - 1e-12


def test_later_branching_orders_rest_longer_where_order_counts():
    tree = trunk_and_branch()
    plain, resting = timeline(tree), timeline(tree, bud_rest=0.3)
    assert resting.begin[4] / resting.end[3] > plain.begin[4] / plain.end[3]


def test_a_tree_without_wood_has_no_times():
    times = timeline(TreeSkeleton.from_columns([-1], np.zeros((1, 3)), [0.1]))
    assert times.begin.tolist() == times.end.tolist() == [0.0]
