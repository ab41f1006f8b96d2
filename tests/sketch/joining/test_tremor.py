import numpy as np
import pytest
from little_lines import line

from sketchtree.sketch.joining.tremor import REACH, STILL, without_tremor
from sketchtree.sketch.joining.lines import turning

H = 100.0


def zigzag(size, pitch=0.5, length=60.0):
    """A level line that jumps up and down by `size` every `pitch`."""
    x = np.arange(0, length, pitch)
    return line(np.stack([x, size * (-1.0) ** np.arange(len(x))], 1))


def test_a_trembling_line_becomes_the_line_that_was_meant():
    shaky = zigzag(0.3)
    still = without_tremor(shaky, H)
    middle = (still.along > REACH * H) & (still.along < still.length - REACH * H)
    assert np.abs(still.points[middle, 1]).max() < 0.05
    assert still.length < 0.75 * shaky.length


def test_ends_stay_where_they_were_drawn():
    shaky = zigzag(0.3)
    assert without_tremor(shaky, H).points[[0, -1]] == pytest.approx(shaky.points[[0, -1]])


@pytest.mark.parametrize("waves", [1, 3])
def test_a_bending_branch_is_left_alone(waves):
    x = np.linspace(0, 60, 80)
    bent = line(np.stack([x, 6 * np.sin(2 * np.pi * waves * x / 60)], 1))
    assert without_tremor(bent, H) is bent


def test_a_corner_is_left_alone():
    corner = line([(0, 0), (10, 0), (20, 0), (20, 10), (20, 20)])
    assert without_tremor(corner, H) is corner


def test_too_few_points_tremble_not():
    short = line([(0, 0), (1, 5), (2, -5), (3, 0)])
    assert without_tremor(short, H) is short


@pytest.mark.parametrize("scale", [1e-3, 1e3])
def test_scale_does_not_matter(scale):
    shaky = zigzag(0.3)
    other = without_tremor(line(shaky.points * scale), H * scale)
    assert other.points / scale == pytest.approx(without_tremor(shaky, H).points, abs=1e-6)


def test_a_line_that_turns_less_than_still_is_never_shortened_so_much():
    rng = np.random.default_rng(3)
    for _ in range(40):
        turn = np.cumsum(rng.normal(0, 0.12, 12))
        walk = line(np.vstack([np.zeros(2), np.cumsum(np.stack([np.cos(turn), np.sin(turn)], 1), axis=0)]))
        if turning([walk])[0] <= STILL:
            assert without_tremor(walk, H) is walk
