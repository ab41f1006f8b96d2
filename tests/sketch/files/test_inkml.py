import numpy as np
import pytest
from hands import SHARED

from sketchtree.errors import SketchError
from sketchtree.sketch.files.inkml import read_inkml
from sketchtree.sketch.files.inkml_values import trace_values
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import StrokeKind

TRACE = "<trace>1 2, 3 4, 5 9</trace>"
FORMAT = "<traceFormat>{}</traceFormat>"
X, Y = '<channel name="X"/>', '<channel name="Y"/>'


def read(body: str, **options):
    return read_inkml(f'<ink xmlns="http://www.w3.org/2003/InkML">{body}</ink>'.encode(), "t.inkml", **options)


def only(body: str):
    (stroke,) = read(body).strokes
    return stroke


def test_a_trace_is_a_stroke_y_up():
    stroke = only(TRACE)
    assert stroke.points.tolist() == [[1, -2], [3, -4], [5, -9]]
    assert (stroke.id, stroke.kind, stroke.width, stroke.pressure, stroke.time) == ("stroke-1", StrokeKind.BRANCH, None, None, None)


def test_a_prefixed_namespace_and_none_read_alike():
    for text in ('<ink><trace>1 2,3 4</trace></ink>', '<i:ink xmlns:i="http://www.w3.org/2003/InkML"><i:trace>1 2,3 4</i:trace></i:ink>'):
        assert len(read_inkml(text.encode(), "t").strokes[0].points) == 2


ENCODED = [
    ("1 2, 3 4,", [[1, 2], [3, 4]]),
    ("1125 18432,'23'43,\"7\"-8,3-5,7 -3", [[1125, 18432], [1148, 18475], [1178, 18510], [1211, 18540], [1251, 18567]]),
    ("1 1,'2'3,*4,!0*", [[1, 1], [3, 4], [5, 8], [0, 12]]),
    ("0 0,'1\"1,* *,**", [[0, 0], [1, 1], [2, 3], [3, 6]]),
    ("#FF -#10,1e2 .5", [[255, -16], [100, 0.5]]),
    ("1 2,? 3,5 6", [[1, 2], [np.nan, 3], [5, 6]]),
    ("+1-2, - 3 4", [[1, -2], [-3, 4]]),
    ("1,2 3,4 5,6", [[1, 2], [3, 4], [5, 6]]),
    ("", []),
    (" \n ", []),
]


@pytest.mark.parametrize(("text", "points"), ENCODED)
def test_every_encoding_of_values_is_read(text, points):
    assert np.array_equal(trace_values(text, 2), np.array(points, float).reshape(-1, 2), equal_nan=True)


def test_prefixes_hold_until_the_next_one_and_wildcards_repeat_what_they_repeat():
    rng = np.random.default_rng(3)
    points = rng.integers(-500, 500, (40, 2))
    speed = np.diff(points, axis=0)
    words = [f"{x} {y}" for x, y in points[:2]]
    words += [f"'{x}'{y}" if k == 0 else f"{x} {y}" for k, (x, y) in enumerate(speed[1:20])]
    change = np.diff(speed, axis=0)[19:]
    words += [f'"{x}"{y}' if k == 0 else f"{x} {y}" for k, (x, y) in enumerate(change)]
    assert np.array_equal(trace_values(",".join(words), 2), points)


def test_intermittent_channels_may_be_left_away():
    found = trace_values("1 2, 3 4 T, 5 6 F #A", 2, 2)
    assert np.array_equal(found, [[1, 2, np.nan, np.nan], [3, 4, 1, np.nan], [5, 6, 0, 10]], equal_nan=True)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1 2, 3", "point 2 of its trace has 1 values for 2 channels"),
        ("1 2 3", "point 1 of its trace has 3 values for 2 channels"),
        ("1 2, a b", "its trace has 'a b', which is no value of InkML"),
        ("1 2,,3 4", "point 2 of its trace has 0 values"),
        ("1 nan", "its trace has 'nan', which is no value"),
    ],
)
def test_text_that_is_no_trace_is_refused(text, message):
    with pytest.raises(ValueError, match=message):
        trace_values(text, 2)
    with pytest.raises(SketchError, match=f"^Stroke a: in t.inkml, {message}.*Draw that stroke again") as error:
        read(FORMAT.format(X + Y) + f'<trace xml:id="a">{text}</trace>')
    assert error.value.stroke == "a"


def test_an_infinite_number_is_named():
    with pytest.raises(SketchError, match="Stroke stroke-1: in t.inkml, it has a coordinate that is not a finite number"):
        read("<trace>1 2, 1e999 3</trace>")


def test_force_is_pressure_between_its_bounds():
    force = FORMAT.format(X + Y + '<channel name="F" min="100" max="300"/>')
    assert only(force + "<trace>1 2 100,1 3 200,1 4 999</trace>").pressure.tolist() == [0, 0.5, 1]


