"""§2, Figure 3c: joints that neither fork nor turn by 30° say nothing."""

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.photo.trace.simplify import telling


def chain(*degrees: float) -> tuple[np.ndarray, np.ndarray]:
    """A chain of steps of length 1 that set out at these angles."""
    turn = np.radians(degrees)
    steps = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    return np.arange(-1, len(steps)), np.concatenate([np.zeros((1, 2)), np.cumsum(steps, axis=0)])


@pytest.mark.parametrize(("turn", "stays"), [(0.0, False), (29.0, False), (31.0, True), (90.0, True)])
def test_a_joint_stays_where_the_line_turns_by_thirty_degrees(turn, stays):
    assert telling(*chain(0.0, turn)).tolist() == [True, stays, True]


def test_a_slow_bend_is_cut_where_thirty_degrees_have_come_together():
    assert telling(*chain(0.0, 12.0, 24.0, 36.0, 48.0)).tolist() == [True, False, False, True, False, True]


def test_root_tips_and_forks_stay():
    parent, xy = np.array([NULL, 0, 1, 1, 2]), np.array([(0, 0), (0, 1), (0, 2), (1, 1.5), (0, 3)], float)
    assert telling(parent, xy).tolist() == [True, True, False, True, True]
