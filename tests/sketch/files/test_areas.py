import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from sketchtree.sketch.files.areas import MOST_EDGES, NOTHING, area, inside

SQUARE = np.array([[0, 0], [10, 0], [10, 10], [0, 10.0]])
BOX = shapely.box(0, 0, 10, 10)
DISC = shapely.Point(5, 5).buffer(5)
POINT = st.tuples(st.integers(-20, 20), st.integers(-20, 20))


def turns(rings, x, y):
    """How often outlines run around a point, edge by edge: the slow twin."""
    total = 0
    for ring in rings:
        for (ax, ay), (bx, by) in zip(ring, np.roll(ring, -1, 0), strict=True):
            side = (bx - ax) * (y - ay) - (x - ax) * (by - ay)
            total += int(ay <= y < by and side > 0) - int(by <= y < ay and side < 0)
    return total


@settings(max_examples=100, deadline=None)
@given(st.lists(st.lists(POINT, min_size=3, max_size=7), min_size=1, max_size=3), st.sampled_from(["nonzero", "evenodd"]))
def test_a_point_is_inside_as_its_winding_number_says(rings, rule):
    rings = [np.array(ring, float) for ring in rings]
    found = area(rings, rule)
    rng = np.random.default_rng(0)
    for x, y in rng.uniform(-20, 20, (30, 2)):
        w = turns(rings, x, y)
        if shapely.distance(shapely.MultiLineString([np.vstack([r, r[:1]]) for r in rings]), shapely.Point(x, y)) > 1e-6:
            assert shapely.contains_xy(found, x, y) == (w % 2 == 1 if rule == "evenodd" else w != 0)


def test_outlines_that_enclose_nothing_are_no_area():
    assert area([]) is NOTHING and area([SQUARE[:2]]) is NOTHING
    assert area([SQUARE[[0, 1, 0]]]).is_empty


def test_an_outline_that_crosses_itself_without_end_is_refused():
    rng = np.random.default_rng(0)
    for edges in (700, MOST_EDGES + 1):
        with pytest.raises(ValueError, match="the outline crosses itself too often"):
            area([rng.uniform(0, 1, (edges, 2))])


@settings(max_examples=200, deadline=None)
@given(st.lists(POINT, min_size=1, max_size=8), st.booleans(), st.sampled_from([BOX, DISC, BOX - DISC, shapely.box(3.5, -9, 4.5, 9)]))
def test_the_parts_of_a_line_are_as_long_as_what_lies_inside(points, closed, region):
    points = np.array(points, float)
    parts = inside(points, closed, False, region)
    steps = np.vstack([points, points[:1]]) if closed and len(points) > 2 else points
    edges = shapely.linestrings(np.stack([steps[:-1], steps[1:]], 1))
    expected = shapely.length(shapely.intersection(edges, region)).sum()
    lengths = [np.hypot(*np.diff(np.vstack([p, p[:1]]) if whole and len(p) > 2 else p, axis=0).T).sum() for p, whole in parts]
    assert sum(lengths) == pytest.approx(expected, abs=1e-3)
    for part, _ in parts:
        assert shapely.distance(region, shapely.points(part)).max() < 1e-3


@settings(max_examples=100, deadline=None)
@given(st.lists(POINT, min_size=1, max_size=8), st.booleans(), st.booleans())
def test_a_region_around_all_changes_nothing(points, closed, filled):
    points = np.array(points, float)
    for region in (shapely.box(-20, -20, 20, 20), shapely.Point(0, 0).buffer(40), shapely.box(-30, -30, 30, 30) - shapely.box(25, 25, 26, 26)):
        ((same, whole),) = inside(points, closed, filled, region)
        assert np.array_equal(same, points)
        assert same is points or not filled
        assert whole == closed or (filled and len(points) > 2)


def test_a_line_that_leaves_and_comes_back_is_two_pieces_in_order():
    line = np.array([[5, 5], [15, 5], [15, 8], [5, 8.0]])
    first, second = inside(line, False, False, BOX)
    assert first[0] == pytest.approx(np.array([[5, 5], [10, 5]]))
    assert second[0] == pytest.approx(np.array([[10, 8], [5, 8]]))


def test_a_ring_that_is_cut_starts_at_the_cut_and_is_open():
    ring = np.array([[5, 5], [15, 5], [15, 8], [5, 8.0]])
    ((part, closed),) = inside(ring, True, False, BOX)
    assert not closed and part == pytest.approx(np.array([[10, 8], [5, 8], [5, 5], [10, 5]]))


def test_a_painted_shape_is_cut_to_closed_outlines_holes_included():
    ((part, closed),) = inside(SQUARE + 5, True, True, BOX)
    assert closed and shapely.Polygon(part).area == pytest.approx(25)
    hollow = BOX - shapely.box(4, 4, 6, 6)
    assert sorted(shapely.Polygon(part).area for part, _ in inside(SQUARE, True, True, hollow)) == pytest.approx([4, 100])


def test_a_line_along_the_border_stays():
    ((line, _),) = inside(SQUARE, True, False, BOX)
    assert line is SQUARE


def test_nothing_shows_through_an_empty_region():
    assert inside(SQUARE, True, False, NOTHING) == []