@pytest.mark.parametrize(("ignored", "pressed"), [("1", False), ("true", False), ("0", True), ("false", True)])
def test_a_brush_may_ignore_the_force(ignored, pressed):
    brush = f'<context><brush><brushProperty name="ignorePressure" value="{ignored}"/></brush></context>'
    stroke = only(FORMAT.format(X + Y + '<channel name="F" max="9"/>') + brush + "<trace>1 2 3,4 5 6</trace>")
    assert (stroke.pressure is not None) == pressed


def test_force_without_a_bound_is_a_part_of_the_largest_of_the_file():
    force = FORMAT.format(X + Y + '<channel name="F"/>')
    strokes = read(force + "<trace>1 2 50,1 3 100</trace><trace>1 2 200,1 3 200</trace>").strokes
    assert [s.pressure.tolist() for s in strokes] == [[0.25, 0.5], [1, 1]]
    assert only(force + "<trace>1 2 0.5,1 3 0.25</trace>").pressure.tolist() == [0.5, 0.25]


def test_channels_may_stand_in_any_order_and_others_are_skipped():
    text = FORMAT.format('<channel name="OTx"/>' + Y + '<channel name="T"/>' + X)
    stroke = only(text + "<trace>7 2 10 1,8 4 20 3</trace>")
    assert stroke.points.tolist() == [[1, -2], [3, -4]] and stroke.time.tolist() == [0, 10]


TIMES = [
    ('<channel name="T"/>', "", [0, 5]),
    ('<channel name="T" units="s"/>', "", [0, 5000]),
    ('<channel name="T" units="us"/>', "", [0, 0.005]),
]


@pytest.mark.parametrize(("channel", "attributes", "times"), TIMES)
def test_times_are_milliseconds_from_the_first(channel, attributes, times):
    stroke = only(FORMAT.format(X + Y + channel) + f"<trace {attributes}>1 2 100,3 4 105</trace>")
    assert stroke.time == pytest.approx(np.array(times))


def test_a_trace_counts_from_its_own_offset_unless_its_clock_is_absolute():
    body = '<trace timeOffset="1000">0 0 0,1 1 10</trace><trace timeOffset="2000">0 0 0,1 1 10</trace>'
    assert [s.time.tolist() for s in read(FORMAT.format(X + Y + '<channel name="T"/>') + body).strokes] == [[0, 10], [1000, 1010]]
    stamped = FORMAT.format(X + Y + '<channel name="T" respectTo="#ts"/>')
    assert [s.time.tolist() for s in read(stamped + body).strokes] == [[0, 10], [0, 10]]


def test_an_offset_and_a_duration_are_spread_over_the_trace():
    strokes = read('<trace timeOffset="100" duration="20">0 0,1 1,2 2</trace><trace timeOffset="300" duration="1">0 0,1 1</trace>').strokes
    assert [s.time.tolist() for s in strokes] == [[0, 10, 20], [200, 201]]


def test_time_stamps_of_contexts_set_the_clock():
    body = (
        '<definitions><timestamp xml:id="a" time="5000"/><timestamp xml:id="b" timestampRef="#a" timeOffset="700"/>'
        '<timestamp xml:id="c" timeString="1970-01-01T00:00:06"/>'
        '<context xml:id="c1" timestampRef="#a"/><context xml:id="c2" timestampRef="#b"/><context xml:id="c3" timestampRef="#c"/></definitions>'
    )
    traces = "".join(f'<trace contextRef="#c{k}" timeOffset="0" duration="1">0 0,1 1</trace>' for k in (1, 2, 3))
    assert [s.time[0] for s in read(body + traces).strokes] == [0, 700, 1000]


OFFICE = """<definitions><context xml:id="ctx0"><inkSource xml:id="src"><traceFormat>
<channel name="X" type="integer" max="9600" units="cm"/><channel name="Y" type="integer" max="7200" units="cm"/>
<channel name="F" type="integer" max="256" units="dev"/></traceFormat><channelProperties>
<channelProperty channel="X" name="resolution" value="400" units="1/cm"/><channelProperty channel="Y" name="resolution" value="{}" units="1/cm"/>
</channelProperties></inkSource></context><brush xml:id="br0"><brushProperty name="width" value="0.05" units="cm"/></brush>
<brush xml:id="br1" brushRef="#br0"/></definitions>
<trace contextRef="#ctx0" brushRef="#{}">100 200 0, 300 400 128</trace>"""


@pytest.mark.parametrize("brush", ["br0", "br1"])
def test_a_brush_is_as_wide_as_the_resolution_makes_it(brush):
    stroke = only(OFFICE.format(400, brush))
    assert stroke.width == pytest.approx(20) and stroke.pressure.tolist() == [0, 0.5]


