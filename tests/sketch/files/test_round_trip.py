"""What is written reads back as the same sketch, bit for bit: sketch JSON and SVG."""

import dataclasses
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hands import EXAMPLES
from hypothesis import example, given, settings
from hypothesis import strategies as st

from sketchtree.sketch.files.sketch_json import read_sketch_json, sketch_json
from sketchtree.sketch.files.svg import read_svg
from sketchtree.sketch.files.svg_writer import sketch_svg
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

NUMBER = st.floats(allow_nan=False, allow_infinity=False)
NAME = st.text(st.characters(exclude_categories=["Cs"]), max_size=12)
WORDS = st.sampled_from(["crown", "shadow", "layer1", "layer2", "strokes", "branches", "stroke-1", "a_x5F_b", "a_1_", " ", "\t\n", "<&\"'>", "trunk 3"])
WIDTH = st.none() | st.floats(min_value=0, allow_nan=False, allow_infinity=False)


@st.composite
def strokes(draw, stroke_id):
    count = draw(st.integers(1, 5))
    force = st.none() | st.lists(st.floats(0, 1), min_size=count, max_size=count)
    clock = st.none() | st.lists(NUMBER, min_size=count, max_size=count)
    return Stroke(
        stroke_id,
        draw(st.lists(st.tuples(NUMBER, NUMBER), min_size=count, max_size=count)),
        draw(st.sampled_from(StrokeKind)),
        pressure=draw(force),
        time=draw(clock),
        width=draw(WIDTH),
        layer=draw(st.none() | NAME | WORDS),
        view_deg=draw(st.just(0.0) | NUMBER),
        **{flag: draw(st.booleans()) for flag in ("labelled", "closed", "filled", "wood")},
    )


@st.composite
def sketches(draw):
    ids = draw(st.lists(NAME | WORDS, max_size=5, unique=True))
    page = draw(st.none() | st.tuples(NUMBER, NUMBER, NUMBER, NUMBER))
    return Sketch(tuple(draw(strokes(name)) for name in ids), name="t", units=draw(NAME), view_deg=draw(NUMBER), page=page)


def bits(value):
    """A value that is equal only to its very own bits: -0.0 is not 0.0."""
    if isinstance(value, (float, np.floating, np.ndarray, list, tuple)) and not isinstance(value, str):
        return np.asarray(value, float).tobytes()
    return value


def fields(sketch):
    head = [bits(getattr(sketch, f.name)) for f in dataclasses.fields(sketch) if f.name not in ("strokes", "warnings")]
    return head, [[bits(getattr(s, f.name)) for f in dataclasses.fields(s)] for s in sketch.strokes]


def again_json(sketch):
    return read_sketch_json(sketch_json(sketch).encode(), sketch.name)


def again_svg(sketch):
    return read_svg(sketch_svg(sketch).encode(), sketch.name)


PAIR = Sketch((Stroke("a", [[-0.0, 0.0], [1e-320, 1.7e308], [1e-320, 1.7e308]], closed=True, width=0.0), Stroke("b c", [[0, -0.0]], filled=True)), name="t")


@settings(max_examples=300, deadline=None)
@given(sketches())
@example(PAIR)
def test_every_field_survives_json(sketch):
    assert fields(again_json(sketch)) == fields(sketch)


@settings(max_examples=300, deadline=None)
@given(sketches())
@example(PAIR)
def test_every_field_survives_svg(sketch):
    back = again_svg(sketch)
    assert fields(back) == fields(sketch)
    assert back.warnings == ()


@settings(max_examples=50, deadline=None)
@given(sketches())
def test_what_is_written_twice_is_the_same_text(sketch):
    assert sketch_svg(again_svg(sketch)) == sketch_svg(sketch)
    assert sketch_json(again_json(again_svg(sketch))) == sketch_json(sketch)


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.svg")) + [EXAMPLES / "apple.json"], ids=lambda p: p.name)
def test_our_drawings_survive_svg_and_json_in_turn(path):
    sketch = read_sketch(path)
    assert fields(again_json(again_svg(sketch))) == fields(sketch)


TREE = Sketch(
    (
        Stroke("trunk", [[50, 0], [50, 40.5], [51, 90]], width=4.0, pressure=[1.0, 0.7, 0.2], time=[0.0, 20.0, 45.0], layer="tree"),
        Stroke("outline", [[10, 50], [50, 99], [90, 50]], StrokeKind.CROWN, labelled=True, closed=True),
        Stroke("arm", [[50, 40], [80, 80]], width=2.0, pressure=[1.0, 0.5], layer="tree"),
        Stroke("wall", [[0, 0], [5, 0], [5, 30], [0, 30]], StrokeKind.OBSTACLE, labelled=True, filled=True, closed=True),
    ),
    name="t",
    units="mm",
    view_deg=30.0,
    page=(0.0, 0.0, 100.0, 100.0),
)


def edited(pattern, replacement, count=1):
    text, hits = re.subn(pattern, replacement, sketch_svg(TREE), count=count, flags=re.DOTALL)
    assert hits
    return read_svg(text.encode(), "t")


def by_id(sketch):
    return {stroke.id: stroke for stroke in sketch.strokes}


