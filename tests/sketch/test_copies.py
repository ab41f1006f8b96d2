import numpy as np
import pytest

from sketchtree.sketch.copies import without_copies
from sketchtree.sketch.joining.cleaning import AGAIN_OVER
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

TRUNK = np.array([(0, 0), (1, 40), (-1, 80), (0, 100)], float)
LIMB = np.array([(0, 50), (20, 60), (35, 80)], float)
TWIG = np.array([(20, 60), (35, 62), (48, 70)], float)
ROUND = np.array([(60 * np.cos(a), 75 + 50 * np.sin(a)) for a in np.linspace(0, 2 * np.pi, 40)])


def named(**points):
    return [Stroke(name, line) for name, line in points.items()]


def read(strokes):
    return sketch_graph(Sketch(tuple(strokes)))


def lines(graph, name):
    return [a for a in graph.attachments if a.stroke == name]


def test_a_copy_is_reported_as_merged_with_what_it_repeats():
    graph = read(named(trunk=TRUNK, limb=LIMB, limb2=LIMB, twig=TWIG))
    (one,) = lines(graph, "limb2")
    assert (one.parent, one.reason, one.point) == ("limb", AGAIN_OVER, (0.0, 50.0))
    assert graph.warnings == ("1 stroke(s) drawn exactly over others were merged with them (strokes limb2).",)


def test_a_copy_drawn_from_the_other_end_is_a_copy():
    assert lines(read(named(trunk=TRUNK, limb=LIMB, limb2=LIMB[::-1])), "limb2")[0].reason == AGAIN_OVER


def test_the_tree_is_that_without_the_copies():
    plain, graph = read(named(trunk=TRUNK, limb=LIMB, twig=TWIG)), read(named(limb2=LIMB, trunk2=TRUNK, trunk=TRUNK, limb=LIMB, twig=TWIG, twig2=TWIG))
    for name in ("parent", "xy", "limb", "width", "curve_points", "limb_id"):
        assert np.array_equal(getattr(graph, name), getattr(plain, name), equal_nan=name == "width")
    assert [graph.stroke_ids[row] for row in graph.stroke] == [plain.stroke_ids[row] for row in plain.stroke]


def test_the_order_of_the_file_does_not_say_which_copy_is_kept():
    strokes = named(trunk=TRUNK, limb=LIMB, limb2=LIMB, limb3=LIMB, twig=TWIG)
    graph, other = read(strokes), read(strokes[::-1])
    assert graph.limb_id.tolist() == other.limb_id.tolist()
    assert {(a.stroke, a.parent) for a in graph.attachments} == {(a.stroke, a.parent) for a in other.attachments}


def test_the_copy_begun_first_is_kept():
    limbs = [Stroke(name, LIMB, time=np.array([begun, begun + 1, begun + 2])) for name, begun in (("a", 900.0), ("b", 100.0))]
    assert lines(read([*named(trunk=TRUNK), *limbs]), "a")[0].parent == "b"


def test_copies_of_what_is_merged_itself_hang_on_the_stroke_that_stays():
    graph = read(named(trunk=TRUNK, limb=LIMB, near=LIMB + 0.1, near2=LIMB + 0.1))
    parents = {a.stroke: a.parent for a in graph.attachments}
    (kept,) = {"limb", "near"} - {a.stroke for a in graph.attachments if a.reason == AGAIN_OVER}
    assert parents["near2"] == kept


def test_a_copy_of_what_is_no_branch_is_no_branch_either():
    crown = [Stroke(name, ROUND, StrokeKind.CROWN, labelled=True, closed=True) for name in ("crown", "crown2")]
    dots = [Stroke(name, np.array([(30.0, 5.0)])) for name in ("dot", "dot2")]
    graph = read([*named(trunk=TRUNK, limb=LIMB), *crown, *dots])
    assert {role.stroke: role.role for role in graph.roles} == {"crown": "crown", "crown2": "crown", "dot": "dot", "dot2": "dot"}
    assert len(graph.crown) == 1 and lines(graph, "crown2")[0].parent is None


@pytest.mark.parametrize("other", [{"width": 5.0}, {"filled": True}, {"layer": "roots"}, {"pressure": np.array([0.1, 0.2, 0.3])}, {"closed": True}])
def test_strokes_that_differ_in_more_than_name_and_time_are_no_copies(other):
    sketch = Sketch((Stroke("a", LIMB), Stroke("b", LIMB, **other)))
    assert without_copies(sketch) == (sketch, {})


def test_a_drawing_without_copies_stays_as_it_is():
    sketch = Sketch(tuple(named(trunk=TRUNK, limb=LIMB, twig=TWIG)))
    assert without_copies(sketch) == (sketch, {})


def test_nineteen_thousand_copies_are_one_limb_and_each_is_accounted_for():
    strokes = [*named(trunk=TRUNK), *(Stroke(f"s{k}", LIMB if k % 2 else LIMB[::-1]) for k in range(19_000))]
    graph = read(strokes)
    assert len(graph.limb_id) == 2 and [a.stroke for a in graph.attachments] == [s.id for s in strokes]
    assert sum(a.reason == AGAIN_OVER and a.parent == "s0" for a in graph.attachments) == 18_999
    assert "18999 stroke(s) drawn exactly over others" in graph.warnings[0] and len(graph.stroke_ids) == 19_001
