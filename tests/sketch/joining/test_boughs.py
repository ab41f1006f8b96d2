import numpy as np
import pytest

from sketchtree.sketch.joining.attach import attach
from sketchtree.sketch.joining.boughs import FREE, HEAVIER, heavier_foot
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch, Stroke

BOUGH = [(0, 70), (30, 45), (60, 35), (100, 30)]  # from its thick end down to its tip
TWIGS = [[(30, 45), (38, 60), (45, 82)], [(60, 35), (66, 20), (80, 0)], [(60, 35), (70, 48), (84, 60)]]
STEM = [(0, 10), (0, 40), (2, 80), (10, 100)]
HANGING = [[(0, 70), (20, 80), (35, 50), (38, 2)], [(0, 60), (-18, 72), (-34, 40), (-36, 0)]]


def pen(name, points, width, pressure=None):
    return Stroke(name, np.array(points, float), width=width, pressure=pressure)


def drawn(main, others, width=6.0, thin=1.0):
    return Sketch((pen("main", main, width), *(pen(f"twig{k}", points, thin) for k, points in enumerate(others))))


def base(graph):
    return graph.stroke_ids[graph.stroke[graph.is_base][0]], graph.xy[graph.is_base]


def turned(sketch):
    return Sketch(tuple(pen(s.id, s.points[::-1], s.width) for s in reversed(sketch.strokes)))


def ink(main, others, taper=0.0):
    """Lines whose first is three times as wide; `taper`: log of its last width over its first."""
    width = [3 * np.exp(np.linspace(0, taper, len(main))), *(np.full(len(points), 1.0) for points in others)]
    return [Line(k, f"s{k}", np.array(points, float), w) for k, (points, w) in enumerate(zip([main, *others], width, strict=True))]


def lowest(lines):
    return int(np.argmin(Bundle.of(lines).ends[:, 1]))


@pytest.mark.parametrize("turn", [False, True])
def test_a_weeping_tree_stands_on_its_trunk_though_twigs_hang_lower(turn):
    sketch = drawn(STEM, HANGING)
    graph = sketch_graph(turned(sketch) if turn else sketch)
    name, foot = base(graph)
    assert name == "main" and foot.tolist() == [[0, 10]]
    assert {a.stroke for a in graph.attachments if a.parent == "main"} == {"twig0", "twig1"}


def test_a_bough_starts_at_its_thick_end_though_a_twig_reaches_lower():
    lines = ink(BOUGH, TWIGS, taper=-0.8)
    hanging = attach(lines)
    assert hanging.parent.tolist() == [-1, 0, 0, 0] and hanging.end[0] == 0
    flipped = [lines[0].reversed(), *lines[1:]]
    assert attach(flipped).end[0] == 1


def test_a_bough_alone_has_no_second_stem():
    twigs = [*TWIGS, [(8, 63), (12, 80), (14, 100)]]
    assert (attach(ink(BOUGH, twigs, taper=-0.8)).parent == -1).sum() == 1


def test_of_an_even_line_the_lower_end_is_the_foot():
    lines = ink(STEM, HANGING)
    assert heavier_foot(Bundle.of(lines), lowest(lines)) == 0


def test_a_line_with_the_lowest_end_and_the_most_ink_stands_on_that_end_even_if_it_is_the_thinner_one():
    lines = ink([(0, 0), (0, 50), (0, 100)], TWIGS[:1], taper=0.9)
    assert heavier_foot(Bundle.of(lines), 0) is None and attach(lines).end[0] == 0


def test_lines_of_one_pen_say_nothing():
    lines = [Line(k, f"s{k}", np.array(points, float), np.full(len(points), np.nan)) for k, points in enumerate([BOUGH, *TWIGS])]
    assert heavier_foot(Bundle.of(lines), lowest(lines)) is None


def test_a_line_with_not_much_more_ink_says_nothing():
    long = [(0, 40), (60, 60), (50, 80), (-40, 90), (-50, 20), (-30, 0)]
    lines = ink(STEM, [long])
    assert lines[0].length * 3 < HEAVIER * lines[1].length and heavier_foot(Bundle.of(lines), lowest(lines)) is None


@pytest.mark.parametrize("free", [False, True])
def test_a_thick_end_that_another_line_meets_is_a_joint(free):
    up = 20 if free else 0.5 * FREE * 100
    root = [(0, 10 - up), (12, 8 - up), (20, -20)]
    lines = ink(STEM, [root])
    assert heavier_foot(Bundle.of(lines), lowest(lines)) == (0 if free else None)
