"""The two edges of a limb that a line was drawn along."""

import numpy as np
import pytest

from sketchtree.matting.flanks import between, flanks
from sketchtree.matting.reach import marked

LINE = np.array([[60.0, 10.0], [60.0, 190.0]])
SAME = np.full((200, 120), 0.5)  # nothing is told by colour


def trunk(*, unseen=(0, 0)) -> np.ndarray:
    """Pixels of a trunk 16 across, as grey as what is behind it, with light edges but for some rows; a lighter patch beside it."""
    rgb = np.full((200, 120, 3), 0.3) + np.random.default_rng(0).normal(0, 0.004, (200, 120, 1))
    rgb[:, :52] += 0.25
    rgb[:, 68:] += 0.25
    rgb[unseen[0] : unseen[1], :] = 0.3
    return rgb


def test_edges_are_found_on_either_side_of_the_line():
    found = flanks(trunk(), SAME, LINE)
    assert np.abs(found.off - 8.0).max() <= 0.5 and found.seen.min() > 0.9


def test_an_edge_that_is_not_seen_goes_on_from_where_it_is():
    found = flanks(trunk(unseen=(70, 130)), SAME, LINE)
    assert np.abs(found.off - 8.0).max() <= 1.0
    assert found.seen[:, 90].max() < 0.1 and found.seen[:, 10].min() > 0.9


def test_what_is_brighter_for_a_moment_is_no_edge():
    rgb = trunk()
    rgb[50:56, 40:44] = 1.0
    assert np.abs(flanks(rgb, SAME, LINE).off - 8.0).max() <= 0.5


def test_an_edge_within_the_wood_is_none():
    """A trunk lit from the left: beyond the edge of its shade there is wood by its colour too."""
    rgb, wood = trunk(), np.where((np.arange(120) >= 52) & (np.arange(120) < 68), 1.0, 0.0) * np.ones((200, 1))
    rgb[:, 52:62] += 0.12
    assert np.abs(flanks(rgb, wood, LINE).off - 8.0).max() <= 1.0


def test_a_dot_has_no_edges():
    assert flanks(trunk(), SAME, LINE[:1]) is None


def test_what_lies_between_the_edges_is_the_limb_and_beyond_them_is_not():
    window, inside, beyond = between(flanks(trunk(), SAME, LINE), (200, 120))
    whole = np.zeros((2, 200, 120))
    whole[0][window], whole[1][window] = inside, beyond
    assert whole[0][60, [55, 60, 65]].min() > 0.9 and whole[1][60, [50, 70]].min() > 0.9
    assert whole[0][60, [50, 70]].max() == 0.0 and whole[:, 195].max() == 0.0  # nothing is said of what is past the line's ends


def test_what_is_surely_no_wood_shows_through_between_the_edges():
    wood = SAME.copy()
    wood[40:50, 56:62] = 0.0
    inside, _ = marked(trunk(), wood, [LINE])
    assert inside[45, 59] == 0.0 and inside[70, 59] > 0.9


@pytest.mark.parametrize("turn", [0.0, 0.6, 1.2])
def test_limbs_that_lean_are_held_as_well(turn):
    y, x = np.mgrid[:160, :160] + 0.5
    along = np.array([np.sin(turn), -np.cos(turn)])
    off = (x - 80) * along[1] - (y - 80) * along[0]
    rgb = np.where(np.abs(off) < 6.0, 0.2, 0.8)[..., None] * np.ones(3)
    found = flanks(rgb, np.where(np.abs(off) < 6.0, 1.0, 0.0), np.stack([80 - 60 * along, 80 + 60 * along]))
    assert np.abs(found.off - 6.0).max() <= 0.75
