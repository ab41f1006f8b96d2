from dataclasses import replace

import numpy as np
import pytest
import shapely
from little_lines import lines

from sketchtree.sketch.joining.aims import FAR, LOOK, NEAR, aims
from sketchtree.sketch.joining.bundle import Bundle

TRUNK = [(0, 0), (0, 100)]  # H is 100
PIECES = pytest.mark.parametrize("piece", [NEAR, FAR])


def aim(*strokes, end=0, parent=1, piece=NEAR):
    """How far ahead of an end of line 0 a line is met."""
    bundle = Bundle.of(lines(*strokes))
    gap = np.array([bundle.shapes[parent].distance(shapely.Point(bundle.ends[end]))])
    return float(aims(bundle, np.array([end]), np.array([parent]), gap, piece)[0])


@PIECES
def test_a_stroke_that_stops_short_points_at_its_parent(piece):
    assert aim([(2, 50), (30, 50)], TRUNK, piece=piece) == pytest.approx(0.02)


@PIECES
def test_a_slanting_stroke_goes_on_the_way_it_came(piece):
    assert aim([(1.5, 52), (31.5, 92)], TRUNK, piece=piece) == pytest.approx(0.025)


@PIECES
def test_nothing_ahead_is_twice_as_far_as_is_looked(piece):
    nothing = 2 * LOOK[piece]
    assert aim([(2, 50), (30, 50)], TRUNK, end=1, piece=piece) == nothing  # its other end
    assert aim([(2, 50), (2, 80)], TRUNK, piece=piece) == nothing  # beside the trunk
    assert aim([(100 * LOOK[piece] + 0.5, 50), (40, 50)], TRUNK, piece=piece) == nothing  # too far off


@PIECES
def test_a_foot_on_the_parent_meets_it_at_once(piece):
    assert aim([(0, 50), (30, 70)], TRUNK, piece=piece) == pytest.approx(0.0, abs=1e-12)


def test_a_foot_past_its_parent_does_not_point_back_at_it():
    assert aim([(-1, 50), (30, 50)], TRUNK) == 2 * LOOK[NEAR]


def test_the_nearest_of_several_meetings_counts():
    assert aim([(1, 50), (30, 50)], [(0, 0), (0, 60), (-1, 60), (-1, 40), (-1, 0), (0, -40)]) == pytest.approx(1 / 100)


def test_each_piece_gives_its_own_direction():
    hooked = [(2, 50), (2, 53), (30, 53)]  # its first 2 % rise, its first 5 % lead away
    assert aim(hooked, TRUNK, piece=NEAR) == 2 * LOOK[NEAR]
    assert aim(hooked, TRUNK, piece=FAR) < 0.05


def test_a_line_shorter_than_the_piece_points_by_its_first_half():
    assert aim([(2, 50), (3, 50), (3, 51)], TRUNK) == pytest.approx(0.02)


@pytest.mark.parametrize("change", ["scaled", "turned", "mirrored", "shifted"])
def test_scale_turn_mirror_and_shift_change_nothing(change):
    rng = np.random.default_rng(2)
    angle = 0.7
    matrix = {"scaled": 1e4 * np.eye(2), "mirrored": np.diag([-1.0, 1.0])}.get(change, np.eye(2))
    if change == "turned":
        matrix = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    shift = np.array([300.0, -70.0]) if change == "shifted" else np.zeros(2)
    strokes = [TRUNK] + [np.array([foot, foot + rng.normal(0, 20, 2)]) for foot in rng.uniform(-3, 3, (20, 2)) + (0, 50)]
    row, parent, gap = np.arange(2, 42), np.zeros(40, int), np.zeros(40)

    def found(points, height=100.0):
        return aims(replace(Bundle.of(lines(*points)), height=height), row, parent, gap, NEAR)

    plain = found(strokes)
    other = [np.array(points) @ matrix.T + shift for points in strokes]
    assert found(other, 1e6 if change == "scaled" else 100.0) == pytest.approx(plain, abs=1e-9)
    assert 3 < (plain < 2 * LOOK[NEAR]).sum() < 37


def test_no_arcs_have_no_aims():
    bundle = Bundle.of(lines(TRUNK, [(2, 50), (30, 50)]))
    empty = np.zeros(0, int)
    assert aims(bundle, empty, empty, np.zeros(0), NEAR).shape == (0,)
