from dataclasses import replace

import numpy as np
import pytest

from sketchtree.errors import OptionError
from sketchtree.foliage.wear import enlargement, wear_of
from sketchtree.parameters import Habit


@pytest.mark.parametrize(("height", "factor"), [(3.0, 1.0), (6.0, 1.0), (12.0, 2**0.35), (60.0, 1.5)])
def test_blades_of_tall_species_are_drawn_larger_within_bounds(height, factor):
    assert np.isclose(enlargement(Habit(height=height)), factor)


def test_needles_and_fronds_keep_their_size():
    spruce = Habit(height=30.0, leaf="spruce", leaf_size=0.018)
    palm = Habit(height=30.0, leaf="palm", leaf_arrangement="frond", leaf_size=0.4)
    assert np.isclose(wear_of(spruce).size * wear_of(spruce).model.needle, 0.018)
    assert wear_of(palm).size == 0.4


def test_a_tuft_stands_for_many_needle_nodes():
    wear = wear_of(Habit(leaf="spruce", leaf_spacing=0.004))
    assert np.isclose(wear.spacing, 0.004 * wear.model.bundle)


def test_the_own_leaf_takes_the_habits_measures_and_another_its_own():
    habit = replace(Habit(), leaf="oak", leaf_arrangement="spiral", leaf_spacing=0.05, phyllotaxis=144.0)
    own, other = wear_of(habit), wear_of(habit, "maple")
    assert (own.arrangement, own.spacing, own.phyllotaxis) == ("spiral", 0.05, 144.0)
    assert (other.arrangement, other.spacing) == ("decussate", other.model.spacing)


def test_density_divides_the_spacing():
    assert np.isclose(wear_of(Habit(), density=2.0).spacing, wear_of(Habit()).spacing / 2)


def test_an_unknown_arrangement_of_a_habit_is_refused():
    with pytest.raises(OptionError, match="There is no leaf arrangement called 'heap'"):
        wear_of(Habit(leaf_arrangement="heap"))


def test_an_arrangement_that_is_asked_for_counts_more_than_the_leafs():
    habit = Habit(leaf="oak", leaf_arrangement="spiral")
    assert wear_of(habit, arrangement="decussate").arrangement == wear_of(habit, "maple", arrangement="decussate").arrangement == "decussate"
    assert wear_of(habit, arrangement="whorled").whorl == habit.whorl


@pytest.mark.parametrize(
    ("leaf", "own", "asked", "said"),
    [("oak", "spiral", "frond", "'frond' can't be asked for"), ("oak", "spiral", "random", "Choose one of: alternate"), ("palm", "frond", "spiral", "Leaves of palm are frond")],
)
def test_an_arrangement_that_no_leaf_or_this_leaf_cannot_have_is_refused(leaf, own, asked, said):
    with pytest.raises(OptionError, match=said):
        wear_of(Habit(leaf=leaf, leaf_arrangement=own), arrangement=asked)
