"""Where lines run, how wide they are, and where one ends or goes on: to a part of a pixel."""

import numpy as np
import pytest
import shapely
import sheets
from PIL import Image

from sketchtree.sketch.reading import sketch_graph

SIZE = (300, 300)
CENTRE = np.array([150.0, 150.0])


def spoke(degrees: float, length: float = 110.0, start: float = -110.0) -> np.ndarray:
    """A straight line through the middle of the page."""
    heading = np.array([np.cos(np.radians(degrees)), -np.sin(np.radians(degrees))])
    return CENTRE + np.array([[start], [length]]) * heading


def only(sketch):
    (stroke,) = sketch.strokes
    return stroke


@pytest.mark.parametrize("width", [1.0, 1.5, 2.0, 3.0, 4.5, 7.0])
@pytest.mark.parametrize("degrees", [0, 17, 45, 63, 90, 135])
def test_a_pens_line_lies_where_it_was_drawn_to_half_a_pixel(width, degrees):
    drawn = spoke(degrees)
    stroke = only(sheets.read(sheets.cover([drawn], width, SIZE)))
    points = stroke.points * (1, -1)
    along = points @ (drawn[1] - drawn[0]) / 220
    inner = points[np.abs(along - along.mean()) < 105 - width]
    assert shapely.distance(shapely.points(inner), shapely.LineString(drawn)).max() < 0.5
    ends = points[[0, -1]] if along[0] < along[-1] else points[[-1, 0]]
    assert np.hypot(*(ends - drawn).T).max() < 1.0 + 0.4 * width


@pytest.mark.parametrize("width", [2.0, 3.0, 5.0, 8.0, 14.0, 24.0])
@pytest.mark.parametrize("degrees", [0, 45, 70])
def test_a_line_is_as_wide_as_it_was_drawn(width, degrees):
    stroke = only(sheets.read(sheets.cover([spoke(degrees)], width, SIZE)))
    assert np.median(sheets.widths(stroke)) == pytest.approx(width, abs=0.6)


@pytest.mark.parametrize("degrees", range(0, 180, 15))
def test_no_direction_loses_a_line(degrees):
    """Thinning by Zhang and Suen's rule eats lines of even width at 45°."""
    for width in (2, 5, 7, 8, 9, 16):
        stroke = only(sheets.read(sheets.cover([spoke(degrees)], width, SIZE)))
        assert np.hypot(*np.diff(stroke.points, axis=0).T).sum() == pytest.approx(220, abs=3 + width)


def test_a_limb_that_thins_out_keeps_its_taper():
    outline = [(140, 280), (160, 280), (152, 20), (148, 20)]
    stroke = only(sheets.read(sheets.area(outline, SIZE)))
    order = np.argsort(stroke.points[:, 1])
    y, width = -stroke.points[order, 1], sheets.widths(stroke)[order]
    inner = (y > 40) & (y < 260)
    assert np.abs(width - (4 + 16 * (y - 20) / 260))[inner].max() < 1.2
    assert stroke.wood  # such a width is the limb's, no pen's
    assert y.min() < 26 and y.max() > 268


def test_one_pens_lines_get_one_width_and_no_pressure():
    for stroke in sheets.read(sheets.cover()).strokes:
        assert stroke.pressure is None and not stroke.wood and stroke.width == pytest.approx(4, abs=0.3)


def test_a_brushs_widths_are_its_strokes_own():
    sketch = sheets.read(sheets.cover(width=(10, 4, 4, 3)))
    assert [float(np.median(sheets.widths(s))) for s in sketch.strokes] == pytest.approx([10, 4, 4, 3], abs=0.8)


@pytest.mark.parametrize("turn", [12, 20, 35, 60, 90])
@pytest.mark.parametrize("width", [2.0, 4.0])
def test_lines_that_cross_are_kept_apart(turn, width):
    lines = [spoke(10), spoke(10 - turn)]
    sketch = sheets.read(sheets.cover(lines, width, SIZE))
    assert len(sketch) == 2
    for stroke in sketch.strokes:
        curve = [stroke.points * (1, -1)]
        assert min(sheets.farthest(curve, [line]) for line in lines) < 1.5 * width + 1


