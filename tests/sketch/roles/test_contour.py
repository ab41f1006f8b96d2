import numpy as np
import pytest
from hands import EXAMPLES, SHARED
from test_shapes import ring

from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.roles.contour import contour, lone_outline
from sketchtree.sketch.strokes import Sketch, Stroke

DOME = ring(40, opening=0.6)  # open towards the ground
LEFT, RIGHT = np.array([(-8, 0), (-7, 25), (-8, 50)]), np.array([(8, 0), (7, 25), (8, 50)])


def strokes(*lines):
    return [Stroke(f"s{k}", points) for k, points in enumerate(lines)]


def graph_of(*lines):
    return sketch_graph(Sketch(tuple(strokes(*lines))))


def test_a_dome_on_two_trunk_edges_is_the_crown():
    graph = graph_of(DOME, LEFT, RIGHT)
    assert len(graph.crown) == 1 and len(graph.limb_id) == 1
    assert np.abs(graph.xy[:, 0]).max() < 1 and graph.width[-1] == pytest.approx(16, abs=1)


def test_a_trunk_and_its_crown_may_be_one_stroke():
    graph = graph_of(np.vstack([LEFT, ring(40, opening=0.25)[::-1], RIGHT[::-1]]))
    assert len(graph.crown) == 1 and len(graph.limb_id) == 1
    assert graph.crown[0][:, 1].min() > 35 and graph.xy[:, 1].max() < 60
    assert {a.stroke for a in graph.attachments} == {"s0"} and len(graph.attachments) == 1


def test_a_crown_may_be_two_arcs_that_close():
    whole = ring(40)
    graph = graph_of([(0, 0), (0, 55)], whole[:18], whole[17:])
    assert len(graph.crown) == 1 and len(graph.limb_id) == 1


def test_the_direction_and_order_of_the_strokes_do_not_matter():
    one = contour(strokes(DOME, LEFT, RIGHT))
    other = contour(strokes(RIGHT[::-1], LEFT, DOME[::-1]))
    assert np.ptp(one.outline, axis=0) == pytest.approx(np.ptp(other.outline, axis=0), rel=1e-6)


@pytest.mark.parametrize(
    "limb",
    [
        ring(25, centre=(25, 95), opening=0.6),  # curls over to one side of its trunk
        np.c_[np.linspace(-15, 15, 30), 100 + 8 * np.cos(np.linspace(-np.pi / 2, np.pi / 2, 30))],  # a wide arch
        np.vstack([[(-14, 60)], ring(14, centre=(0, 95))[10:30], [(14, 60)]]),  # hangs to both sides of the trunk's tip
    ],
)
def test_an_arching_limb_is_no_crown(limb):
    trunk = [(0, 0), (0, 100)]
    assert contour(strokes(trunk, limb)) is None


def test_an_outline_with_branches_outside_is_no_crown():
    assert contour(strokes(DOME, LEFT, RIGHT)) is not None
    assert contour(strokes(DOME, LEFT, RIGHT, [(0, 50), (120, 110)])) is None


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.svg")), ids=lambda p: p.stem)
def test_no_limb_of_an_example_is_taken_for_a_crown(path):
    branches = [s for s in read_sketch(path).strokes if not s.labelled or s.kind == "branch"]
    for count in range(2, len(branches), 3):
        assert contour([Stroke(s.id, s.points) for s in branches[:count]]) is None


def test_an_outline_alone_is_a_bush_on_a_stem():
    whole = ring(40)
    for lines in ([whole], [whole[10:32], np.roll(whole[:-1], -30, axis=0)[:21]]):
        assert lone_outline(strokes(*lines)) is not None
        graph = graph_of(*lines)
        assert len(graph.crown) == 1 and len(graph.limb_id) == 1 and graph.xy[0] == pytest.approx((0, 40), abs=1)
        assert "The drawing shows a crown and no branch: one stem was put from the ground into it." in graph.warnings[0]


def test_two_stems_whose_tips_meet_are_stems():
    left = np.c_[-30 * np.sin(np.linspace(0, np.pi, 20)), np.linspace(0, 100, 20)]
    assert lone_outline(strokes(left, left * (-1, 1))) is None


def test_a_trunk_drawn_down_and_up_again_is_one():
    graph = graph_of([(-6, 80), (-6, 40), (-6, 0), (6, 0), (6, 40), (6, 80)])
    assert len(graph.limb_id) == 1 and np.abs(graph.xy[:, 0]).max() < 0.5
    assert graph.width[-1] == pytest.approx(12, abs=0.5)
    assert [a.stroke for a in graph.attachments] == ["s0"]


def test_a_fork_drawn_in_one_stroke_stays():
    graph = graph_of([(-50, 80), (0, 0), (50, 80)])
    assert np.ptp(graph.xy[:, 0]) == pytest.approx(100)


QUICK = {
    "palm_tree": [0, 1, 4, 5, 9, 10, 11, 12],
    "tree": [0, 1, 2, 3, 4, 5, 7, 8, 9, 10, 11, 12],
}


@pytest.mark.skipif(not SHARED.exists(), reason="the shared drawings are not beside this checkout")
@pytest.mark.parametrize("name", [f"{kind}_{k:02d}" for kind, rows in QUICK.items() for k in rows])
def test_what_people_draw_in_twenty_seconds_has_a_crown(name):
    graph = sketch_graph(read_sketch(SHARED / "sketches" / "quickdraw" / f"{name}.svg"))
    assert len(graph.crown) == 1 and graph.is_base.sum() >= 1


def test_a_stroke_that_closes_the_opening_is_part_of_the_outline():
    dome = ring(40, opening=0.6)
    sag = np.c_[np.linspace(8, 22, 12), 47 - 4 * np.sin(np.linspace(0, np.pi, 12))]
    found = contour(strokes(dome, LEFT, RIGHT, sag))
    assert set(found.legs) == {0, 3} and len(found.outline) > 128
    graph = graph_of(dome, LEFT, RIGHT, sag)
    assert len(graph.limb_id) == 1 and {role.stroke for role in graph.roles} == {"s0", "s3"}


def test_a_chain_from_one_foot_of_the_trunk_to_the_other_is_a_crown_even_with_a_gap():
    left, right = LEFT * (1, 1.2), np.vstack([RIGHT * (1, 1.2), ring(30, centre=(25, 75))[9:21]])
    top = ring(26, centre=(4, 96))[12:30]
    graph = graph_of(left, right, top)
    assert len(graph.crown) == 1 and len(graph.limb_id) == 1
    assert np.abs(graph.xy[:, 0]).max() < 3
