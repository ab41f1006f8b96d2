import json
from pathlib import Path

import numpy as np
import pytest
import shapely
from hands import EXAMPLES, SHARED, farthest, moved, parents, polyline_distance, redraw

from sketchtree.axes import NULL
from sketchtree.errors import OptionError, SketchError
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.joining.lines import unit
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.files.sketch_json import read_sketch_json
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

AWKWARD = json.loads((Path(__file__).resolve().parents[1] / "data" / "awkward_sketches.json").read_text())
DRAWN = sorted(EXAMPLES.glob("*.svg")) + [EXAMPLES / "apple.json"]
LIMBS = {"oak": 26, "oak_50": 49, "willow": 20, "poplar": 23, "spruce": 39, "palm": 11, "apple": 17, "curvy": 19}


def tree_of(*strokes, **options):
    return sketch_graph(Sketch(tuple(Stroke(f"s{k}", points) for k, points in enumerate(strokes))), **options)


def check(graph):
    assert (graph.parent < np.arange(len(graph))).all()
    assert np.isfinite(graph.xy).all() and np.isfinite(graph.curve_points).all()
    length = np.hypot(*(graph.xy - graph.start).T)[~graph.is_base]
    assert (length > 0).all()
    inner = ~graph.is_base
    same_limb = graph.limb[graph.parent[inner]] == graph.limb[inner]
    assert (same_limb | (np.flatnonzero(inner) == graph.limb_first[graph.limb[inner]])).all(), "a limb is a chain"
    assert len(np.unique(graph.limb_id)) == len(graph.limb_id)
    assert (np.bincount(graph.limb, minlength=len(graph.limb_id)) > 0).all()
    drawn = {a.stroke for a in graph.attachments}
    assert all(graph.stroke_ids[row] in drawn for row in graph.stroke)


@pytest.mark.parametrize("case", AWKWARD, ids=[case["name"] for case in AWKWARD])
def test_an_awkward_sketch_gives_a_sound_tree_or_a_clear_error(case):
    sketch = read_sketch_json(json.dumps({"sketchtree": 1, "y": "up", "strokes": case["strokes"]}).encode(), case["name"])
    if case["expect"] == "error":
        with pytest.raises(SketchError, match="no branch strokes") as error:
            sketch_graph(sketch)
        assert error.value.remedy
    else:
        check(sketch_graph(sketch))


@pytest.mark.parametrize("path", DRAWN, ids=lambda p: p.stem)
def test_every_example_is_one_tree_of_the_limbs_that_were_drawn(path):
    graph = sketch_graph(read_sketch(path))
    check(graph)
    assert graph.is_base.sum() == 1 and len(graph.limb_id) == LIMBS[path.stem]
    assert len(graph.crown) == (path.stem in ("oak", "oak_50", "poplar", "apple"))
    assert graph.warnings == (("A hidden shape was left out.",) if path.stem == "palm" else ())  # its sand


@pytest.mark.parametrize("path", DRAWN, ids=lambda p: p.stem)
def test_reading_moves_no_drawn_point_far(path):
    sketch = read_sketch(path)
    graph = sketch_graph(sketch)
    curves = shapely.union_all([shapely.LineString(graph.curve(row)) for row in np.flatnonzero(~graph.is_base)])
    drawn = np.concatenate([s.points for s in sketch.strokes if s.kind == StrokeKind.BRANCH and s.id != "outline"])
    gap = shapely.distance(shapely.points(drawn), curves) / graph.height
    assert gap.mean() < 0.0015 and gap.max() < 0.015


@pytest.mark.parametrize("path", DRAWN, ids=lambda p: p.stem)
def test_neither_order_nor_direction_of_the_strokes_changes_the_tree(path):
    sketch = read_sketch(path)
    graph = sketch_graph(sketch)
    order = np.random.default_rng(1).permutation(len(sketch))
    other = sketch_graph(Sketch(tuple(moved(sketch.strokes[k], sketch.strokes[k].points[::-1]) for k in order)))
    assert parents(other) == parents(graph)
    assert np.array_equal(other.xy, graph.xy) or farthest(other, graph) < 1e-9


@pytest.mark.parametrize("path", DRAWN, ids=lambda p: p.stem)
def test_a_mirror_image_gives_the_mirrored_tree(path):
    sketch = read_sketch(path)
    graph = sketch_graph(sketch)
    other = sketch_graph(redraw(sketch, lambda stroke: [moved(stroke, stroke.points * (-1, 1))]))
    assert parents(other) == parents(graph)
    assert other.xy * (-1, 1) == pytest.approx(graph.xy, abs=1e-9 * graph.height)


