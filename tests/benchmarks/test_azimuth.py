"""The measure of bald sides finds one where there is one, at any height."""

import numpy as np
import pytest

from benchmarks.azimuth import empty_azimuth


def crown(arc: float, *, from_height: float = 0.0, from_axis: float = 0.0) -> tuple[np.ndarray, np.ndarray, float]:
    """Wood all round a cylinder 3 m high and 2 m wide, but for an empty arc (degrees) above a height, away from the axis."""
    rng = np.random.default_rng(0)
    turn, height, reach = rng.uniform(0, 2 * np.pi, 20_000), rng.uniform(0, 3, 20_000), np.sqrt(rng.uniform(0, 1, 20_000))
    there = (np.degrees(turn) >= arc) | (height < from_height) | (reach < from_axis)
    return height[there], (reach * [np.cos(turn), np.sin(turn)]).T[there], 1.0


@pytest.mark.parametrize("arc", [30.0, 90.0, 150.0])
def test_an_empty_arc_is_measured(arc):
    assert empty_azimuth(*crown(arc)) == pytest.approx(arc, abs=8)


def test_a_crown_that_is_bald_at_its_top_alone_is_bald():
    assert empty_azimuth(*crown(90.0, from_height=2.0)) == pytest.approx(90.0, abs=8)


def test_twigs_near_the_axis_do_not_hide_a_bald_side():
    assert empty_azimuth(*crown(120.0, from_axis=0.3)) == pytest.approx(120.0, abs=8)


def test_a_fan_is_open_towards_the_viewer():
    height, outward, half = crown(0.0)
    assert empty_azimuth(height, outward * [1.0, 0.1], half) > 120


def test_wood_at_the_axis_alone_is_on_no_side():
    height, outward, half = crown(0.0)
    assert empty_azimuth(height, 0.1 * outward, half) == 360.0
