import numpy as np
import pytest
from little_lines import line

from sketchtree.sketch.joining.folding import unfolded

H = 100.0
TRUNK = [(0, 0), (0, 50), (0, 100)]


def pieces(points):
    """The pieces of a stroke as rounded points, each from its lower end; sorted."""
    found = [[tuple(p) for p in one.points.round(0).tolist()] for one in unfolded(line(points), H)]
    return sorted(min(one, one[::-1], key=lambda points: (points[0][1], points[0][0])) for one in found)


def both_ways(points):
    assert pieces(points) == pieces(points[::-1])
    return pieces(points)


def test_up_and_down_again_is_one_line():
    assert both_ways([*TRUNK, (0.2, 60), (0, 20)]) == [TRUNK]


def test_up_and_down_and_up_again_is_one_line():
    assert both_ways([*TRUNK, (0.2, 50), (0, 10), (0.1, 60)]) == [TRUNK]


@pytest.mark.parametrize("branch", [(30, 70), (90, 80), (30, 50)])
def test_back_along_a_branch_and_on_as_another_is_two_lines(branch):
    found = both_ways([*TRUNK, (0.2, 50), branch])
    assert found == [TRUNK, [(0.0, 50.0), branch]]


def test_what_is_drawn_twice_stays_with_the_part_that_goes_straighter_on():
    straight, slanting = [(0, 0), (2, 50), (4, 100)], [(2, 50), (60, 70)]
    assert both_ways([*straight, (2, 50), (60, 70)]) == [straight, slanting]
    shared = [(0, 100), (2, 50), (0, 0), (2, 50), (60, 40)]  # the same upside down, the shared piece first
    assert both_ways(shared) == [[(0, 0), (2, 50), (0, 100)], [(60, 40), (2, 50)]]


def test_a_tree_in_one_stroke_is_its_branches():
    tree = [(0, 0), (0, 40), (-50, 60), (0, 40), (0, 70), (40, 80), (0, 70), (0, 100)]
    found = both_ways(tree)
    assert len(found) == 3
    assert sum(line(points).length for points in found) == pytest.approx(100 + np.hypot(50, 20) + np.hypot(40, 10), abs=3)


@pytest.mark.parametrize(
    "points",
    [
        [(0, 0), (0, 100), (20, 10)],  # down elsewhere
        [(0, 0), (0, 100), (0, 98)],  # a small hook
        [(0, 0), (0, 100), (7, 20), (14, 100), (21, 20)],  # narrow zigzags
        [(0, 0), (0, 60), (40, 60), (40, 0)],  # no cusp
        TRUNK,
    ],
    ids=["elsewhere", "hook", "zigzag", "corners", "straight"],
)
def test_all_other_turns_are_left_as_they_were_drawn(points):
    one = line(points)
    assert unfolded(one, H) == [one]


@pytest.mark.parametrize("scale", [1e-5, 1e5])
def test_scale_changes_nothing(scale):
    points = np.array([*TRUNK, (0.2, 50), (30, 70)], float)
    plain, other = unfolded(line(points), H), unfolded(line(points * scale), H * scale)
    assert [one.points.tolist() for one in plain] == [pytest.approx(one.points / scale) for one in other]
