"""Files made to break a reader: each gives a sketch or one sentence, in bounded time and memory."""

import gzip
import json
import struct
import time
import zlib

import pytest
from hands import EXAMPLES

from sketchtree.errors import SketchError
from sketchtree.sketch.files.excalidraw_embed import embedded_scene
from sketchtree.sketch.formats import read_sketch

SVG = '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 9 9">{}</svg>'
PATH = '<path d="M0 0L1 5" stroke="red" fill="none"/>'
ROW = {"id": "trunk", "points": [[0, 0], [1, 5]]}
SKETCH = json.dumps({"sketchtree": 1, "strokes": [ROW]})
SCENE = json.dumps({"type": "excalidraw", "elements": [{"type": "line", "id": "a", "x": 0, "y": 0, "points": [[0, 0], [1, 5]]}]})
INK = '<ink xmlns="http://www.w3.org/2003/InkML"><trace>0 0, 1 5</trace></ink>'
LINE = json.dumps({"drawing": [[[0, 1], [0, 5]]]})
TEXTS = {"t.svg": SVG.format(PATH), "t.json": SKETCH, "t.excalidraw": SCENE, "t.inkml": INK, "t.ndjson": LINE}


def chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def png(width: int, height: int, rows: bytes) -> bytes:
    head = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 1, 0, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def laughs() -> str:
    steps = "".join(f'<!ENTITY l{k} "' + f"&l{k - 1};" * 10 + '">' for k in range(1, 12))
    return f'<!DOCTYPE svg [<!ENTITY l0 "ha">{steps}]>' + SVG.format(f"<text>&l11;</text>{PATH}")


def uses(levels: int) -> str:
    groups = "".join(f'<g id="g{k}">' + f'<use href="#g{k - 1}"/>' * 10 + "</g>" for k in range(1, levels))
    return SVG.format(f'<defs><g id="g0">{PATH}</g>{groups}</defs><use href="#g{levels - 1}"/>')


def clones(count: int) -> str:
    far = "L1 0L0 1" * 50_000
    return SVG.format(f'<defs><path id="a" d="M0 0{far}"/></defs><g fill="none" stroke="red">' + '<use href="#a"/>' * count + "</g>")


