import base64
import json
import struct
import zlib

import numpy as np
import pytest
from hands import SHARED

from sketchtree.errors import SketchError
from sketchtree.sketch.files.excalidraw import FREEDRAW, read_excalidraw
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import StrokeKind

LINE = {"id": "a", "type": "line", "x": 10, "y": 20, "width": 4, "height": 8, "points": [[0, 0], [4, 8]], "strokeWidth": 3}
BOX = {"id": "b", "type": "rectangle", "x": 0, "y": 0, "width": 4, "height": 2}
TEXT = {"id": "t", "type": "text", "x": 0, "y": 0, "text": "crown"}


def scene(*elements) -> bytes:
    return json.dumps({"type": "excalidraw", "version": 2, "elements": elements}).encode()


def read(*elements, **options):
    return read_excalidraw(scene(*elements), "t.excalidraw", **options)


def only(*elements):
    (stroke,) = read(*elements).strokes
    return stroke


def test_points_are_offset_by_the_element_and_y_is_up():
    stroke = only(LINE)
    assert stroke.points.tolist() == [[10, -20], [14, -28]]
    assert (stroke.id, stroke.width, stroke.closed, stroke.filled, stroke.pressure) == ("a", 3, False, False, None)


def test_angle_turns_clockwise_about_the_middle_of_the_bounding_box():
    stroke = only(LINE | {"angle": np.pi / 2})
    assert stroke.points == pytest.approx(np.array([[16, -22], [8, -26]]))


@pytest.mark.parametrize("kind", ["rectangle", "diamond", "ellipse"])
def test_a_turn_moves_the_middle_of_no_shape(kind):
    plain, turned = (only(BOX | {"type": kind, "angle": angle}).points for angle in (0.0, 1.0))
    assert (turned.min(0) + turned.max(0)) / 2 == pytest.approx((plain.min(0) + plain.max(0)) / 2, abs=0.02)


def test_a_round_line_passes_through_its_points_and_is_smooth():
    points = np.array([[0, 0], [10, 20], [30, 20], [50, 0.0]])
    drawn = only(LINE | {"points": points.tolist(), "width": 50, "height": 20, "roundness": {"type": 2}}).points * (1, -1) - (10, 20)
    assert all(np.hypot(*(drawn - p).T).min() < 1e-9 for p in points)
    steps = np.diff(drawn, axis=0)
    turns = np.arccos(np.clip(np.sum(steps[1:] * steps[:-1], 1) / (np.hypot(*steps[1:].T) * np.hypot(*steps[:-1].T)), -1, 1))
    assert len(drawn) > 20 and turns.max() < 0.3


def test_a_round_line_is_the_spline_with_doubled_ends():
    p = np.array([[0, 0], [6, 12], [18, 0.0]])
    drawn = only(LINE | {"points": p.tolist(), "width": 600, "height": 600, "x": 0, "y": 0, "roundness": {"type": 2}}).points
    middle = (p[0] + 3 * (p[0] + (p[1] - p[0]) / 6) + 3 * (p[1] - (p[2] - p[0]) / 6) + p[1]) / 8
    assert np.hypot(*(drawn * (1, -1) - middle).T).min() < 0.3


@pytest.mark.parametrize("change", [{"roundness": None}, {"roundness": {"type": 2}, "elbowed": True, "type": "arrow"}, {}])
def test_a_sharp_line_keeps_its_points(change):
    assert len(only(LINE | {"points": [[0, 0], [4, 0], [4, 4]]} | change).points) == 3


def test_lines_of_old_files_say_that_they_are_round():
    bent = {"points": [[0, 0], [40, 0], [40, 40]]}
    assert len(only(LINE | bent | {"strokeSharpness": "round"}).points) > 5
    assert len(only(LINE | bent | {"type": "draw"}).points) > 5


