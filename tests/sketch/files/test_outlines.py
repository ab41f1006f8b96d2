import numpy as np
import pytest
import shapely

from sketchtree.sketch.files.outlines import flatten, subpaths
from sketchtree.sketch.files.viewport import View

VIEW = View(100.0, 100.0)


def points_of(tag, tolerance=0.01, **attributes):
    (path,) = subpaths(tag, attributes, VIEW)
    return np.concatenate([path.start[None], flatten(path.cubics, tolerance)[0]])


@pytest.mark.parametrize(
    "data, end",
    [
        ("M 1 2 L 3 4", (3, 4)),
        ("m1,2 2,2", (3, 4)),
        ("M1 2H9", (9, 2)),
        ("M1 2v-5", (1, -3)),
        ("M0 0C0 1 2 3 4 4", (4, 4)),
        ("M0 0c0 1 2 3 4 4s1 1 2 2", (6, 6)),
        ("M0 0Q2 2 4 0T8 0", (8, 0)),
        ("M0 0q2 2 4 0t4 0", (8, 0)),
        ("M0 0A5 5 0 0 1 10 0", (10, 0)),
        ("M0 0a5 5 0 0110 0", (10, 0)),
    ],
)
def test_every_path_command_ends_where_it_should(data, end):
    assert points_of("path", d=data)[-1] == pytest.approx(end)


def test_a_path_of_two_moves_is_two_strokes():
    assert len(subpaths("path", {"d": "M0 0L1 1M5 5L6 6Z"}, VIEW)) == 2


def test_what_follows_a_closing_starts_at_its_beginning():
    first, second = subpaths("path", {"d": "M1 1L5 1L5 5Zl-1 -1"}, VIEW)
    assert first.closed and not second.closed
    assert second.start == pytest.approx((1, 1))


def test_flattening_stays_within_the_tolerance():
    cubic = np.array([[[0, 0], [0, 90], [100, -50], [100, 40.0]]])
    t = np.linspace(0, 1, 4001)[:, None]
    p = cubic[0]
    exact = (1 - t) ** 3 * p[0] + 3 * t * (1 - t) ** 2 * p[1] + 3 * t**2 * (1 - t) * p[2] + t**3 * p[3]
    for tolerance in (1.0, 0.05):
        rough = shapely.LineString(np.vstack([p[:1], flatten(cubic, tolerance)[0]]))
        assert shapely.distance(rough, shapely.points(exact)).max() <= tolerance


def test_a_straight_line_stays_two_points():
    assert len(points_of("line", x1="0", y1="0", x2="50%", y2="9")) == 2


def test_a_circle_is_round():
    points = points_of("circle", tolerance=1e-3, cx="5", cy="5", r="10")
    assert np.hypot(*(points - 5).T) == pytest.approx(10, rel=5e-4)


def test_a_rounded_rectangle_touches_its_sides_and_cuts_its_corners():
    points = points_of("rect", x="0", y="0", width="10", height="6", rx="2")
    assert points.min(0) == pytest.approx((0, 0)) and points.max(0) == pytest.approx((10, 6))
    assert np.hypot(*points.T).min() > 0.5


def test_a_polyline_with_an_odd_number_drops_it():
    assert points_of("polyline", points="0,0 5,5 9")[-1] == pytest.approx((5, 5))


@pytest.mark.parametrize("data", ["M0 0L nan 3", "M0 0 L 5", "L 3 4"])
def test_path_data_that_make_no_sense_are_refused(data):
    with pytest.raises(ValueError):
        subpaths("path", {"d": data}, VIEW)
