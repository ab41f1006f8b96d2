import json

import pytest
from hands import SHARED

from sketchtree.errors import SketchError
from sketchtree.sketch.files.quickdraw import read_quickdraw
from sketchtree.sketch.formats import read_sketch

SIMPLE = {"word": "tree", "drawing": [[[5, 5], [9, 0]], [[5, 8, 9], [4, 2, 1]]]}
RAW = {"word": "tree", "drawing": [[[5.5, 5], [9, 0], [0, 17]]]}


def lines(*drawings) -> bytes:
    return b"\n".join(json.dumps(drawing).encode() for drawing in drawings) + b"\n"


def test_a_drawing_is_its_strokes_y_up():
    sketch = read_quickdraw(lines(SIMPLE), "t.ndjson")
    assert [s.points.tolist() for s in sketch.strokes] == [[[5, -9], [5, 0]], [[5, -4], [8, -2], [9, -1]]]
    assert [s.id for s in sketch.strokes] == ["stroke-1", "stroke-2"] and sketch.strokes[0].time is None


def test_a_raw_drawing_has_times():
    assert read_quickdraw(lines(RAW), "t.ndjson").strokes[0].time.tolist() == [0, 17]


def test_of_several_drawings_one_must_be_named(tmp_path):
    path = tmp_path / "t.ndjson"
    path.write_bytes(lines(SIMPLE, RAW))
    with pytest.raises(SketchError, match="holds 2 drawings, one a line; a sketch is one. Say which: t.ndjson#1 to t.ndjson#2."):
        read_sketch(path)
    assert len(read_sketch(f"{path}#1")) == 2 and len(read_sketch(f"{path}#2")) == 1
    with pytest.raises(SketchError, match="has no drawing #3; it holds 2"):
        read_sketch(f"{path}#3")


@pytest.mark.parametrize("stroke", [3, [], [[1, 2]], [[1], [1, 2]], [["1"], [2]], [[], []], [[float("nan")], [1]], [[1], [2], [3], [4]]])
def test_a_bad_stroke_is_named(stroke):
    with pytest.raises(SketchError, match="Stroke 2: in t.ndjson, it is not .*Save the line again") as error:
        read_quickdraw(lines({"drawing": [[[1, 2], [3, 4]], stroke]}), "t.ndjson")
    assert error.value.stroke == 2


@pytest.mark.parametrize("data", [b'{"drawing": 3}', b"[1]"])
def test_a_line_without_a_drawing_is_refused(data):
    with pytest.raises(SketchError, match="has no list 'drawing'"):
        read_quickdraw(data, "t.ndjson")


def test_more_strokes_than_the_limit_is_an_error():
    with pytest.raises(SketchError, match="holds 2 strokes, more than 1.*--max-strokes"):
        read_quickdraw(lines(SIMPLE), "t.ndjson", max_strokes=1)


@pytest.mark.skipif(not SHARED.exists(), reason="the shared drawings are not beside this checkout")
@pytest.mark.parametrize("k", [1, 7, 13])
def test_a_line_of_the_data_set_is_the_svg_made_from_it(k):
    folder = SHARED / "sketches/quickdraw"
    drawn, converted = read_sketch(f"{folder}/tree.ndjson#{k}"), read_sketch(folder / f"tree_{k - 1:02}.svg")
    assert [s.points.tolist() for s in drawn.strokes] == [s.points.tolist() for s in converted.strokes]
