import gzip
import json

import numpy as np
import pytest
from hands import EXAMPLES, SHARED

from sketchtree.errors import SketchError
from sketchtree.sketch.formats import READABLE, check_sketch, read_sketch, write_sketch, write_sketch_json
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9">{}</svg>'
PATH = '<path d="M0 0L1 5" stroke="red" fill="none"/>'
BAD = {
    "empty.svg": (b"", "empty.svg is empty"),
    "blank.svg": (b" \n ", "blank.svg is empty"),
    "notes.txt": (b"a tree, please", "is none of the files that can be read: SVG drawing, sketch in JSON"),
    "junk.svg": (bytes(range(128, 256)) * 9, "is none of the files that can be read: SVG drawing, sketch in JSON"),
    "page.svg": (b"<html><body/></html>", "root is <html>, not <svg>"),
    "cut.svg": (SVG.format(PATH).encode()[:-20], "not well-formed XML.*cut short"),
    "nothing.svg": (SVG.format("<text>tree</text>").encode(), "holds no strokes"),
    "flat.svg": (SVG.replace("0 0 9 9", "0 0 0 9").format(PATH).encode(), "width and height above 0"),
    "words.svg": (SVG.replace("0 0 9 9", "a b").format(PATH).encode(), "four finite numbers are expected"),
    "crown.svg": (SVG.format(f'<g id="crown">{PATH}</g>').encode(), "no branch strokes: all it holds is labelled crown"),
    "tree.png": (b"\x89PNG\r\n\x1a\n", "tree.png is damaged"),
    "tree.excalidraw": (b'{"type": "excalidraw"}', "has no list 'elements'"),
    "tree.inkml": (b'<ink xmlns="http://www.w3.org/2003/InkML"/>', "holds no strokes"),
    "half.svgz": (gzip.compress(SVG.format(PATH).encode())[:-12], "damaged gzip"),
    "cut.json": (b'{"sketchtree": 1, "str', "not one well-formed JSON document"),
    "other.json": (b'{"a": 1}', "no key 'sketchtree'"),
    "list.json": (b"[1, 2]", "no key 'sketchtree'"),
    "new.json": (b'{"sketchtree": 2, "strokes": []}', "version 2; this program reads up to 1"),
    "version.json": (b'{"sketchtree": "1", "strokes": []}', "a version number was expected"),
    "strokes.json": (b'{"sketchtree": 1, "strokes": 3}', "no list 'strokes'"),
    "none.json": (b'{"sketchtree": 1, "strokes": []}', "holds no strokes"),
    "y.json": (b'{"sketchtree": 1, "y": "left", "strokes": []}', "'up' or 'down' was expected"),
    "units.json": (b'{"sketchtree": 1, "units": 3, "strokes": []}', "a word was expected"),
    "view.json": (b'{"sketchtree": 1, "view_deg": "x", "strokes": []}', "degrees were expected"),
    "turn.json": (b'{"sketchtree": 1, "view_deg": NaN, "strokes": []}', "degrees were expected"),
    "far.json": (b'{"sketchtree": 1, "view_deg": 1e999, "strokes": []}', "degrees were expected"),
}
STROKES = {
    "it is not an object": 3,
    "not a list of": {"id": "a", "points": 3},
    r"point 2 is \[1\]": {"id": "a", "points": [[1, 2], [1]]},
    "point 1 is": {"id": "a", "points": [["1", 2]]},
    "it has no points": {"id": "a", "points": []},
    "not a finite number": {"id": "a", "points": [[float("nan"), 2]]},
    "its kind is 'leaf'": {"id": "a", "points": [[1, 2]], "kind": "leaf"},
    "its width is -1": {"id": "a", "points": [[1, 2]], "width": -1},
    "its pressure is null at some points only": {"id": "a", "points": [[1, 2, None, 0], [1, 3, 0.5, 9]]},
    "its pressure is below 0": {"id": "a", "points": [[1, 2, -0.5], [1, 3, 0.5]]},
    "its 'closed' is 1": {"id": "a", "points": [[1, 2]], "closed": 1},
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_is_named_with_a_remedy(name, tmp_path):
    data, message = BAD[name]
    (tmp_path / name).write_bytes(data)
    with pytest.raises(SketchError, match=message) as error:
        read_sketch(tmp_path / name)
    assert name in str(error.value) and error.value.remedy


@pytest.mark.parametrize("message", STROKES)
def test_a_bad_stroke_of_a_json_sketch_is_named(message, tmp_path):
    (tmp_path / "t.json").write_text(json.dumps({"sketchtree": 1, "strokes": [STROKES[message]]}))
    with pytest.raises(SketchError, match=message) as error:
        read_sketch(tmp_path / "t.json")
    assert error.value.stroke is not None and "t.json" in str(error.value)


def test_two_strokes_of_one_id_are_refused(tmp_path):
    row = {"id": "a", "points": [[0, 0], [0, 1]]}
    (tmp_path / "t.json").write_text(json.dumps({"sketchtree": 1, "strokes": [row, row]}))
    with pytest.raises(SketchError, match="its id is used twice"):
        read_sketch(tmp_path / "t.json")


def test_more_strokes_than_the_limit_is_an_error(tmp_path):
    (tmp_path / "t.json").write_text(json.dumps({"sketchtree": 1, "strokes": [{"points": [[0, k], [1, k]]} for k in range(5)]}))
    with pytest.raises(SketchError, match="holds 5 strokes, more than 4.*--max-strokes"):
        read_sketch(tmp_path / "t.json", max_strokes=4)


def test_a_missing_file_and_a_folder_are_named(tmp_path):
    with pytest.raises(SketchError, match="There is no file .*gone.svg"):
        read_sketch(tmp_path / "gone.svg")
    with pytest.raises(SketchError, match="is a folder"):
        read_sketch(tmp_path)


def test_a_gzipped_drawing_reads_like_the_plain_one(tmp_path):
    (tmp_path / "t.svgz").write_bytes(gzip.compress(SVG.format(PATH).encode()))
    assert read_sketch(tmp_path / "t.svgz").strokes[0].points.tolist() == [[0, 0], [1, -5]]


def test_content_decides_before_the_extension(tmp_path):
    (tmp_path / "t.json").write_text(SVG.format(PATH))
    assert len(read_sketch(tmp_path / "t.json")) == 1


def same(a: Sketch, b: Sketch) -> bool:
    fields = ("id", "kind", "labelled", "closed", "width", "filled")
    arrays = ("points", "pressure", "time")
    return (a.units, a.view_deg, len(a)) == (b.units, b.view_deg, len(b)) and all(
        all(getattr(s, f) == getattr(t, f) for f in fields)
        and all((getattr(s, f) is None) == (getattr(t, f) is None) and (getattr(s, f) is None or np.array_equal(getattr(s, f), getattr(t, f))) for f in arrays)
        for s, t in zip(a.strokes, b.strokes, strict=True)
    )


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.svg")) + [EXAMPLES / "apple.json"], ids=lambda p: p.name)
def test_a_sketch_survives_json_bit_for_bit(path, tmp_path):
    sketch = read_sketch(path)
    write_sketch_json(sketch, tmp_path / "t.json")
    assert same(read_sketch(tmp_path / "t.json"), sketch)


def test_every_field_of_a_stroke_survives_json(tmp_path):
    points = [[0.1, 1 / 3], [2e-300, 5e11]]
    full = Stroke("a b", points, StrokeKind.CROWN, labelled=True, closed=True, width=0.3, pressure=[0.1, 0.7], time=[0.0, 17.0], filled=True)
    sketch = Sketch((full, Stroke("c", points, pressure=[0.5, 1.0]), Stroke("d", points)), units="mm", view_deg=30.0)
    write_sketch_json(sketch, tmp_path / "t.json")
    assert same(read_sketch(tmp_path / "t.json"), sketch)


def test_time_without_pressure_survives_json(tmp_path):
    sketch = Sketch((Stroke("a", [[0, 0], [0, 1]], time=[3.0, 4.0]),))
    write_sketch_json(sketch, tmp_path / "t.json")
    assert read_sketch(tmp_path / "t.json").strokes[0].time.tolist() == [3.0, 4.0]


def test_a_folder_that_cannot_be_written_is_named(tmp_path):
    for write in (write_sketch_json, write_sketch):
        with pytest.raises(SketchError, match="t.json can't be written .*Choose a folder you may write to."):
            write(Sketch((Stroke("a", [[0, 0]]),)), tmp_path / "gone" / "t.json")


@pytest.mark.parametrize("name", ["t.json", "t.svg", "T.SVG"])
def test_a_sketch_is_written_by_extension_whole_and_reads_back(name, tmp_path):
    sketch = read_sketch(EXAMPLES / "apple.json")
    (tmp_path / name).write_text("what was there before")
    write_sketch(sketch, tmp_path / name)
    assert same(read_sketch(tmp_path / name), sketch)
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize(
    "message, stroke",
    [
        ("Stroke b: its id is used twice", Stroke("b", [[0, 0]])),
        ("Stroke a: its pressure is not one number for each of its 2 points", Stroke("a", [[0, 0], [0, 1]], pressure=np.array([0.5]))),
        ("Stroke a: its time is not finite everywhere", Stroke("a", [[0, 0]], time=np.array([np.nan]))),
        (r"Stroke 'a\\ud800': its id holds half a surrogate pair", Stroke("a\ud800", [[0, 0]])),
        ("Stroke a: its width is inf", Stroke("a", [[0, 0]], width=np.inf)),
        ("Stroke a: its width is nan", Stroke("a", [[0, 0]], width=np.nan)),
    ],
)
@pytest.mark.parametrize("name", ["t.json", "t.svg"])
def test_what_a_file_could_not_give_back_is_not_written(name, message, stroke, tmp_path):
    with pytest.raises(SketchError, match=message) as error:
        write_sketch(Sketch((Stroke("b", [[0, 0]]), stroke)), tmp_path / name)
    assert error.value.remedy and not list(tmp_path.iterdir())


def test_a_turn_or_page_that_is_no_number_is_not_written(tmp_path):
    for sketch in (Sketch((), view_deg=np.nan), Sketch((), page=(0.0, 0.0, np.inf, 1.0))):
        with pytest.raises(SketchError, match="has a view or page that is not finite"):
            write_sketch(sketch, tmp_path / "t.json")


@pytest.mark.parametrize("name", ["file/t.json", "a\0.json", "x" * 5000 + ".json"])
def test_a_name_no_file_can_have_is_named(name, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(SketchError, match="can't be written"):
        write_sketch(Sketch((Stroke("a", [[0, 0]]),)), tmp_path / name)


def test_pressures_in_a_tablets_own_steps_are_parts_of_the_greatest(tmp_path):
    rows = [{"id": "a", "points": [[0, 0, 512], [0, 1, 1024]]}, {"id": "b", "points": [[0, 0, 256], [0, 1, 0]]}]
    (tmp_path / "t.json").write_text(json.dumps({"sketchtree": 1, "strokes": rows}))
    sketch = read_sketch(tmp_path / "t.json")
    assert [stroke.pressure.tolist() for stroke in sketch.strokes] == [[0.5, 1.0], [0.25, 0.0]]
    assert sketch.warnings == ("Pressures go up to 1024; they were read as parts of that.",)


@pytest.mark.parametrize("name", ["t.png", "t.excalidraw", "t"])
def test_a_sketch_is_not_written_as_what_it_is_not(name, tmp_path):
    with pytest.raises(SketchError, match="Sketches are not written as '.*Name the file .json or .svg."):
        write_sketch(Sketch((Stroke("a", [[0, 0]]),)), tmp_path / name)


def test_a_file_that_may_not_be_read_is_named(tmp_path, monkeypatch):
    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    (tmp_path / "t.svg").write_text(SVG.format(PATH))
    monkeypatch.setattr("pathlib.Path.open", refuse)
    with pytest.raises(SketchError, match="t.svg can't be read .Permission denied.*permissions"):
        read_sketch(tmp_path / "t.svg")


def test_a_number_after_the_name_is_a_drawing_in_the_file_unless_the_file_is_called_so(tmp_path):
    (tmp_path / "t.svg").write_text(SVG.format(PATH))
    (tmp_path / "u.svg#2").write_text(SVG.format(PATH))
    assert len(read_sketch(f"{tmp_path}/t.svg#1")) == len(read_sketch(tmp_path / "u.svg#2")) == 1
    with pytest.raises(SketchError, match="t.svg has no drawing #2; it holds 1"):
        read_sketch(f"{tmp_path}/t.svg#2")


def test_progress_ends_at_one(tmp_path):
    told = []
    read_sketch(EXAMPLES / "apple.json", progress=told.append)
    assert told[-1] == 1.0 and told == sorted(told)


def test_every_extension_that_is_read_has_a_name():
    assert all(suffix.startswith(".") and what for suffix, what in READABLE.items())


def test_a_sketch_out_of_reach_is_refused():
    with pytest.raises(SketchError, match=r"s reaches 2e\+12 px from the origin; 1e\+12 is the limit. A number in it is probably wrong"):
        check_sketch(Sketch((Stroke("a", [[0, 0], [1, -2e12]]),), name="s"))
    with pytest.raises(SketchError, match="s is only 1e-05 px large, too small to be told from rounding. Scale the drawing up"):
        check_sketch(Sketch((Stroke("a", [[1e6, 0], [1e6, 1e-5]]),), name="s"))
    check_sketch(Sketch((Stroke("a", [[0, 0], [0, 1e-6]]),)))


@pytest.mark.skipif(not SHARED.exists(), reason="the shared drawings are not beside this checkout")
def test_a_two_point_stroke_under_a_css_transform_lies_where_a_browser_paints_it():
    stroke = read_sketch(SHARED / "sketches/svg/rp_blossomTree1.svg").strokes[0]
    assert stroke.points == pytest.approx(np.array([[127, -209.9995], [127.07358, -199.00004]]))


def test_a_stroke_far_from_all_others_is_named():
    strokes = (Stroke("a", [[0, 0], [0, 5]]), Stroke("b", [[0, 3], [3, 6]]), Stroke("far", [[0, 1e9], [0, 1e9 + 3]]))
    with pytest.raises(SketchError, match="Stroke far: it lies so far from the others that all strokes are dots.*Delete it, or move it back") as error:
        sketch_graph(Sketch(strokes))
    assert error.value.stroke == "far"