def test_shapes_are_closed_outlines():
    assert only(BOX).points.tolist() == [[0, 0], [4, 0], [4, -2], [0, -2]] and only(BOX).closed
    assert only(BOX | {"type": "diamond"}).points.tolist() == [[2, 0], [4, -1], [2, -2], [0, -1]]
    ellipse = only(BOX | {"type": "ellipse", "width": 40, "height": 20}).points - (20, -10)
    assert np.hypot(ellipse[:, 0] / 20, ellipse[:, 1] / 10) == pytest.approx(1, abs=1e-3)


def test_round_corners_stay_inside_the_box():
    points = only(BOX | {"width": 400, "height": 200, "roundness": {"type": 3}}).points
    assert 12 < len(points) < 60 and points.min(0) == pytest.approx((0, -200)) and points.max(0) == pytest.approx((400, 0))
    assert np.hypot(*points.T).min() == pytest.approx(32 * np.sqrt(2) / 4, rel=0.02)  # a quarter of the way to the corner's chord


def test_a_background_fills_what_is_closed_or_nearly():
    loop = LINE | {"points": [[0, 0], [40, 0], [40, 40], [3, 2]], "backgroundColor": "#ff0000"}
    assert only(loop).filled and only(loop).closed and len(only(loop).points) == 4
    assert not only(loop | {"points": [[0, 0], [40, 0], [40, 40], [9, 2]]}).filled
    assert not only(loop | {"backgroundColor": "transparent"}).filled and not only(loop | {"backgroundColor": "transparent"}).closed
    assert only(LINE | {"points": [[0, 0], [40, 0], [40, 40], [0, 0]]}).closed
    assert only(loop | {"points": [[0, 0], [40, 0], [40, 40]], "polygon": True}).closed
    assert only(loop | {"strokeColor": "transparent"}).width is None


def test_freedraw_has_the_pressure_of_the_pen_and_the_width_it_is_painted_with():
    pen = LINE | {"type": "freedraw", "points": [[0, 0], [1, 1], [2, 2]], "pressures": [0.2, 0.9], "simulatePressure": False}
    assert only(pen).pressure.tolist() == [0.2, 0.9, 0.5] and only(pen).width == FREEDRAW * 3
    mouse = only(pen | {"simulatePressure": True})
    assert mouse.pressure is None and mouse.width == pytest.approx(FREEDRAW * 3 * (0.4 + 0.6 * np.sqrt(0.5)))


def test_what_is_deleted_or_cannot_be_seen_is_no_stroke():
    sketch = read(
        LINE, LINE | {"isDeleted": True}, LINE | {"opacity": 0}, LINE | {"strokeColor": "transparent"}, LINE | {"strokeColor": "#00000000"}
    )
    assert len(sketch) == 1 and sketch.warnings == ("3 invisible elements were left out.",)


def test_pictures_texts_and_the_unknown_are_counted():
    note = TEXT | {"text": "my dearest oak tree"}
    sketch = read(LINE, {"type": "image", "id": "i"}, note, note, {"type": "hologram"}, {"type": "embeddable"})
    assert sketch.warnings == (
        "1 picture was left out.",
        "2 texts were left out.",
        "1 unknown element (hologram) was left out.",
        "1 web page was left out.",
    )


def test_an_arrow_is_a_stroke_unless_it_points_from_a_text():
    arrow = LINE | {"type": "arrow", "endArrowhead": "arrow"}
    assert len(read(arrow)) == 1
    sketch = read(LINE, arrow | {"startBinding": {"elementId": "t"}}, TEXT)
    assert len(sketch) == 1 and "1 arrow at a text was left out." in sketch.warnings


