"""A circle about a place: clusters of wood on it, and which of them can be seen over wood."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from sketchtree.photo.appearance import Mixture
from sketchtree.photo.trace.circle import clusters_on, runs
from sketchtree.photo.trace.thickness import half_widths, largest_circle
from sketchtree.photo.trace.wood_likeness import WoodLikeness

ANY = Mixture(np.array([1.0]), np.zeros((1, 3)), np.eye(3)[None])


def likeness_of(mask) -> WoodLikeness:
    return WoodLikeness(ANY, ANY, np.where(mask, 1.0, -1.0), mask)


def cross(gap: bool = False) -> WoodLikeness:
    mask = np.zeros((101, 101), bool)
    mask[46:55, :] = True
    mask[:, 48:53] = True
    if gap:
        mask[:, 62:66] = False
    return likeness_of(mask)


def test_each_arm_of_a_cross_is_a_cluster():
    found = clusters_on(cross(), np.array([50.5, 50.5]), 30.0, strict=True)
    assert len(found.width) == 4 and found.seen.all()
    np.testing.assert_allclose(sorted(found.width), [5, 5, 9, 9], atol=1.5)
    np.testing.assert_allclose(np.hypot(*(found.centre - 50.5).T), 30.0)


def test_a_cluster_behind_what_is_no_wood_is_not_seen():
    """§2: "we discard a cluster if there are non-branch pixels along the line segment connecting the cluster center and circle center"."""
    found = clusters_on(cross(gap=True), np.array([50.5, 50.5]), 30.0, strict=True)
    right = np.argmax(found.centre[:, 0])
    assert not found.seen[right] and found.seen.sum() == 3


def test_a_small_gap_is_seen_over_unless_strict():
    assert clusters_on(cross(gap=True), np.array([50.5, 50.5]), 30.0, strict=False).seen.all()


def test_a_circle_of_nothing_but_wood_shows_no_branch():
    assert len(clusters_on(likeness_of(np.ones((50, 50), bool)), np.array([25.0, 25.0]), 10.0, strict=True).width) == 0


@given(st.lists(st.booleans(), min_size=3, max_size=40), st.integers(0, 39))
def test_runs_round_a_circle_do_not_depend_on_where_it_is_cut(wood, turn):
    wood = np.array(wood)
    cut = np.roll(wood, turn)
    lengths = [sorted((stop - start).tolist()) for start, stop in (runs(wood), runs(cut))]
    assert lengths[0] == lengths[1]
    assert sum(lengths[0]) == (0 if wood.all() else wood.sum())


def test_the_largest_circle_in_a_bar_is_half_as_wide_as_the_bar():
    mask = np.zeros((120, 120), bool)
    mask[:, 50:71] = True
    assert abs(largest_circle(likeness_of(mask), np.array([58.0, 60.0]), 30.0) - 10.5) <= 1.0


def test_widths_are_measured_across_the_line_and_unknown_off_the_wood():
    mask = np.zeros((120, 120), bool)
    mask[:, 50:62] = True
    place, along = np.array([(56.0, 60.0), (10.0, 60.0)]), np.array([(0.0, -1.0), (0.0, -1.0)])
    found = half_widths(likeness_of(mask), place, along, 20.0)
    assert abs(found[0] - 6) <= 0.75 and np.isnan(found[1])
