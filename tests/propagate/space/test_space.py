import numpy as np
import pytest
from tests.propagate.space.solids import wall
from tests.propagate.worlds import HABIT, circle, drawn_tree

from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.space.obstacles import Obstacles
from sketchtree.propagate.space.space import Space

CROWN = Envelope.from_outlines([circle(radius=3.0)])
WALL = Obstacles.build((wall(1.5),), (), Domain.of(drawn_tree(), CROWN, HABIT, 8.0))
START, END = np.zeros((3, 3)) + [0.0, 5.5, 0.0], np.array([[4.0, 5.5, 0], [-4.0, 5.5, 0], [0.5, 5.5, 0]])


def test_without_barriers_and_guides_all_is_free():
    space = Space()
    assert space.inside(END).all() and (space.exit_fraction(START, END) == 1).all() and (space.reach(START, END) == 1).all()
    heading = np.eye(3)
    assert space.turned(START, heading, np.ones(3), np.arange(3)) is heading


def test_the_nearest_of_several_barriers_ends_a_way():
    space = Space((CROWN, WALL), (WALL,))
    fraction = space.exit_fraction(START, END)
    assert fraction[0] == WALL.exit_fraction(START, END)[0] < CROWN.exit_fraction(START, END)[0]
    assert fraction[1] == CROWN.exit_fraction(START, END)[1] and fraction[2] == 1
    np.testing.assert_array_equal(space.inside(END), CROWN.inside(END) & WALL.inside(END))


def test_half_of_what_lies_beyond_a_barrier_that_turns_is_planned_too():
    """Share planned: f + (1 − f) / 2 where the barrier is a guide, f where it is not."""
    free = WALL.exit_fraction(START, END)[0]
    assert Space((WALL,), (WALL,)).reach(START, END)[0] == pytest.approx(free + 0.5 * (1 - free))
    assert Space((WALL,)).reach(START, END)[0] == free
    assert Space((CROWN,), (WALL,)).reach(START, END)[1] == CROWN.exit_fraction(START, END)[1]


def test_from_inside_a_barrier_nothing_is_planned():
    start = np.array([[1.5, 5.5, 0.0]])
    assert Space((WALL,), (WALL,)).reach(start, start + [0.0, 2.0, 0.0])[0] == 0
