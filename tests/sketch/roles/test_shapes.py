import numpy as np
import pytest

from sketchtree.sketch.joining.cleaning import as_line, clean
from sketchtree.sketch.joining.tremor import without_tremor
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.roles.crown import closed_crowns
from sketchtree.sketch.roles.measures import Measures
from sketchtree.sketch.roles.silhouette import is_blob, middle_lines, with_holes
from sketchtree.sketch.strokes import Sketch, Stroke


def crown_strokes(strokes):
    every = np.ones(len(strokes), bool)
    return [one.row for one in closed_crowns(Measures.of(tuple(strokes)), every, every)]


def painted(stroke_id, points):
    return Stroke(stroke_id, points, closed=True, filled=True)


def ring(radius, centre=(0, 80), count=40, opening=0.0):
    angle = np.linspace(-np.pi / 2 + opening, 1.5 * np.pi - opening, count)
    return np.c_[centre[0] + radius * np.cos(angle), centre[1] + radius * np.sin(angle)]


def line(*points):
    return as_line(0, "a", np.array(points, float), np.nan)


def test_a_tapered_trunk_becomes_its_middle_with_its_width():
    (middle,) = middle_lines(0, painted("t", [(-6, 0), (6, 0), (3, 100), (-3, 100)]), [])
    assert np.abs(middle.points[:, 0]).max() < 0.5
    assert sorted(middle.points[[0, -1], 1]) == pytest.approx([0, 100], abs=0.5)
    at = np.interp(50, middle.points[:, 1], middle.width)
    assert at == pytest.approx(9, rel=0.05)


def test_a_painted_fork_becomes_three_ways():
    shape = [(-4, 0), (4, 0), (4, 50), (40, 96), (34, 100), (0, 58), (-34, 100), (-40, 96), (-4, 50)]
    lines = middle_lines(0, painted("t", shape), [])
    assert len(lines) == 2
    tips = sorted(line.points[-1, 0] for line in lines)
    assert tips[0] < -30 and tips[1] > 30


def test_a_hole_belongs_to_the_part_of_its_path_around_it():
    strokes = [painted("a", ring(10)), painted("a-2", ring(4)), painted("b", ring(2))]
    assert with_holes(strokes) == [(0, [1]), (2, [])]


def test_a_disc_is_a_blob_and_a_stick_is_none():
    assert is_blob(painted("a", ring(10)))
    assert not is_blob(painted("a", [(0, 0), (2, 0), (2, 50), (0, 50)]))


def test_an_outline_around_the_tips_is_the_crown_even_if_it_does_not_close():
    trunk = Stroke("t", [(0, 0), (0, 70)])
    for opening in (0.0, 0.3):
        assert crown_strokes([trunk, Stroke("c", ring(40, opening=opening))]) == [1]


def test_a_shadow_on_the_ground_and_an_open_arch_are_no_crown():
    trunk = Stroke("t", [(0, 0), (0, 100)])
    assert crown_strokes([trunk, Stroke("c", ring(30, centre=(0, 0)))]) == []
    assert crown_strokes([trunk, Stroke("c", ring(40, opening=1.2))]) == []


def test_two_sides_under_a_crown_are_one_trunk():
    strokes = (Stroke("c", ring(40)), Stroke("l", [(-8, 0), (-5, 25), (-5, 50)]), Stroke("r", [(5, 50), (5, 25), (8, 1)]))
    graph = sketch_graph(Sketch(strokes))
    assert len(graph.limb_id) == 1 and np.abs(graph.xy[:, 0]).max() < 1
    assert graph.width[-1] == pytest.approx(10, abs=1) and "two sides of one trunk" in graph.warnings[0]


def test_two_stems_that_diverge_stay_two():
    graph = sketch_graph(Sketch((Stroke("l", [(-3, 0), (-30, 90)]), Stroke("r", [(3, 0), (30, 90)]))))
    assert graph.is_base.sum() == 2


def test_a_line_drawn_twice_is_one_and_a_twig_beside_its_parent_stays():
    trunk, again = line((0, 0), (0, 100)), line((0.5, 0.4), (0.4, 99.7))
    twig = line((0, 40), (1.5, 55))
    cleaned = clean([trunk, again, twig])
    assert len(cleaned.lines) == 2 and len(cleaned.merged) == 1


def test_a_tip_gone_over_twice_is_cut():
    (kept,) = clean([line((0, 0), (0, 100), (0.2, 60))]).lines
    assert kept.length == pytest.approx(100, rel=0.01)


def test_tremor_goes_and_a_bend_stays():
    s = np.linspace(0, 100, 301)
    bend = np.c_[10 * np.sin(s / 20), s]
    shaken = bend + np.c_[0.3 * (-1) ** np.arange(301), np.zeros(301)]
    steady = without_tremor(as_line(0, "a", shaken, np.nan), 100.0)
    assert np.abs(steady.points[5:-5] - bend[5:-5]).max() < 0.1
    smooth = as_line(0, "a", bend, np.nan)
    assert without_tremor(smooth, 100.0) is smooth


def test_a_foot_that_flares_stands_in_the_middle_of_its_flare():
    flared = [(-5, 20), (-6, 10), (-18, 0), (-10, 0), (0, 5), (11, 0), (19, 0), (6, 10), (5, 20), (4, 100), (-4, 100)]
    (trunk,) = middle_lines(0, painted("t", flared), [])
    assert trunk.points[0] == pytest.approx((0.5, 0), abs=2.5) and trunk.points[-1, 1] == pytest.approx(100, abs=0.5)


def test_long_legs_are_limbs_of_their_own():
    legs = [(-3, 40), (-30, 0), (-24, 0), (0, 34), (24, 0), (30, 0), (3, 40), (3, 100), (-3, 100)]
    assert len(middle_lines(0, painted("t", legs), [])) == 2
