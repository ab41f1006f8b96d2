"""Choosing, held to all trees of a few lines whose costs depend on which end of the parent is its foot."""

import numpy as np
import pytest
from random_choices import is_tree, least, total, world

from sketchtree.sketch.joining.candidates import Arcs
from sketchtree.sketch.joining.choices import Choices, solve
from sketchtree.sketch.joining.likelihood import slip_costs

SEEDS = pytest.mark.parametrize("seed", range(15))


@pytest.mark.parametrize("count", [1, 2, 3, 4])
@SEEDS
def test_what_is_chosen_is_one_tree_from_the_ground(seed, count):
    choices = world(seed, count)
    assert is_tree(choices, solve(choices, 4))


@SEEDS
def test_where_the_foot_of_the_parent_does_not_matter_the_best_of_all_trees_is_chosen(seed):
    choices = world(seed, 4, spread=0.0)
    assert total(choices, solve(choices, 1)) == pytest.approx(least(choices))


def test_where_it_matters_in_six_worlds_of_seven_the_best_of_all_trees_is_chosen():
    excess = np.array([total(choices, solve(choices, 4)) - least(choices) for choices in (world(seed, 4) for seed in range(40))])
    assert excess.min() > -1e-9
    assert np.mean(excess < 1e-9) >= 0.85 and excess.mean() < 0.25


def test_the_costs_are_those_by_the_feet_given_and_the_grounds_foot_is_its_first():
    choices = world(3, 3)
    cost = choices.cost(np.array([1, 0, 1]))
    foot = np.array([1, 0, 1, 0])[choices.tail]
    assert cost.tolist() == [choices.both[arc, foot[arc]] for arc in range(len(cost))]


def test_after_the_arcs_stands_the_ground_by_either_end_of_every_line():
    arcs = Arcs(*(np.array(c) for c in ([1, 1], [0, 1], [0, 0], [5.0, 6.0], [0.1, 0.2], [0.001, 0.002])), np.array([[1.0, 2.0], [3.0, 4.0]]))
    standing = np.array([[10.0, 11.0], [12.0, 13.0]])
    choices = Choices.of(arcs, 0.01, standing)
    assert choices.tail.tolist() == [0, 0, 2, 2, 2, 2] and choices.head.tolist() == [1, 1, 0, 0, 1, 1] and choices.end.tolist() == [0, 1, 0, 1, 0, 1]
    assert choices.both[:2] == pytest.approx(np.array([[1.0, 2.0], [3.0, 4.0]]) + slip_costs(arcs.miss, 0.01))
    assert choices.both[2:].tolist() == [[c, c] for c in (10.0, 11.0, 12.0, 13.0)]
