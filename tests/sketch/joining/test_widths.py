import numpy as np
import pytest

from sketchtree.sketch.joining.widths import LIGHTEST, VARIES, drawn_widths
from sketchtree.sketch.strokes import Stroke


def stroke(name, width=None, pressure=None):
    return Stroke(name, [(0, 0), (0, 5), (0, 10)], width=width, pressure=None if pressure is None else np.array(pressure))


def silent(widths):
    return all(np.isnan(np.asarray(width)).all() for width in widths)


@pytest.mark.parametrize("widths", [(2.0, 2.0), (2.0, 2.0 * VARIES * 0.99), (None, None), (4.0, None)])
def test_a_pen_that_draws_alike_says_nothing(widths):
    assert silent(drawn_widths([stroke("a", widths[0]), stroke("b", widths[1])]))


def test_widths_that_differ_are_believed():
    a, b = drawn_widths([stroke("a", 6.0), stroke("b", 2.0)])
    assert np.asarray(a).tolist() == [6.0] * 3 and np.asarray(b).tolist() == [2.0] * 3


def test_pressure_is_a_part_of_the_pens_width():
    (a,) = drawn_widths([stroke("a", 8.0, [1.0, 0.5, 0.25])])
    assert a.tolist() == [8.0, 4.0, 2.0]


def test_a_pen_without_a_width_is_one_wide():
    (a,) = drawn_widths([stroke("a", None, [1.0, 0.5, 0.25])])
    assert a.tolist() == [1.0, 0.5, 0.25]


def test_a_stroke_without_pressure_beside_pressed_ones_is_as_wide_as_the_pen():
    a, b = drawn_widths([stroke("a", 4.0, [1.0, 0.5, 0.25]), stroke("b")])
    assert a.tolist() == [4.0, 2.0, 1.0] and b.tolist() == [4.0] * 3


def test_no_pressure_still_leaves_a_line():
    (a,) = drawn_widths([stroke("a", 10.0, [1.0, 0.5, 0.0])])
    assert a[-1] == pytest.approx(10.0 * LIGHTEST)


def test_pressure_that_never_changes_says_nothing():
    assert silent(drawn_widths([stroke("a", 4.0, [0.5, 0.5, 0.52])]))
