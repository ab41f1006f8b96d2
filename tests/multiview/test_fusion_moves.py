"""A fusion move is the best of all mixtures, or leaves things as they are; Eq. 4 falls from move to move."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sketchtree.multiview.moves import energy, fused, truncated

PAIRS = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]])


def problem(seed, submodular):
    chance = np.random.default_rng(seed)
    unary = chance.uniform(0, 1, (4, 2))
    cost = chance.uniform(0, 0.6, (5, 2, 2))
    if submodular:
        cost[:, 0, 0] = cost[:, 1, 1] = 0.0
    return unary, cost


def best(unary, cost):
    return min(energy(unary, PAIRS, cost, np.array(takes)) for takes in itertools.product([False, True], repeat=4))


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000))
def test_the_best_mixture_is_found_where_a_cut_can_tell(seed):
    unary, cost = problem(seed, submodular=True)
    takes, fall = fused(unary, PAIRS, cost)
    assert energy(unary, PAIRS, cost, takes) == pytest.approx(best(unary, cost), abs=0.01)
    assert fall == pytest.approx(energy(unary, PAIRS, cost, np.zeros(4, bool)) - energy(unary, PAIRS, cost, takes))


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000))
def test_elsewhere_the_energy_never_rises(seed):
    unary, cost = problem(seed, submodular=False)
    takes, fall = fused(unary, PAIRS, cost)
    assert fall >= 0 and energy(unary, PAIRS, cost, takes) <= energy(unary, PAIRS, cost, np.zeros(4, bool)) + 1e-12


def test_one_alone_takes_what_costs_less():
    none = np.zeros((0, 2), int)
    takes, fall = fused(np.array([[0.2, 0.1], [0.1, 0.2]]), none, np.zeros((0, 2, 2)))
    np.testing.assert_array_equal(takes, [True, False])
    assert fall == pytest.approx(0.1)


def test_neighbours_pull_one_over():
    apart = truncated(np.array([[0.0, 3.0], [3.0, 0.0]]), 2.0)
    takes, _ = fused(np.array([[0.0, 0.1], [0.5, 0.0]]), np.array([[0, 1]]), apart[None])
    np.testing.assert_array_equal(takes, [True, True])


def test_a_jump_costs_no_more_than_tau():
    np.testing.assert_array_equal(truncated(np.array([-0.5, 7.0]), 2.0), [0.5, 2.0])