def test_axes_of_unequal_resolution_are_made_alike():
    assert only(OFFICE.format(800, "br0")).points.tolist() == [[100, -100], [300, -200]]


def test_units_and_brushes_in_known_units_agree():
    units = FORMAT.format('<channel name="X" units="mm"/><channel name="Y" units="mm"/>')
    sketch = read('<definitions><brush xml:id="b"><brushProperty name="width" value="0.1" units="cm"/></brush></definitions>' + units
                  + '<trace brushRef="#b">1 2,3 4</trace>')  # fmt: skip
    assert sketch.units == "mm" and sketch.strokes[0].width == pytest.approx(1)


def test_an_axis_that_grows_the_other_way_is_turned():
    flipped = FORMAT.format('<channel name="X" orientation="-ve"/><channel name="Y" orientation="-ve"/>')
    assert only(flipped + "<trace>1 2,3 4</trace>").points.tolist() == [[-1, 2], [-3, 4]]


def test_a_context_holds_for_the_traces_after_it_and_one_format_for_the_whole_file():
    wide = '<context><brush><brushProperty name="width" value="{}"/></brush></context>'
    assert [s.width for s in read(TRACE + wide.format(2) + TRACE + wide.format(3) + TRACE).strokes] == [None, 2, 3]
    late = "<trace>1 2 0.5,3 4 1</trace><definitions>" + FORMAT.format(X + Y + '<channel name="F" max="1"/>') + "</definitions>"
    assert only(late).pressure.tolist() == [0.5, 1]


def test_two_formats_by_reference():
    body = f'<definitions><traceFormat xml:id="a">{X + Y}</traceFormat><traceFormat xml:id="b">{Y + X}</traceFormat></definitions>'
    body += '<trace>1 2,3 4</trace><traceGroup contextRef="#c"><trace>1 2,3 4</trace></traceGroup>'
    body += '<definitions><context xml:id="c" traceFormatRef="#b"/></definitions>'
    assert [s.points[0].tolist() for s in read(body).strokes] == [[1, -2], [2, -1]]


def test_unnamed_channels_are_left_out_and_said():
    sketch = read("<trace>1 2 50,3 4 60</trace>")
    assert sketch.strokes[0].points.tolist() == [[1, -2], [3, -4]] and sketch.warnings == ("1 unnamed channel was left out.",)


LABELLED = {
    "annotation": '<trace><annotation type="truth">crown</annotation>1 2,3 4</trace>',
    "id": '<trace xml:id="crown">1 2,3 4</trace>',
    "group": f'<traceGroup><annotation type="label">Tree crown</annotation><traceGroup>{TRACE}</traceGroup></traceGroup>',
    "XML": f"<traceGroup><annotationXML><tree>crown</tree></annotationXML>{TRACE}</traceGroup>",
    "view": '<trace xml:id="t1">1 2,3 4</trace><traceGroup><annotation>crown</annotation><traceView traceDataRef="#t1"/></traceGroup>',
    "bare": '<trace id="t1">1 2,3 4</trace><traceView traceDataRef="t1"><annotation>crown</annotation></traceView>',
    "closest": f'<traceGroup><annotation>trunk</annotation><traceGroup><annotation>crown</annotation>{TRACE}</traceGroup></traceGroup>',
}


@pytest.mark.parametrize("way", LABELLED)
def test_an_annotation_makes_a_crown(way):
    stroke = only(LABELLED[way])
    assert (stroke.kind, stroke.labelled) == (StrokeKind.CROWN, True)


def test_a_long_annotation_is_a_note_and_a_group_is_a_layer():
    stroke = only(f"<traceGroup><annotation>an oak with a wide crown</annotation>{TRACE}</traceGroup>")
    assert (stroke.kind, stroke.layer) == (StrokeKind.BRANCH, None)
    assert only(f"<traceGroup><annotation>Ink 1</annotation>{TRACE}</traceGroup>").layer == "Ink 1"
    assert only(f'<traceGroup xml:id="group-7">{TRACE}</traceGroup>').layer is None
    assert only("<traceGroup><annotation>Ink 1</annotation><trace><annotation>shadow</annotation>1 2,3 4</trace></traceGroup>").layer == "shadow"


