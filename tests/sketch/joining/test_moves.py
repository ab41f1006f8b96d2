"""Moves, held to all trees of four lines whose costs depend on which end of the parent is its foot."""

import numpy as np
import pytest
from random_choices import every_tree, is_tree, random_tree, total, world

from sketchtree.sketch.joining.moves import improved

SEEDS = pytest.mark.parametrize("seed", range(12))
MANY = 100


def moved(choices, chosen, moves=MANY):
    return improved(choices.tail, choices.head, choices.end, choices.both, chosen, moves)


def neighbours(choices, chosen):
    """Every tree that differs in one arc."""
    for arc in range(len(choices.tail)):
        other = chosen.copy()
        other[choices.head[arc]] = arc
        if is_tree(choices, other):
            yield other


@SEEDS
def test_no_start_is_made_worse_and_no_circle_is_made(seed):
    choices = world(seed, 4)
    rng = np.random.default_rng(seed)
    for _ in range(20):
        start = random_tree(choices, rng)
        end = moved(choices, start)
        assert is_tree(choices, end)
        assert total(choices, end) <= total(choices, start) + 1e-9


@SEEDS
def test_where_moves_end_no_other_move_helps(seed):
    choices = world(seed, 4)
    end = moved(choices, random_tree(choices, np.random.default_rng(seed)))
    assert min(total(choices, other) for other in neighbours(choices, end)) >= total(choices, end) - 1e-9


@SEEDS
def test_the_first_move_is_the_one_that_gains_most(seed):
    choices = world(seed, 4)
    start = random_tree(choices, np.random.default_rng(seed))
    best = min(total(choices, other) for other in neighbours(choices, start))
    assert total(choices, moved(choices, start, 1)) == pytest.approx(best)


@SEEDS
def test_the_best_of_all_trees_is_left_alone(seed):
    choices = world(seed, 4)
    best = np.array(min(every_tree(choices), key=lambda arcs: total(choices, arcs)))
    assert moved(choices, best).tolist() == best.tolist()


def test_no_moves_change_nothing():
    choices = world(0, 4)
    start = random_tree(choices, np.random.default_rng(0))
    assert moved(choices, start, 0).tolist() == start.tolist()


def test_a_line_is_turned_for_its_childrens_sake():
    tail, head, end = np.array([[2, 0, 0], [2, 0, 1], [0, 1, 0]]).T  # line 0 on the ground by either end, line 1 on line 0
    both = np.array([[1.0, 1.0], [3.0, 3.0], [9.0, 2.0]])  # line 0 by its other end costs 2 more, and saves line 1 seven
    assert improved(tail, head, end, both, np.array([0, 2]), MANY).tolist() == [1, 2]
    both[2, 1] = 8.0  # … or one, which is not worth it
    assert improved(tail, head, end, both, np.array([0, 2]), MANY).tolist() == [0, 2]


def test_a_start_is_not_written_to():
    choices = world(1, 4)
    start = random_tree(choices, np.random.default_rng(1))
    before = start.copy()
    moved(choices, start)
    assert start.tolist() == before.tolist()
