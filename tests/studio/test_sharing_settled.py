"""Depths that are no others stay the objects that they were."""

import dataclasses

import numpy as np
import pytest

from sketchtree.editing.settled import COURSE, Depths, Settled
from sketchtree.studio.settling import same, sharing


def depths(**fields) -> Depths:
    whole = {"share": np.array([0.0, 1]), "depth": np.array([0.0, 2]), "sd": np.array([0.1, np.nan]), "course": np.zeros((COURSE, 2)), "parent": None, "strokes": ("a",)}
    return Depths(**(whole | fields))


def test_equal_depths_are_the_same_object_afterwards():
    old = Settled({1: depths(), 2: depths(parent=1)}, "oak")
    new = Settled({1: depths(), 2: depths(parent=1, depth=np.array([0.0, 3]))}, "oak")
    shared = sharing(new, old)
    assert shared.limbs[1] is old.limbs[1] and shared.limbs[2] is new.limbs[2]


def test_where_nothing_is_different_all_of_it_is_the_old_one():
    old = Settled({1: depths()}, "oak")
    assert sharing(Settled({1: depths()}, "oak"), old) is old
    for other in (Settled({1: depths()}, "birch"), Settled({}, "oak"), Settled({1: depths(), 2: depths()}, "oak")):
        assert sharing(other, old) is not old


@pytest.mark.parametrize("fields", [{"depth": np.array([0.0, 2.5])}, {"sd": np.array([0.1, 0.2])}, {"parent": 3}, {"strokes": ("b",)}, {"view_deg": 90.0}, {"share": np.array([0.0, 0.5, 1])}])
def test_any_field_tells_them_apart(fields):
    assert same(depths(), depths()) and not same(depths(), dataclasses.replace(depths(), **fields))
