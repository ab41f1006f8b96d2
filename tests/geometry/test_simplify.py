import numpy as np
import pytest

from sketchtree.geometry.simplify import enough


def line(seed=0, count=200, lines=3):
    rng = np.random.default_rng(seed)
    point = np.cumsum(rng.normal(0, 1, (lines, count, 4)), axis=1).reshape(-1, 4)
    step = np.linalg.norm(np.diff(point, axis=0, prepend=point[:1]), axis=1).reshape(lines, count)
    step[:, 0] = 0
    ends = np.zeros((lines, count), bool)
    ends[:, [0, -1]] = True
    return point, np.cumsum(step, axis=1).ravel(), ends.ravel()


def farthest(point, kept):
    stand = np.flatnonzero(kept)
    worst = 0.0
    for a, b in zip(stand[:-1], stand[1:], strict=True):
        chord = point[b] - point[a]
        for x in point[a + 1 : b]:
            share = np.clip(np.dot(x - point[a], chord) / np.dot(chord, chord), 0, 1)
            worst = max(worst, np.linalg.norm(x - point[a] - share * chord))
    return worst


@pytest.mark.parametrize("tolerance", [0.5, 2.0, 8.0])
def test_every_point_left_out_is_within_the_tolerance(tolerance):
    point, s, ends = line()
    kept = enough(point, s, ends, np.zeros(len(s)), tolerance)
    assert farthest(point, kept) <= tolerance
    assert kept[ends].all()


def test_a_larger_tolerance_keeps_fewer():
    point, s, ends = line(1)
    counts = [enough(point, s, ends, np.zeros(len(s)), tolerance).sum() for tolerance in (0.1, 1.0, 5.0, 1e3)]
    assert (np.diff(counts) < 0).all() and counts[-1] == ends.sum()


def test_a_straight_line_keeps_its_ends_only():
    point = np.linspace(0, 1, 50)[:, None] * [1.0, 2.0, 3.0]
    ends = np.r_[True, np.zeros(48, bool), True]
    assert enough(point, np.linspace(0, 3.7, 50), ends, np.zeros(50), 1e-9).sum() == 2


def test_no_point_is_added_within_its_margin_of_a_neighbour():
    point, s, ends = line(2)
    kept = enough(point, s, ends, np.full(len(s), 5.0), 0.1)
    gap = np.diff(s[kept])
    assert gap[gap > 0].min() >= 5.0


def test_no_line_passes():
    assert len(enough(np.zeros((0, 4)), np.zeros(0), np.zeros(0, bool), np.zeros(0), 1.0)) == 0