@pytest.mark.parametrize("scale", [1e-4, 1.0, 1e5])
def test_shift_and_scale_change_nothing_else(scale):
    sketch = read_sketch(EXAMPLES / "oak.svg")
    graph = sketch_graph(sketch)
    other = sketch_graph(
        redraw(sketch, lambda s: [Stroke(s.id, s.points * scale + scale * np.array([1234, -77]), s.kind, labelled=s.labelled, width=s.width * scale)])
    )
    assert parents(other) == parents(graph) and len(other) == len(graph)
    assert (other.xy - scale * np.array([1234, -77])) / scale == pytest.approx(graph.xy, abs=1e-6 * graph.height)


def test_the_same_sketch_gives_the_same_graph():
    first, second = (sketch_graph(read_sketch(EXAMPLES / "oak_50.svg")) for _ in range(2))
    assert np.array_equal(first.xy, second.xy) and first.attachments == second.attachments


def shake(kind, height):
    rng = np.random.default_rng(5)

    def doubled(stroke):
        return [moved(stroke, np.repeat(stroke.points, 2, axis=0))]

    def repeated(stroke):
        again = moved(stroke, stroke.points + rng.normal(0, 0.001 * height, 2), "~")
        return [stroke, again] if rng.random() < 0.3 and not stroke.labelled else [stroke]

    def gaps(stroke):
        return [moved(stroke, stroke.points + rng.normal(0, 0.0025 * height, 2))]

    def overshoots(stroke):
        past = stroke.points[0] + unit(stroke.points[0] - stroke.points[1]) * 0.006 * height
        return [stroke if stroke.labelled or stroke.id in ("trunk", "stem") else moved(stroke, np.vstack([past, stroke.points]))]

    def tremor(stroke):
        return [stroke if stroke.labelled else moved(stroke, stroke.points + rng.normal(0, 0.0008 * height, stroke.points.shape))]

    return {"doubled": doubled, "repeated": repeated, "gaps": gaps, "overshoots": overshoots, "tremor": tremor}[kind]


@pytest.mark.parametrize("name", ["willow.svg", "poplar.svg", "palm.svg", "apple.json"])
@pytest.mark.parametrize("kind", ["doubled", "repeated"])
def test_drawing_points_or_strokes_twice_moves_no_limb(name, kind):
    sketch = read_sketch(EXAMPLES / name)
    graph = sketch_graph(sketch)
    assert parents(sketch_graph(redraw(sketch, shake(kind, graph.height)))) == parents(graph)


@pytest.mark.parametrize("name", ["oak", "oak_50", "spruce", "curvy"])
@pytest.mark.parametrize("kind", ["doubled", "repeated", "gaps", "overshoots", "tremor"])
def test_a_shaky_hand_draws_the_same_tree(name, kind):
    sketch = read_sketch(EXAMPLES / f"{name}.svg")
    graph = sketch_graph(sketch)
    shaken = sketch_graph(redraw(sketch, shake(kind, graph.height)))
    assert parents(shaken) == parents(graph)
    assert polyline_distance(shaken, graph) < 0.012


def test_a_crossing_is_no_junction():
    graph = tree_of([(0, 0), (0, 100)], [(0, 20), (60, 80)], [(0, 80), (70, 50)])
    assert [a.parent for a in graph.attachments] == [None, "s0", "s0"]
    assert len(graph) == 1 + 3 + 2


def test_strokes_end_to_end_are_one_limb_and_marked():
    graph = tree_of([(0, 0), (0, 40)], [(5, 99), (0, 41)], [(0, 40), (50, 60)])
    assert len(graph.limb_id) == 2 and graph.limb_order.tolist() == [0, 1]
    assert graph.joined.sum() == 1 and graph.xy[graph.joined].tolist() == [[5, 99]]


def test_an_overshoot_is_trimmed_and_a_gap_is_bridged():
    graph = tree_of([(0, 0), (0, 100)], [(-1, 49), (30, 80)], [(0.8, 60), (30, 99)])
    feet = graph.xy[graph.parent[graph.limb_first[graph.limb_order == 1]]]
    assert feet[:, 0] == pytest.approx([0, 0], abs=1e-9)
    assert np.abs(graph.curve_points).size == 0


def test_a_far_stroke_is_attached_and_reported():
    graph = tree_of([(0, 0), (0, 100)], [(60, 70), (90, 90)])
    assert graph.attachments[1].parent == "s0" and graph.attachments[1].gap > 50
    assert "Stroke s1 starts 60 %" in graph.warnings[0] and "far off" in graph.attachments[1].reason


