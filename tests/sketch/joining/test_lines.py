import numpy as np
import pytest
from little_lines import line, lines, random_lines

from sketchtree.sketch.joining.lines import angle_between, extent, turning, unit

BENT = [(0, 0), (3, 0), (3, 4), (3, 10)]


def test_lengths_are_those_walked():
    bent = line(BENT)
    assert bent.along.tolist() == [0, 3, 7, 13] and bent.length == 13 == bent.shape.length


@pytest.mark.parametrize(("s", "point"), [(0, (0, 0)), (1.5, (1.5, 0)), (3, (3, 0)), (5, (3, 2)), (13, (3, 10))])
def test_a_length_is_a_point(s, point):
    assert line(BENT).at(s).tolist() == list(point)
    assert line(BENT).at([[s, s]]).tolist() == [[list(point)] * 2]


@pytest.mark.parametrize("s", [-1.0, 14.0])
def test_beyond_an_end_is_the_end(s):
    assert line(BENT).at(s).tolist() == ([0, 0] if s < 0 else [3, 10])


def test_direction_is_taken_over_a_reach_to_either_side():
    bent = line(BENT)
    assert bent.direction(1.0, 0.5).tolist() == [1, 0] and bent.direction(10.0, 1.0).tolist() == [0, 1]
    assert bent.direction(3.0, 2.0) == pytest.approx(np.array([1, 1]) / np.sqrt(2))


def test_at_an_end_direction_is_taken_over_what_is_there():
    assert line(BENT).direction(0.0, 2.0).tolist() == [1, 0]
    assert line(BENT).direction(13.0, 2.0).tolist() == [0, 1]


def test_a_cut_keeps_the_points_between_and_ends_where_it_was_cut():
    part = line(BENT, width=[1.0, 2.0, 3.0, 4.0]).cut(1.5, 10)
    assert part.points.tolist() == [[1.5, 0], [3, 0], [3, 4], [3, 7]]
    assert part.width.tolist() == [1.5, 2.0, 3.0, 3.5]


@pytest.mark.parametrize("off", [0.0, 1e-12, -1e-12])
def test_a_cut_at_a_point_does_not_double_it(off):
    assert line(BENT).cut(3 + off, 7 + off).points == pytest.approx(np.array([[3, 0], [3, 4]]), abs=1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_cut_pieces_together_are_the_line(seed):
    whole = random_lines(seed, 2)[1]
    pieces = [whole.cut(a, b) for a, b in ((0, 0.3), (0.3, 0.31), (0.31, 1)) for a, b in [(a * whole.length, b * whole.length)]]
    assert sum(piece.length for piece in pieces) == pytest.approx(whole.length)
    joined = np.concatenate([pieces[0].points, pieces[1].points[1:], pieces[2].points[1:]])
    assert line(joined).shape.hausdorff_distance(whole.shape) < 1e-9


def test_a_reversed_line_runs_the_other_way_with_its_widths():
    back = line(BENT, width=[1.0, 2.0, 3.0, 4.0]).reversed()
    assert [tuple(p) for p in back.points.tolist()] == BENT[::-1]
    assert back.width.tolist() == [4, 3, 2, 1] and back.at(0).tolist() == [3, 10]


def test_turning_is_the_sum_of_the_angles_of_each_line_by_itself():
    found = turning(lines(BENT, [(0, 0), (1, 0)], [(5, 5), (6, 5), (5, 5.0)]))
    assert found == pytest.approx([np.pi / 2, 0, np.pi])


def test_unit_vectors_have_length_one_and_nothing_stays_nothing():
    assert unit(np.array([[3.0, 4.0], [0.0, 0.0]])).tolist() == [[0.6, 0.8], [0.0, 0.0]]


@pytest.mark.parametrize("degrees", [0, 30, 90, 179, 180])
def test_angles_have_no_side(degrees):
    a, b = np.array([1.0, 0.0]), np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    assert np.degrees([angle_between(a, b), angle_between(b, a)]) == pytest.approx([degrees] * 2, abs=1e-6)


def test_extent_is_height_or_width_whichever_is_larger():
    assert extent(lines([(0, 0), (0, 10)], [(0, 5), (4, 7)])) == 10
    assert extent(lines([(0, 0), (0, 10)], [(0, 5), (40, 7)])) == 40
