import numpy as np
import pytest
from drawn import ring

from sketchtree.sketch.roles.brush import blunt, even_border, middles, slenderness, squared


def stroke(middle, half):
    """The border of a brush stroke along a line."""
    way = np.gradient(middle, axis=0)
    across = np.c_[-way[:, 1], way[:, 0]] / np.hypot(*way.T)[:, None] * np.broadcast_to(half, len(middle))[:, None]
    return np.vstack([middle + across, (middle - across)[::-1]])


t = np.linspace(0, 1, 60)
ARC = np.c_[60 * np.sin(1.5 * t), 100 * t]


@pytest.mark.parametrize("half", [3.0, 1 + 3 * t, 3.0 * np.sqrt(1.001 - t)])
def test_the_middle_of_a_brush_stroke_is_where_it_was_drawn_as_wide(half):
    found = middles(even_border(stroke(ARC, half))[None])
    assert found.single[0]
    gap = np.hypot(*(found.points[0][:, None] - ARC[None]).transpose(2, 0, 1)).min(1)
    assert gap[3:-3].max() < 1.5
    assert np.median(found.width[0]) == pytest.approx(np.median(2 * np.broadcast_to(half, 60)), rel=0.15)


@pytest.mark.parametrize(
    "shape",
    [
        ring(30),
        [(-4, 0), (4, 0), (4, 50), (40, 96), (34, 100), (0, 58), (-34, 100), (-40, 96), (-4, 50)],
        [(0, 0), (30, 0), (30, 40), (0, 40)],
    ],
)
def test_a_disc_a_fork_and_a_block_are_no_single_strokes(shape):
    assert not middles(even_border(np.array(shape, float))[None]).single[0]


def test_it_matters_neither_where_a_border_begins_nor_which_way_it_runs_nor_how_large_it_is():
    border = stroke(ARC, 3.0)
    one = middles(even_border(border)[None])
    for other, scale in ((np.roll(border, 31, axis=0), 1.0), (border[::-1], 1.0), (1000 * border, 1000.0)):
        found = middles(even_border(other)[None])
        assert found.single[0] and np.median(found.width[0]) == pytest.approx(scale * np.median(one.width[0]), rel=0.05)


def test_blunt_ends_are_as_wide_as_the_stroke_and_points_stay_points():
    bar = middles(even_border(np.array([(-4, 0), (4, 0), (4, 100), (-4, 100)], float))[None])
    assert bar.width[0][0] < 1, "the border is parted at one point"
    assert blunt(bar.points[0], bar.width[0]).min() > 6
    spindle = middles(even_border(stroke(ARC, 3.0 * np.sin(np.pi * t)))[None])
    assert blunt(spindle.points[0], spindle.width[0])[0] < 1.5


def test_a_squared_line_starts_in_the_middle_of_its_blunt_end():
    for shape in ([(-4, 0), (4, 0), (4, 100), (-4, 100)], [(4, 100), (-4, 100), (-4, 0), (4, 0)]):
        bar = middles(even_border(np.array(shape, float))[None])
        points, width = squared(bar.points[0], bar.width[0])
        assert np.abs(points[:, 0]).max() < 1.5 and width.min() > 5


def test_slenderness_is_that_of_the_rectangle():
    assert slenderness(np.array([20.0]), np.array([24.0])) == pytest.approx(5.0)
    assert slenderness(np.array([np.pi]), np.array([2 * np.pi])) == pytest.approx(1.0, abs=1e-6)


def test_no_shape_no_middle():
    assert len(middles(np.zeros((0, 96, 2))).points) == 0