def test_what_is_defined_is_drawn_where_a_view_shows_it():
    group = '<traceGroup xml:id="g"><trace>9 9,8 8</trace><trace>7 7,6 6</trace></traceGroup>'
    defined = f'<definitions><trace xml:id="a">0 0,1 1,2 2,3 3</trace>{group}</definitions>'
    assert read(defined).strokes == ()
    assert only(defined + '<traceView traceDataRef="#a"/>').points[:, 0].tolist() == [0, 1, 2, 3]
    assert only(defined + '<traceView traceDataRef="#a" from="2" to="3"/>').points[:, 0].tolist() == [1, 2]
    assert len(read(defined + '<traceView traceDataRef="#g"/>')) == 2
    assert only(defined + '<traceView traceDataRef="#g" from="2" to="2"/>').points[0].tolist() == [7, -7]
    assert only(defined + '<traceView traceDataRef="#g" from="1:2" to="1:2"/>').points.tolist() == [[8, -8]]
    both = read(defined + '<traceView><traceView traceDataRef="#a"/><traceView traceDataRef="#g" from="1" to="1"/></traceView>')
    assert [s.id for s in both.strokes] == ["a", "stroke-2"]


def test_pieces_of_one_trace_are_joined():
    pieces = '<trace xml:id="a" continuation="begin">0 0,1 1</trace><trace xml:id="b" continuation="middle" priorTrace="#a">2 2</trace>'
    sketch = read(pieces + '<trace>9 9,8 8</trace><trace continuation="end" priorTrace="#b">3 3</trace>')
    assert [s.points[:, 0].tolist() for s in sketch.strokes] == [[0, 1, 2, 3], [9, 8]] and sketch.strokes[0].id == "a"


def test_the_lifted_pen_erasers_and_empty_traces_are_left_out_and_counted():
    brush = '<definitions><brush xml:id="eraser1"/></definitions>'
    sketch = read(brush + '<trace type="penUp">0 0,1 1</trace><trace brushRef="#eraser1">0 0,1 1</trace><trace/><trace> </trace>' + TRACE)
    assert len(sketch) == 1
    assert sketch.warnings == ("2 empty traces were left out.", "1 eraser trace was left out.", "1 trace of a lifted pen was left out.")


def test_a_canvas_transform_is_not_applied_and_said():
    sketch = read('<context><canvasTransform><mapping type="affine"/></canvasTransform></context>' + TRACE)
    assert sketch.warnings == ("Its canvas transforms are not applied: the ink is read as the pen drew it.",)


def test_points_of_unknown_place_are_passed_over():
    assert only("<trace>1 2,? 3,5 6</trace>").points.tolist() == [[1, -2], [5, -6]]


def test_comments_between_values_are_passed_over():
    assert only("<trace>1 2,<!-- here -->3 4</trace>").points.tolist() == [[1, -2], [3, -4]]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (FORMAT.format('<channel name="X"/>') + TRACE, "a trace format has the channels X; X and Y were expected"),
        ("<traceGroup>" * 200 + TRACE + "</traceGroup>" * 200, None),
        ('<definitions><traceView xml:id="a" traceDataRef="#a"/></definitions><traceView traceDataRef="#a"/>', "nested more than 256 deep"),
    ],
)
def test_a_file_that_makes_no_sense_is_refused(body, message):
    if message is None:
        assert len(read(body)) == 1
        return
    with pytest.raises(SketchError, match=f"in t.inkml, .*{message}.*Export the ink again."):
        read(body)


def test_a_small_file_cannot_show_a_large_one_without_end():
    group = '<traceGroup xml:id="g">' + "<trace>1 1,2 2</trace>" * 1000 + "</traceGroup>"
    views = '<traceView traceDataRef="#g"/>' * 200
    with pytest.raises(SketchError, match="nested more than 256 deep, or repeated too often"):
        read(group + views, max_strokes=2000)
    with pytest.raises(SketchError, match="more than 2000"):
        read(f"<definitions>{group}</definitions>{views}", max_strokes=2000)
    line = ",".join(["1 1"] * 20_000)
    with pytest.raises(SketchError, match="t.inkml draws more than 5 million points. Simplify its lines"):
        read(f'<definitions><trace xml:id="a">{line}</trace></definitions>' + '<traceView traceDataRef="#a"/>' * 251)


def test_ids_are_unique_and_missing_ones_are_numbered():
    assert [s.id for s in read('<trace xml:id="a">1 1,2 2</trace>' * 2 + TRACE).strokes] == ["a", "a-2", "stroke-3"]


def test_another_root_and_too_many_strokes_are_refused():
    with pytest.raises(SketchError, match="root is <html>, not <ink>"):
        read_inkml(b"<html/>", "t")
    with pytest.raises(SketchError, match="holds 3 strokes, more than 2.*--max-strokes"):
        read(TRACE * 3, max_strokes=2)


@pytest.mark.skipif(not SHARED.exists(), reason="the shared drawings are not beside this checkout")
def test_ink_of_a_real_tablet_is_read_trace_by_trace():
    sketch = read_sketch(SHARED / "sketches/pen_formats/seshat_exp.inkml")
    assert [s.id for s in sketch.strokes] == [str(k) for k in range(16)] and sketch.warnings == ()
    assert sketch.strokes[0].points[[0, -1]].tolist() == [[8128, -3400], [8076, -5134]]