FETCH = '<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]>' + SVG.format(f"<text>&a;</text>{PATH}")
DEEP_SCENE = '{"type": "excalidraw", "elements": ' + "[" * 100_000 + "]" * 100_000 + "}"
REFUSED = {
    "laughs.svg": (laughs(), "declares XML entities"),
    "ink_laughs.inkml": (laughs().replace("<svg", "<ink").replace("</svg>", "</ink>").replace("svg [", "ink ["), "declares XML entities"),
    "fetch.svg": (FETCH, "declares an entity of another file"),
    "parameter.svg": ('<!DOCTYPE svg [<!ENTITY % a SYSTEM "http://127.0.0.1/">%a;]>' + SVG.format(PATH), "declares a parameter entity"),
    "uses.svg": (uses(9), "nests its groups|holds more than"),
    "clones.svg": (clones(100), "clones.svg draws more than 5 million points. Simplify its lines, unlink its clones"),
    "deep.svg": (SVG.format("<g>" * 100_000 + PATH + "</g>" * 100_000), "nests its groups"),
    "long_path.svg": (SVG.format(PATH.replace("L1 5", "L1 5" * 5_000_001)), "in long_path.svg, its outline takes 20 MB of text, more than 20"),
    "long_points.svg": (SVG.format(f'<polyline points="{"1 5 " * 5_000_001}"/>'), "in long_points.svg, its outline takes 20 MB of text, more than 20"),
    "long_trace.inkml": (INK.replace("1 5", "1 5," * 5_000_001), "in long_trace.inkml, its trace takes 20 MB of text, more than 20"),
    "long_transform.svg": (SVG.format(PATH.replace("<path", f'<path transform="{"scale(1)" * 20_000}"')), "its transform takes 160000 characters, more than 100000"),
    "points.json": (SKETCH.replace("[1, 5]", ",".join(["[1, 5]"] * 5_000_001)), "points.json draws more than 5 million points. Simplify its lines"),
    "points.excalidraw": (SCENE.replace("[1, 5]", ",".join(["[1, 5]"] * 5_000_001)), "points.excalidraw draws more than 5 million points"),
    "points.ndjson": (LINE.replace("[0, 1]", "[0" + ",1" * 5_000_000 + "]"), "points.ndjson draws more than 5 million points"),
    "wide.json": (SKETCH.replace('"trunk",', '"trunk", "width": 1e999,'), "its width is inf; a number of at least 0 was expected"),
    "deep.json": ("[" * 100_000, "not one well-formed JSON document|nests its lists"),
    "deep_objects.json": ('{"sketchtree": 1, "strokes": ' + '{"a":' * 100_000, "not one well-formed JSON document|nests its lists"),
    "deep.excalidraw": (DEEP_SCENE, "nests its lists or objects too deep|list 'elements'"),
    "infinite.json": (SKETCH.replace("[1, 5]", "[1, 1e400]"), "not a finite number|point 2 is"),
    "nan.json": (SKETCH.replace("[1, 5]", "[1, NaN]"), "not a finite number|point 2 is"),
    "long_number.json": (SKETCH.replace("[1, 5]", f"[1, {'9' * 5000}]"), "not one well-formed JSON document"),
    "large_number.json": (SKETCH.replace("[1, 5]", f"[1, {'9' * 400}]"), "not a finite number|point 2 is"),
    "infinite.excalidraw": (SCENE.replace("[1, 5]", "[1, 1e400]"), "finite numbers"),
    "large_number.excalidraw": (SCENE.replace("[1, 5]", f"[1, {'9' * 400}]"), "finite numbers"),
    "infinite.ndjson": (LINE.replace("[0, 5]", "[0, -1e999]"), "finite numbers"),
    "infinite.inkml": (INK.replace("1 5", "1 1e999"), "not a finite number"),
    "long_hex.inkml": (INK.replace("1 5", f"1 #{'F' * 5000}"), "not a finite number"),
    "far.json": (SKETCH.replace("[1, 5]", "[1, 1e300]"), r"reaches 1e\+300 px from the origin; 1e\+12 is the limit"),
    "tiny.json": (SKETCH.replace("[0, 0], [1, 5]", "[1000, 0], [1000, 1e-8]"), "only 1e-08 px large, too small to be told from rounding"),
    "twice.json": (json.dumps({"sketchtree": 1, "strokes": [ROW, ROW]}), "its id is used twice"),
    "latin.excalidraw": (SCENE.replace('"a"', '"\xe9"').encode("latin-1"), "is not Unicode text"),
    "latin.ndjson": (LINE.replace("{", '{"word": "\xe9", ').encode("latin-1"), "is not Unicode text"),
    "folded.json": (SKETCH.encode() + b"\0" * 9, "not one well-formed JSON document"),
    "bomb.png": (png(50_000, 50_000, b"\0"), "50000 × 50000 pixels .2,500 megapixels.; at most 200 megapixels are read"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_hostile_file_is_refused_in_one_sentence(name, tmp_path):
    data, message = REFUSED[name]
    (tmp_path / name).write_bytes(data if isinstance(data, bytes) else data.encode())
    with pytest.raises(SketchError, match=message) as error:
        read_sketch(tmp_path / name)
    assert error.value.remedy and len(str(error.value)) < 600


@pytest.mark.parametrize(
    "deep, told",
    [
        (PATH.replace("<path", '<path style="fill:red;stroke:' + "(" * 5000 + '"'), "The style of a <path> is too long, or nests its brackets too deep; it was left out."),
        ("<style>path{fill:" + "(" * 5000 + "}</style>" + PATH, "A style sheet is too long, or nests its brackets too deep; the rest of it was left out."),
        ("<style>" + "@media all{" * 5000 + "path{fill:red}</style>" + PATH, "A style sheet is too long, or nests its brackets too deep; the rest of it was left out."),
        ("<style>" + "a{b:c}" * 200_000 + "path{fill:red}</style>" + PATH, "A style sheet is too long, or nests its brackets too deep; the rest of it was left out."),
        (PATH.replace("<path", '<path style="fill:red;' + "a:b;" * 30_000 + '"'), "The style of a <path> is too long, or nests its brackets too deep; it was left out."),
    ],
    ids=["attribute", "sheet", "at-rules", "long sheet", "long attribute"],
)
def test_a_style_without_end_is_told_and_the_drawing_is_read_without_it(deep, told, tmp_path):
    (tmp_path / "deep.svg").write_text(SVG.format(deep))
    sketch = read_sketch(tmp_path / "deep.svg")
    assert sketch.strokes[0].points.tolist() == [[0, 0], [1, -5]] and sketch.strokes[0].width == 1.0
    assert sketch.warnings == (told,)


LONG = 300_000  # what is looked at once takes milliseconds; from each of its characters, minutes
LONG_TEXTS = {
    "paint.svg": SVG.format(PATH.replace('"red"', f'"url({" " * LONG}x"')),
    "clip.svg": SVG.format(PATH.replace("<path", f'<path clip-path="{"url(#" * (LONG // 5)}"')),
    "arc.svg": SVG.format(PATH.replace("L1 5", "a" + "9" * LONG)),
    "arcs.svg": SVG.format(PATH.replace("L1 5", "a" + "9 " * LONG)),
    "numbers.svg": SVG.format(PATH.replace("L1 5", "L" + ".9" * LONG)),
    "minus.svg": SVG.format(PATH.replace("L1 5", "L" + "-" * LONG)),
    "id.svg": SVG.format(f'<g id="{"_" * LONG}x">{PATH}</g>'),
    "width.svg": SVG.format(PATH.replace("<path", f'<path stroke-width="{"1" * LONG}q"')),
    "media.svg": SVG.format(f'<style media="{"not " * LONG}screen">path{{fill:red}}</style>{PATH}'),
    "selector.svg": SVG.format(f"<style>{'g ' * (LONG // 10)}path{{fill:red}}</style>{PATH}"),
    "variables.svg": SVG.format(PATH.replace("<path", f'<path style="stroke:{"var(--a," * 5000}red{")" * 5000}"')),
    "comments.svg": "<!--" * 16_000 + SVG.format(PATH),
    "instructions.svg": "<?" * 30_000 + SVG.format(PATH),
    "doctypes.svg": "<!DOCTYPE[" * 6_000 + SVG.format(PATH),
    "trace.inkml": INK.replace("1 5", "'" + " " * LONG + "x"),
    "label.excalidraw": SCENE.replace('"a"', f'"{"-" * LONG}x"'),
}


@pytest.mark.parametrize("name", LONG_TEXTS)
def test_long_texts_are_looked_at_once(name, tmp_path):
    (tmp_path / name).write_text(LONG_TEXTS[name])
    began = time.monotonic()
    try:
        read_sketch(tmp_path / name)
    except SketchError as error:
        assert len(str(error)) < 600
    assert time.monotonic() - began < 8.0


def chained(k: int, kind: str, inner: str) -> str:
    """A clip or mask whose two shapes are clipped by the next one."""
    return f'<{kind} id="c{k}">' + inner.format(k + 1) * 2 + f"</{kind}>"


CLIP_BOX = '<rect width="9" height="9" clip-path="url(#c{})"/>'
MASK_BOX = '<g mask="url(#c{})"><rect width="9" height="9" fill="#fff"/></g>'
SOURCE = '<inkSource xml:id="s"><traceFormat><channel name="X"/><channel name="Y"/></traceFormat>' + "<channelProperty/>" * 3000 + "</inkSource>"
CONTEXTS = "".join(f'<context xml:id="c{k}" contextRef="#c{k + 1}" inkSourceRef="#s"/>' for k in range(64))
MANY = {  # name → (file, strokes in it)
    "ids.svg": (SVG.format(PATH.replace("<path", '<path id="a"') * 15_000), 15_000),
    "clips.svg": (SVG.format("".join(chained(k, "clipPath", CLIP_BOX) for k in range(40)) + PATH.replace("<path", '<path clip-path="url(#c0)"')), 1),
    "masks.svg": (SVG.format("".join(chained(k, "mask", MASK_BOX) for k in range(40)) + PATH.replace("<path", '<path mask="url(#c0)"')), 1),
    "clipped.svg": (SVG.format(f'<clipPath id="c">{"<circle r=%s/>" % repr("9") * 500}</clipPath>' + PATH.replace("<path", '<path clip-path="url(#c)"') * 500), 500),
    "inside.svg": (SVG.format("<style>g:has(path){fill:none}</style>" + "<g>" * 200 + PATH * 1000 + "</g>" * 200), 1000),
    "siblings.svg": (SVG.format("<style>g ~ path{fill:red}</style>" + "<g/>" * 490 + PATH), 1),
    "prefixes.svg": (SVG.format("<g " + " ".join(f'xmlns:a{k}="u"' for k in range(20_000)) + ">" + '<g xmlns:b="c"/>' * 5000 + PATH + "</g>"), 1),
    "ids.excalidraw": (json.dumps({"type": "excalidraw", "elements": json.loads(SCENE)["elements"] * 20_000}), 20_000),
    "contexts.inkml": (f'<ink><definitions>{CONTEXTS}{SOURCE}</definitions>{"<trace contextRef=%s>0 0,1 1</trace>" % repr("#c0") * 500}</ink>', 500),
}


@pytest.mark.parametrize("name", MANY)
def test_work_grows_with_the_file_and_no_faster(name, tmp_path):
    (tmp_path / name).write_text(MANY[name][0])
    began = time.monotonic()
    assert len(read_sketch(tmp_path / name)) == MANY[name][1]
    assert time.monotonic() - began < 12.0


def test_a_gzip_bomb_stops_at_the_limit(tmp_path):
    (tmp_path / "bomb.svgz").write_bytes(gzip.compress(b" " * 30_000_000))
    with pytest.raises(SketchError, match="bomb.svgz unpacks to more than 20 MB; the limit is 20 MB. .*--max-mb"):
        read_sketch(tmp_path / "bomb.svgz", max_mb=20)


def test_a_bomb_inside_an_excalidraw_png_stops_at_the_limit():
    packed = json.dumps({"encoded": zlib.compress(b" " * 30_000_000).decode("latin-1"), "compressed": True}, ensure_ascii=False).encode("latin-1")
    plain = png(1, 1, b"\0\0")
    data = plain[:33] + chunk(b"tEXt", b"application/vnd.excalidraw+json\0" + packed) + plain[33:]
    assert embedded_scene(data, max_mb=1) is None


@pytest.mark.parametrize("name", TEXTS)
def test_a_file_over_the_limit_names_the_option_that_lifts_it(name, tmp_path):
    (tmp_path / name).write_text(TEXTS[name] + " " * 20_000)
    with pytest.raises(SketchError, match=f"{name} holds 0.02[0-9]* MB; the limit is 0.02 MB. .*raise the limit with --max-mb"):
        read_sketch(tmp_path / name, max_mb=0.02)
    assert len(read_sketch(tmp_path / name, max_mb=0.03)) == 1


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"])
@pytest.mark.parametrize("name", TEXTS)
def test_every_unicode_encoding_reads_like_utf_8(name, encoding, tmp_path):
    (tmp_path / name).write_bytes(TEXTS[name].encode(encoding))
    sketch = read_sketch(tmp_path / name)
    assert sketch.strokes[0].points.tolist() == [[0, 0], [1, -5]] and sketch.warnings == ()


@pytest.mark.parametrize("name", TEXTS)
def test_line_ends_of_any_system_read_alike(name, tmp_path):
    text = TEXTS[name].replace("><", ">\r\n<").replace(", ", ",\r\n") if name != "t.ndjson" else TEXTS[name] + "\r\n"
    (tmp_path / name).write_bytes(text.encode())
    assert read_sketch(tmp_path / name).strokes[0].points.tolist() == [[0, 0], [1, -5]]


@pytest.mark.parametrize("name", TEXTS)
def test_a_truncated_file_is_refused_or_read_for_what_it_has(name, tmp_path):
    for size in range(1, len(TEXTS[name]), 7):
        (tmp_path / name).write_bytes(TEXTS[name][:size].encode())
        with pytest.raises(SketchError):
            read_sketch(tmp_path / name)


@pytest.mark.parametrize("said", TEXTS)
@pytest.mark.parametrize("held", TEXTS)
def test_a_mislabelled_file_is_read_by_what_it_holds_and_remarked_on(held, said, tmp_path):
    path = tmp_path / f"tree.{said.rpartition('.')[2]}"
    path.write_text(TEXTS[held])
    sketch = read_sketch(path)
    fits = held == said or (said == "t.json" and held in ("t.excalidraw", "t.ndjson"))
    assert sketch.strokes[0].points.tolist() == [[0, 0], [1, -5]]
    assert bool(sketch.warnings) != fits and all("is named like a" in warning for warning in sketch.warnings)


def test_a_drawing_named_like_a_picture_is_read_and_remarked_on(tmp_path):
    (tmp_path / "tree.png").write_text(TEXTS["t.svg"])
    assert read_sketch(tmp_path / "tree.png").warnings == (
        "tree.png is named like a PNG picture, but it holds an SVG drawing; it was read as that.",
    )


def test_a_picture_named_like_a_drawing_is_read_and_remarked_on(tmp_path):
    import numpy as np
    from PIL import Image, ImageDraw

    page = Image.new("L", (200, 200), 255)
    ImageDraw.Draw(page).line([(100, 190), (100, 20)], fill=0, width=5)
    page.save(tmp_path / "tree.png")
    (tmp_path / "tree.svg").write_bytes((tmp_path / "tree.png").read_bytes())
    sketch, said = read_sketch(tmp_path / "tree.png"), read_sketch(tmp_path / "tree.svg")
    assert np.array_equal(sketch.strokes[0].points, said.strokes[0].points)
    assert said.warnings[0] == "tree.svg is named like an SVG drawing, but it holds a PNG picture; it was read as that."


@pytest.mark.parametrize("path", sorted(EXAMPLES.glob("*.svg"))[:2] + sorted(EXAMPLES.glob("*.json"))[:1], ids=lambda p: p.name)
def test_half_of_a_real_drawing_is_refused(path, tmp_path):
    data = path.read_bytes()
    (tmp_path / path.name).write_bytes(data[: len(data) // 2])
    with pytest.raises(SketchError, match="well-formed"):
        read_sketch(tmp_path / path.name)


def test_names_no_file_can_have_are_refused(tmp_path):
    for name in ("a\0b.svg", "x" * 5000 + ".svg", "x" * 5000 + "#3"):
        with pytest.raises(SketchError):
            read_sketch(tmp_path / name)


def test_half_a_surrogate_pair_in_an_id_can_be_printed(tmp_path):
    for name, text in (("t.json", SKETCH.replace("trunk", r"\ud800")), ("t.excalidraw", SCENE.replace('"a"', r'"\ud800"'))):
        (tmp_path / name).write_text(text)
        read_sketch(tmp_path / name).strokes[0].id.encode("utf-8")