def test_three_lines_across_each_other():
    lines = [spoke(90), spoke(30), spoke(150)]
    sketch = sheets.read(sheets.cover(lines, 3.0, SIZE))
    assert len(sketch) == 3
    assert all(min(sheets.farthest([s.points * (1, -1)], [line]) for line in lines) < 3 for s in sketch.strokes)


@pytest.mark.parametrize("angle", [25, 45, 70, 90])
def test_a_limb_starts_on_the_line_it_grows_from(angle):
    lines = [spoke(90, 120, -120), spoke(90 - angle, 110, 0)]
    sketch = sheets.read(sheets.cover(lines, 4.0, SIZE))
    trunk, limb = sketch.strokes
    ends = shapely.points(limb.points[[0, -1]])
    assert shapely.distance(ends, shapely.LineString(trunk.points)).min() < 0.3
    assert sheets.apart(sketch, lines) < 3.0


def test_no_line_goes_on_through_a_palms_head():
    lines = [spoke(90, 0, -140), *(spoke(degrees, 120, 0) for degrees in (5, 35, 62, 90, 118, 145, 175))]
    sketch = sheets.read(sheets.cover(lines, 3.0, SIZE))
    assert all(np.hypot(*(s.points[[0, -1]] * (1, -1) - CENTRE).T).min() < 8 for s in sketch.strokes)
    assert sum(np.hypot(*np.diff(s.points, axis=0).T).sum() > 100 for s in sketch.strokes) == len(lines)


def test_gaps_of_a_pen_are_bridged():
    lines = [spoke(80, -3), spoke(80, 110, 3)]
    assert len(sheets.read(sheets.cover(lines, 2.5, SIZE))) == 1


def test_a_faint_touch_of_the_pencil_joins_what_lies_beyond_it():
    ink = np.maximum(sheets.cover([spoke(80, -8), spoke(80, 110, 8)], 2.5, SIZE), 0.15 * sheets.cover([spoke(80)], 2.5, SIZE))
    assert len(sheets.read(ink)) == 1


def test_a_gap_without_a_touch_of_the_pencil_stays_one():
    assert len(sheets.read(sheets.cover([spoke(80, -8), spoke(80, 110, 8)], 2.5, SIZE))) == 2


def test_the_tooth_of_the_paper_makes_no_loops_in_a_line():
    ink = sheets.cover([spoke(80)], 8.0, SIZE)
    ink[np.random.default_rng(2).random(ink.shape) < 0.03] = 0
    assert len(sheets.read(ink)) == 1


def test_two_limbs_that_point_at_each_other_from_afar_are_two():
    assert len(sheets.read(sheets.cover([spoke(80, -30), spoke(80, 110, 30)], 4.0, SIZE))) == 2


@pytest.mark.parametrize("tone", ["black", "scanned"])
def test_limbs_drawn_by_their_outlines_collapse_to_their_middles(tone):
    """A trunk of 24 pixels and two limbs of 12, drawn as one outline with a pen of 2."""
    trunk = shapely.LineString([(150, 290), (150, 40)]).buffer(12, cap_style="flat")
    limbs = [shapely.LineString([(150, 170), (240, 90)]).buffer(6, cap_style="flat"), shapely.LineString([(150, 130), (60, 70)]).buffer(6, cap_style="flat")]
    outline = np.array(shapely.union_all([trunk, *limbs]).exterior.coords)
    ink = sheets.cover([outline], 2.0, SIZE)
    sketch = sheets.read(ink if tone == "black" else sheets.image_of(ink, 0.9, 0.2))
    middles = [[(150, 290), (150, 40)], [(150, 170), (240, 90)], [(150, 130), (60, 70)]]
    assert len(sketch) == 3
    assert sheets.farthest(sheets.curves(sketch), middles) < 5.0
    assert sheets.farthest(middles, sheets.curves(sketch)) < 9.0
    width = sorted(float(np.median(sheets.widths(s))) for s in sketch.strokes)
    assert width == pytest.approx([14, 14, 26], abs=1.5)  # the outer edges of the pen
    assert all(stroke.wood for stroke in sketch.strokes)