@pytest.mark.parametrize(
    "elements",
    [
        [BOX | {"customData": {"label": "crown"}}],
        [BOX | {"id": "crown-1"}],
        [BOX, TEXT | {"containerId": "b"}],
        [BOX | {"groupIds": ["g", "h"]}, TEXT | {"groupIds": ["g", "h"], "text": "The Crown"}],
        [BOX | {"groupIds": ["g", "h"]}, TEXT | {"groupIds": ["h"]}],
        [BOX | {"frameId": "f"}, {"type": "frame", "id": "f", "name": "Crown"}],
    ],
    ids=["customData", "id", "text inside", "text in its group", "text in an outer group", "frame"],
)
def test_a_label_makes_a_crown(elements):
    sketch = read(*elements, LINE)
    box, line = sketch.strokes
    assert (box.kind, box.labelled, line.kind, line.labelled) == (StrokeKind.CROWN, True, StrokeKind.BRANCH, False)
    assert sketch.warnings == ()


def test_the_closest_label_wins_and_the_layer_is_the_innermost_group_or_frame():
    frame = {"type": "frame", "id": "f", "name": "crown"}
    trunk = LINE | {"groupIds": ["g"], "frameId": "f"}
    stroke = only(trunk, TEXT | {"groupIds": ["g"], "text": "trunk"}, frame)
    assert (stroke.kind, stroke.layer) == (StrokeKind.BRANCH, "trunk")
    assert only(trunk, frame).layer == "crown" and only(LINE).layer is None


def test_a_long_text_in_a_group_is_a_note_and_no_label():
    sketch = read(LINE | {"groupIds": ["g"]}, TEXT | {"groupIds": ["g"], "text": "an oak with a wide crown"})
    assert sketch.strokes[0].kind == StrokeKind.BRANCH and sketch.warnings == ("1 text was left out.",)


def test_ids_are_unique_and_missing_ones_are_numbered():
    nameless = {key: value for key, value in LINE.items() if key != "id"}
    assert [s.id for s in read(LINE, LINE, nameless, LINE | {"id": "\ud800"}).strokes] == ["a", "a-2", "stroke-3", "?"]


LIBRARY = {
    "v1": {"type": "excalidrawlib", "version": 1, "library": [[LINE], [BOX]]},
    "v2": {"type": "excalidrawlib", "version": 2, "libraryItems": [{"name": "oak", "elements": [LINE]}, {"elements": [BOX]}]},
}


@pytest.mark.parametrize("version", LIBRARY)
def test_of_a_library_the_first_drawing_is_read_unless_another_is_asked_for(version, tmp_path):
    path = tmp_path / "lib.excalidrawlib"
    path.write_text(json.dumps(LIBRARY[version]))
    first = read_sketch(path)
    assert first.strokes[0].id == "a"
    title = " ('oak')" if version == "v2" else ""
    assert first.warnings == (f"lib.excalidrawlib is a library of 2 drawings; the first{title} was read. lib.excalidrawlib#2 is the next.",)
    assert read_sketch(f"{path}#2").strokes[0].id == "b" and read_sketch(f"{path}#2").warnings == ()
    with pytest.raises(SketchError, match="has no drawing #3; it holds 2. Say #1 to #2."):
        read_sketch(f"{path}#3")


def test_the_clipboard_is_a_scene_too():
    assert len(read_excalidraw(json.dumps({"type": "excalidraw/clipboard", "elements": [LINE]}).encode(), "t")) == 1


BAD = {
    "its points are not a list": LINE | {"points": [[0, 0], [1]]},
    r"its points are not a list of \[x, y\] rows of finite": LINE | {"points": [[0, float("nan")]]},
    "it has no points": LINE | {"points": []},
    "its x is 'left'": LINE | {"x": "left"},
    "its angle is inf": LINE | {"angle": float("inf")},
    "its width is None": {"type": "ellipse", "x": 0, "y": 0},
    "its strokeWidth is -1": LINE | {"strokeWidth": -1},
    "its pressures are not all": LINE | {"type": "freedraw", "pressures": ["hard"]},
    "its x is inf": LINE | {"x": 1e999},
}


