"""Boughs that run through one another part, and foliage that is left bare then is grown to again."""

from dataclasses import replace

import numpy as np
import pytest
from tests.propagate.attractors.attractor_worlds import KEY, QUICK, TARGET, tree

from sketchtree.parameters import Habit
from sketchtree.propagate.after.cutting import cut
from sketchtree.propagate.after.untangle import Untangle, Untangled
from sketchtree.propagate.attractors import regrown
from sketchtree.propagate.attractors.regrown import LITTLE, grown_free
from sketchtree.propagate.attractors.stage import Attract

STAGE = Attract(targets=TARGET, **QUICK)
HABIT = Habit()


def free(stage=STAGE):
    given = tree()
    return grown_free(stage, given, given.radius, HABIT, HABIT, key=KEY)


def half_cut(self, whole, pulse=lambda: None):
    """As if all that grew on the left had to give way."""
    share = np.where((whole.tip[:, 0] < 0) & (whole.stroke < 0), 0.0, 1.0)
    left = cut(whole, share)
    return Untangled(left.skeleton, left.rows, np.zeros(0))


@pytest.fixture
def parted(monkeypatch):
    monkeypatch.setattr(Untangle, "run", half_cut)
    return free()


def test_a_tree_that_hardly_tangles_stays_as_it_grew():
    first, kept = STAGE.run(tree(), key=KEY), free()
    np.testing.assert_array_equal(kept.skeleton.tip, first.skeleton.tip)
    np.testing.assert_array_equal(kept.skeleton.limb, first.skeleton.limb)


def test_what_was_cut_off_is_grown_again(parted):
    left = parted.skeleton.tip[:, 0] < -0.5
    assert left.sum() > 20
    assert regrown._bare(next(iter(parted.grown.values())), parted.skeleton) <= LITTLE + 0.05


def test_limbs_of_both_growths_have_ids_of_their_own(parted):
    skeleton = parted.skeleton
    first = np.flatnonzero(~skeleton.is_base & (skeleton.limb != skeleton.limb[skeleton.parent]))
    assert len(np.unique(skeleton.limb[first])) == len(first), "every limb begins once"


def test_what_was_given_is_where_it_was_and_known(parted):
    given = tree()
    np.testing.assert_array_equal(parted.skeleton.tip[parted.drawn_row], given.tip)
    np.testing.assert_array_equal(parted.skeleton.limb[parted.drawn_row], given.limb)
    assert (parted.generation[parted.drawn_row] == 0).all() and len(parted.generation) == len(parted.skeleton)
    assert parted.generations_done == parted.generation.max() > STAGE.run(given, key=KEY).generation.max() - 1


def test_its_course_goes_on_where_the_first_ended(parted):
    course = next(iter(parted.grown.values())).course
    assert len(course.driver) == len(course.image) == len(course.space) == len(course.in_space) == len(course.segments)
    assert (np.diff(course.segments) >= 0).all()


def test_without_twigs_nothing_grows_again(monkeypatch):
    monkeypatch.setattr(Untangle, "run", half_cut)
    bare = replace(STAGE, twigs=False)
    np.testing.assert_array_equal(free(bare).skeleton.tip, bare.run(tree(), key=KEY).skeleton.tip)


def test_the_same_key_grows_the_same(parted):
    np.testing.assert_array_equal(parted.skeleton.tip, free().skeleton.tip)