def test_attachments_hold_the_next_best_parents():
    graph = tree_of([(0, 0), (0, 100)], [(0, 50), (40, 80)], [(20, 65), (30, 95)])
    last = graph.attachments[2]
    assert last.parent == "s1" and last.alternatives[0][0] == "s0" and last.alternatives[0][1] > last.cost
    assert last.point == pytest.approx((20, 65)) and last.gap == pytest.approx(0, abs=1e-9)


def test_stems_from_one_foot_are_stems_of_one_tree():
    graph = tree_of([(0, 0), (-30, 80)], [(0, 0), (0, 90)], [(0, 0), (30, 80)])
    assert graph.is_base.sum() == 3 and (graph.tree == 0).all() and (graph.limb_parent == NULL).all()


def test_two_trees_are_told_apart():
    graph = tree_of([(0, 0), (0, 90)], [(0, 50), (30, 80)], [(150, 0), (150, 80)], [(150, 50), (180, 70)])
    assert graph.is_base.sum() == 2 and sorted(set(graph.tree.tolist())) == [0, 1]


def test_a_hanging_branch_lower_than_the_foot_is_no_stem():
    graph = tree_of([(0, 0), (0, 100)], [(0, 90), (30, 95), (50, 70), (52, -3)])
    assert graph.xy[graph.is_base].tolist() == [[0, 0]]


def test_widths_count_where_they_differ():
    strokes = [Stroke("a", [(0, 0), (0, 100)], width=6.0), Stroke("b", [(0, 50), (40, 80)], width=2.0)]
    graph = sketch_graph(Sketch(tuple(strokes)))
    assert sorted(set(graph.width.tolist())) == [2.0, 6.0]
    alike = sketch_graph(Sketch((strokes[0], moved(strokes[0], np.array([(0, 50), (40, 80)]), "2"))))
    assert np.isnan(alike.width).all()


def test_pressure_is_width():
    stroke = Stroke("a", [(0, 0), (0, 100)], width=4.0, pressure=[1.0, 0.25])
    assert sketch_graph(Sketch((stroke,))).width.tolist() == [4.0, 1.0]


def test_the_crown_can_be_left_out():
    sketch = read_sketch(EXAMPLES / "poplar.svg")
    graph = sketch_graph(sketch, crown="off")
    assert graph.crown == () and len(graph.limb_id) == LIMBS["poplar"]
    with pytest.raises(OptionError, match="'auto' or 'off' was expected"):
        sketch_graph(sketch, crown="maybe")


def test_obstacles_are_kept_apart():
    box = Stroke("o", [(50, 0), (70, 0), (70, 40), (50, 40)], StrokeKind.OBSTACLE, labelled=True, closed=True)
    graph = sketch_graph(Sketch((Stroke("t", [(0, 0), (0, 100)]), box)))
    assert len(graph.obstacles) == 1 and graph.segment_count == 1


def test_strokes_scattered_in_mid_air_hang_on_one_trunk():
    rng = np.random.default_rng(0)
    foot = rng.uniform(-500, 500, (800, 2)) + (0, 700)
    strokes = [[(0, 0), (0, 1000)]] + [[p, p + rng.normal(0, 30, 2) + (0, 20)] for p in foot]
    graph = tree_of(*strokes)
    assert graph.is_base.sum() == 1
    check(graph)


@pytest.mark.skipif(not SHARED.exists(), reason="the shared drawings are not beside this checkout")
@pytest.mark.parametrize("path", sorted(SHARED.glob("sketches/**/*.svg")), ids=lambda p: p.stem)
def test_a_shared_drawing_gives_a_sound_tree_or_a_clear_error(path):
    try:
        graph = sketch_graph(read_sketch(path))
    except SketchError as error:
        assert "no branch strokes" in str(error)
    else:
        check(graph)


@pytest.mark.skipif(not SHARED.exists(), reason="the shared cases are not beside this checkout")
@pytest.mark.parametrize("path", sorted(SHARED.glob("sketch_cases/*.json")), ids=lambda p: p.stem)
def test_limbs_of_known_trees_hang_where_they_should(path):
    truth = json.loads(path.read_text())
    node, parent, stroke = np.array(truth["nodes"])[:, :2], np.array(truth["parent"]), np.array(truth["stroke"])
    point = {a.stroke: a.point for a in sketch_graph(read_sketch(path.with_suffix(".svg"))).attachments}
    gaps = []
    for k in sorted(set(stroke.tolist()) - {0}):
        foot = node[parent[np.flatnonzero(stroke == k)[0]]]
        gaps.append(np.hypot(*(foot - point[f"s{k}"])) / truth["height"])
    assert np.mean(np.array(gaps) < 0.012) >= 0.9
