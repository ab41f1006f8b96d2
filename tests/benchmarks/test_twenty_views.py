"""Known trees and twenty pictures: what the models are, what a row holds, when a bar is met."""

import numpy as np
import pytest

from benchmarks.twenty_views.models import DIGITISED, NAMES, model
from benchmarks.twenty_views.scored import scored
from benchmarks.twenty_views.told import table


@pytest.fixture(scope="module")
def apple():
    return model("apple_cl1")


def rows(traced: float, grown: float, plain: tuple[float, float], seed: float) -> dict:
    figures = {"traced": traced, "grown": grown, "plain 5 l": plain[0], "plain 10 l": plain[1], "another seed": seed}
    return {way: {"S_T": value, "mean": value - 0.1} for way, value in figures.items()}


def test_there_are_ten_models_of_which_four_were_digitised():
    assert len(NAMES) == 10 and len(DIGITISED) == 4


def test_a_model_stands_under_the_middle_of_its_surface_and_its_kin_are_as_high(apple):
    place = np.asarray(apple.mesh.position, float)
    assert place.min(axis=0) + place.max(axis=0) == pytest.approx([0, np.ptp(place[:, 1]), 0], abs=1e-5)
    assert [other.height for other in apple.others] == pytest.approx([apple.tree.height] * 2)


def test_a_model_is_quite_like_itself_and_its_kin_less(apple):
    itself, other = scored(apple, apple.tree), scored(apple, apple.others[0], placed=False)
    assert itself["S_T"] == pytest.approx(1.0) and itself["recall"] == 1.0
    assert other["S_T"] < 0.95 and "recall" not in other


def test_the_better_of_two_plain_ways_is_what_ours_must_beat():
    told = table({"one": rows(0.86, 0.82, (0.70, 0.80), 0.85), "two": rows(0.80, 0.90, (0.76, 0.70), 0.70)})
    assert told[2] == "| one | 0.860 | 0.820 | 0.800 | 0.850 | 0.750 |"
    assert told[4] == "| mean | 0.830 | 0.860 | 0.780 | 0.775 | 0.675 |"
    assert "traced: above plain by 0.05 on 1 of 2, above the best of other seeds on 2, above their mean on 2" in told
    assert "grown: above plain by 0.05 on 1 of 2, above the best of other seeds on 1, above their mean on 2" in told


def test_a_model_whose_rows_are_not_complete_does_not_count():
    half = rows(0.9, 0.9, (0.5, 0.5), 0.5)
    del half["grown"]
    assert "traced: above plain by 0.05 on 0 of 0, above the best of other seeds on 0, above their mean on 0" in table({"one": half})