def test_layers_open_in_inkscape_under_the_names_they_had():
    root = ElementTree.fromstring(sketch_svg(TREE))
    space = "{http://www.inkscape.org/namespaces/inkscape}"
    layers = [g for g in root if g.get(space + "groupmode") == "layer"]
    assert [g.get(space + "label") for g in layers] == ["tree", "crown", "obstacles"]
    assert [len(g) for g in layers] == [2, 1, 1]


def test_a_drawing_program_that_knows_nothing_of_us_sees_the_same_strokes():
    text = re.sub(r" sketchtree:(stroke|sketch)=('[^']*'|\"[^\"]*\")", "", sketch_svg(TREE))
    plain, ours = by_id(read_svg(text.encode(), "t")), by_id(TREE)
    assert plain.keys() == ours.keys()
    for name in ours:
        assert plain[name].points.tolist() == ours[name].points.tolist()
        assert (plain[name].kind, plain[name].filled, plain[name].closed) == (ours[name].kind, ours[name].filled, ours[name].closed)
    assert plain["trunk"].width == 4.0


def test_a_path_redrawn_elsewhere_wins_over_its_record():
    back = edited(r'd="M50.0,-0.0 [^"]*"', 'd="m 1,2 3,4"')
    trunk = by_id(back)["trunk"]
    assert trunk.points.tolist() == [[1, -2], [4, -6]]
    assert trunk.pressure is None and trunk.time is None and trunk.width == 4.0
    assert back.warnings == ("1 stroke has lost pressure and time: other points were drawn since.",)


def test_a_path_moved_by_a_transform_keeps_pressure_and_time():
    trunk = by_id(edited('<path id="trunk"', '<path transform="translate(5 -1) scale(2)" id="trunk"'))["trunk"]
    assert trunk.points.tolist() == [[105, 1], [105, 82], [107, 181]]
    assert trunk.width == 8.0 and trunk.pressure.tolist() == [1.0, 0.7, 0.2] and trunk.time.tolist() == [0.0, 20.0, 45.0]


def test_a_width_set_elsewhere_wins():
    assert by_id(edited('stroke-width="4.0"', 'stroke-width="9"'))["trunk"].width == 9.0


def test_a_stroke_put_into_another_layer_is_what_that_layer_says():
    back = edited(r'(<path id="arm".*?/>)\n(.*?inkscape:label="crown"[^>]*>)', r"\2\1")
    arm = by_id(back)["arm"]
    assert arm.kind is StrokeKind.CROWN and arm.labelled and arm.layer == "crown"


def test_a_stroke_renamed_elsewhere_has_its_new_name_and_a_copy_its_own():
    assert by_id(edited('id="arm"', 'id="bough"')).keys() == {"trunk", "outline", "bough", "wall"}
    back = edited(r'(<path id=)"arm"(.*?/>)', r'\1"arm"\2\1"path9"\2')
    assert [s.id for s in back.strokes] == ["trunk", "outline", "arm", "path9", "wall"]


def test_a_stroke_of_a_turned_page_stays_so_and_others_say_nothing_of_it():
    turned = Sketch((Stroke("trunk", [[0, 0], [0, 9]]), Stroke("arm", [[0, 4], [3, 6]], view_deg=90)), name="t")
    text = sketch_svg(turned)
    assert [stroke.view_deg for stroke in read_svg(text.encode(), "t").strokes] == [0.0, 90.0]
    assert text.count("view_deg") == 2, "of the sketch and of the arm"
    redrawn = text.replace('d="M0.0,-4.0 3.0,-6.0"', 'd="M0,-4 5,-8"')
    assert redrawn != text and read_svg(redrawn.encode(), "t").strokes[1].view_deg == 90.0


def test_strokes_drawn_elsewhere_follow_ours():
    back = edited("</svg>", '<path id="new" d="M1 1L2 2" stroke="red"/></svg>')
    assert [s.id for s in back.strokes] == ["trunk", "outline", "arm", "wall", "new"]


def test_a_page_resized_elsewhere_wins():
    assert edited('viewBox="[^"]*"', 'viewBox="0 -200 100 200"').page == (0.0, 0.0, 100.0, 200.0)


@pytest.mark.parametrize(
    "spoilt",
    ["{", "[]", "{}", '{"row": "x"}', "[" * 9000, '{"row": 0, "id": "a", "kind": "leaf", "as": {"id": "", "group": "", "pen": ""}}',
     '{"row": 0, "id": "a", "kind": "branch", "view_deg": "x", "as": {"id": "", "group": "", "pen": ""}}'],
)  # fmt: skip
def test_a_spoilt_record_is_left_out_and_counted(spoilt):
    text = spoilt.replace('"', "&quot;")
    back = edited("sketchtree:stroke=('[^']*'|\"[^\"]*\")", f'sketchtree:stroke="{text}"')
    assert len(back) == 4 and back.warnings == ("A spoilt record was left out.",)
    whole = edited("sketchtree:sketch=('[^']*'|\"[^\"]*\")", f'sketchtree:sketch="{text}"')
    assert whole.units == "px" and whole.warnings == ("A spoilt record was left out.",)