@pytest.mark.parametrize("crossing", [260, 220, 180, 140])
@pytest.mark.parametrize("apart", [14, 24, 36, 50])
def test_two_lines_that_cross_above_their_feet_are_no_outlined_trunk(apart, crossing):
    far = apart * (345 - 40) / (345 - crossing)
    lines = [[(150 + side * apart / 2, 345), (150 + side * (apart / 2 - far), 40)] for side in (-1, 1)]
    sketch = sheets.read(sheets.cover(lines, 3.0))
    assert len(sketch) == 2 and all(s.width < 4 and not s.wood for s in sketch.strokes)
    assert sheets.farthest(sheets.curves(sketch), lines) < 3.0


@pytest.mark.parametrize("past", [0, 6, 14])
def test_a_trunk_whose_sides_meet_at_the_tip_and_run_past_it_is_outlined(past):
    sides = [[(150 - side * 15, 345), (150 + side * 15 * past / 265, 80 - past)] for side in (-1, 1)]
    sketch = sheets.read(sheets.cover([*sides, [(157, 230), (250, 150)], [(145, 260), (60, 170)]], 2.5))
    trunk = max(sketch.strokes, key=lambda stroke: np.ptp(stroke.points[:, 1]))
    assert len(sketch) == 3 and trunk.wood and np.median(sheets.widths(trunk)) > 12


def test_a_painted_silhouette_is_its_middle_lines():
    shape = [shapely.LineString([(150, 290), (150, 30)]).buffer(11, cap_style="flat"), shapely.LineString([(150, 180), (250, 100)]).buffer(6)]
    outline = np.array(shapely.union_all(shape).exterior.coords)
    sketch = sheets.read(sheets.area(outline, SIZE))
    trunk, limb = sketch.strokes
    assert np.median(sheets.widths(trunk)) == pytest.approx(22, abs=1) and np.median(sheets.widths(limb)) == pytest.approx(12, abs=1)
    assert sheets.farthest(sheets.curves(sketch), [[(150, 290), (150, 30)], [(150, 180), (255, 96)]]) < 3.0


def graph_of(image):
    return sketch_graph(sheets.read(image))


def test_a_picture_twice_as_large_gives_the_same_tree_twice_as_large():
    small = sheets.image_of(sheets.cover())
    one = sheets.read(small)
    two = sheets.read(sheets.cover([2 * line for line in sheets.TREE], 8.0, (600, 720)))
    assert len(one) == len(two)
    assert sheets.farthest(sheets.curves(two), [2 * c for c in sheets.curves(one)]) < 3.0
    assert [s.width for s in two.strokes] == pytest.approx([2 * s.width for s in one.strokes], rel=0.05)


@pytest.mark.parametrize("how", ["FLIP_LEFT_RIGHT"])
def test_the_mirrored_picture_gives_the_mirrored_tree(how):
    image = sheets.image_of(sheets.cover())
    one, two = graph_of(image), graph_of(image.transpose(Image.Transpose[how]))
    assert len(one.limb_id) == len(two.limb_id) == 4 and one.segment_count == two.segment_count
    mirrored = sorted((300 - x, y) for x, y in two.xy.tolist())
    assert np.abs(np.array(sorted(map(tuple, one.xy.tolist()))) - mirrored).max() < 1.5


def test_the_tree_is_rooted_at_its_foot_with_every_limb_on_the_trunk():
    graph = graph_of(sheets.cover())
    assert graph.is_base.sum() == 1 and graph.xy[graph.is_base][0] == pytest.approx([150, -345], abs=2.5)
    assert graph.limb_parent.tolist().count(-1) == 1 and not graph.warnings
    assert (graph.limb_parent[graph.limb_parent >= 0] == np.flatnonzero(graph.limb_parent < 0)[0]).all()
