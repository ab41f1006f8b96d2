import pytest
from tests.propagate.worlds import HABIT, THETA

from sketchtree.errors import OptionError
from sketchtree.propagate.wanted import CROWN_GENERATIONS, GENERATIONS, Wanted


@pytest.mark.parametrize(
    "choice, said",
    [
        ({"density": 0.0}, "density is 0, but must lie between 0.01 and 10. 1 is the species' own; 2 has twice as many twigs on every limb."),
        ({"density": float("nan")}, "density is nan, but must lie between 0.01 and 10. "),
        ({"thorough": 1.5}, "thorough is 1.5, but must lie between 0 and 1. 1: every limb of the drawn orders is drawn; None: judge by the drawing."),
        ({"thorough": float("nan")}, "thorough is nan, but must lie between 0 and 1. "),
        ({"generations": 51}, "generations is 51, but must lie between 0 and 50. 5 to 12 make a full tree."),
        ({"max_segments": 0}, "max_segments is 0, but must be 1 or more. Give a positive number."),
    ],
)
def test_a_choice_out_of_range_is_named_with_the_way_out(choice, said):
    with pytest.raises(OptionError) as error:
        Wanted(HABIT, THETA, **choice)
    assert str(error.value).startswith(said)


def test_the_limit_of_generations_follows_the_crown_and_a_fraction_begins_the_next():
    assert Wanted(HABIT, THETA).limit == GENERATIONS
    assert Wanted(HABIT, THETA, crown=([[0, 0], [1, 0], [0, 1]],)).limit == CROWN_GENERATIONS
    assert Wanted(HABIT, THETA, generations=3.5).limit == 4
