"""Measured trees, cut back to two orders and grown again, are more like themselves than by plain replication. The fixed set of six."""

import numpy as np
import pytest

from benchmarks.cases import DATA
from benchmarks.completion import METHODS, figures, mean_of
from benchmarks.completion_metrics import NAMES
from sketchtree.templates.making.regenerate import recipe_folder
from sketchtree.templates.store.database import Database


@pytest.fixture(scope="module")
def mean():
    """Every method's mean figures."""
    shipped = Database(recipe_folder() / "exemplars.h5")
    return mean_of([figures(path, shipped, 0) for path in sorted((DATA / "measured").glob("*.npz"))])


def better(mean, figure, best=min):
    return best(mean[name][figure] for name in METHODS[1:])


def test_every_figure_is_one_for_every_method(mean):
    assert all(np.isfinite(mean[name][figure]) for name in METHODS for figure in NAMES)


def test_undrawn_pieces_are_as_long_as_they_should_be(mean):
    assert mean["ours"]["length"] <= 0.8 * better(mean, "length")


def test_angles_are_as_good_as_copies_of_the_trees_own(mean):
    assert mean["ours"]["angle"] <= 1.15 * better(mean, "angle")
    assert mean["ours"]["angle"] < 10.0


def test_tips_stand_at_the_right_heights(mean):
    assert mean["ours"]["height"] <= 0.9 * better(mean, "height")


def test_the_crown_has_its_silhouette_from_eight_sides(mean):
    assert mean["ours"]["sky"] >= better(mean, "sky", max) + 0.03


def test_no_side_of_the_crown_is_empty(mean):
    assert mean["ours"]["gap"] < 120.0