@pytest.mark.parametrize("message", BAD)
def test_a_bad_element_is_named(message):
    with pytest.raises(SketchError, match="^Stroke .*in t.excalidraw, " + message + ".*Draw it again, or delete it.") as error:
        read(BAD[message])
    assert error.value.stroke is not None


@pytest.mark.parametrize(
    ("document", "message"),
    [
        ({"type": "excalidraw"}, "has no list 'elements'"),
        ({"type": "excalidraw", "elements": [1]}, "has no list 'elements' of objects with a 'type'"),
        ({"type": "excalidrawlib", "libraryItems": []}, "has no drawing #1; it holds 0"),
        ({"type": "excalidrawlib", "libraryItems": [3]}, "has no list 'elements'"),
        ({"a": 1}, "is JSON, but no Excalidraw drawing"),
    ],
)
def test_a_document_that_is_no_scene_is_refused(document, message):
    with pytest.raises(SketchError, match=message):
        read_excalidraw(json.dumps(document).encode(), "t")


def test_more_strokes_than_the_limit_is_an_error():
    with pytest.raises(SketchError, match="holds 3 strokes, more than 2.*--max-strokes"):
        read(LINE, LINE, LINE, max_strokes=2)


def packed(compressed: bool) -> bytes:
    inner = scene(LINE | {"customData": {"note": "Bäume"}})
    text = (zlib.compress(inner) if compressed else inner).decode("latin-1")
    return json.dumps({"version": "1", "encoding": "bstring", "compressed": compressed, "encoded": text}, ensure_ascii=False).encode("latin-1")


def png(text: bytes) -> bytes:
    def chunk(kind: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0))
    note = chunk(b"tEXt", b"application/vnd.excalidraw+json\0" + text)
    return b"\x89PNG\r\n\x1a\n" + head + note + chunk(b"IDAT", zlib.compress(b"\0\0")) + chunk(b"IEND", b"")


def svg(text: bytes, version: int) -> bytes:
    payload = base64.b64encode(text if version > 1 else text.decode("latin-1").encode())
    return (
        b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><!-- payload-type:application/vnd.excalidraw+json -->'
        b"<!-- payload-version:%d --><!-- payload-start -->%s<!-- payload-end -->" % (version, payload)
        + b'<path d="M0 0L1 5" stroke="red" fill="none"/></svg>'
    )


@pytest.mark.parametrize("compressed", [True, False])
@pytest.mark.parametrize(("name", "wrap"), [("t.png", png), ("t.svg", lambda t: svg(t, 2)), ("old.svg", lambda t: svg(t, 1))])
def test_a_picture_exported_with_its_scene_is_read_as_the_scene(name, wrap, compressed, tmp_path):
    (tmp_path / name).write_bytes(wrap(packed(compressed)))
    sketch = read_sketch(tmp_path / name)
    assert sketch.strokes[0].points.tolist() == [[10, -20], [14, -28]]
    assert sketch.warnings == (f"{name} carries the Excalidraw drawing it was exported from; that was read.",)


def test_a_damaged_scene_in_a_picture_is_passed_over(tmp_path):
    (tmp_path / "t.svg").write_bytes(svg(packed(True)[:-30], 2))
    assert read_sketch(tmp_path / "t.svg").strokes[0].points.tolist() == [[0, 0], [1, -5]]


@pytest.mark.skipif(not SHARED.exists(), reason="the shared drawings are not beside this checkout")
def test_the_christmas_tree_is_sixteen_painted_shapes():
    sketch = read_sketch(SHARED / "sketches/excalidraw/christmas_tree.excalidraw")
    assert len(sketch) == 16 and all(stroke.filled and stroke.closed for stroke in sketch.strokes) and sketch.warnings == ()
    low, high = (getattr(np.concatenate([s.points for s in sketch.strokes]), f)(0) for f in ("min", "max"))
    assert low == pytest.approx((1219.9, -375.4), abs=0.1) and high == pytest.approx((1596.1, 103.5), abs=0.1)
