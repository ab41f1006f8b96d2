"""Whatever a file holds, reading it ends in a sound sketch and graph, or in a SketchTreeError: nothing else ever comes out.

Short and the same every time; `python -m benchmarks.fuzz` looks longer.
"""

import json

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from benchmarks.fuzz import outcome
from benchmarks.mutants import READERS, mutant

COUNT = {"picture": 16}  # files of each reader
short = settings(max_examples=45, derandomize=True, deadline=None, suppress_health_check=list(HealthCheck))
STARTS = (
    *(b"", b"<svg>", b"<ink><trace>", b'{"sketchtree": 1, "strokes": [', b'{"type": "excalidraw", "elements": [', b'{"drawing": [', b"\x1f\x8b\x08"),
    *(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", b"GIF89a", b"BM", b"II*\0", b"RIFF\0\0\0\0WEBP", b"\xff\xd8\xff\xe0", b"PK\x03\x04", b"\xff\xfe<\0"),
)

number = st.one_of(st.integers(-1000, 1000), st.floats(), st.just(10**400), st.floats(-1e3, 1e3))
name = st.sampled_from(["a", "crown", "trunk", "\ud800", "", "obstacle 2"])
value = st.recursive(
    st.one_of(st.none(), st.booleans(), number, name, st.text(max_size=8)),
    lambda inner: st.one_of(st.lists(inner, max_size=4), st.dictionaries(st.text(max_size=5), inner, max_size=4)),
    max_leaves=8,
)
coordinate = st.floats(-500, 500).map(lambda v: round(v, 1))
points = st.lists(st.lists(coordinate, min_size=2, max_size=2), min_size=1, max_size=12)
odd_points = st.one_of(points, st.lists(st.lists(st.one_of(number, st.none()), max_size=5), max_size=6), value)


def mostly(usual, odd=value):
    """The usual value, now and then an odd one."""
    return st.one_of(usual, usual, usual, odd)


rows = st.fixed_dictionaries(
    {"points": mostly(points, odd_points)},
    optional={
        "id": mostly(name),
        "kind": mostly(st.sampled_from(["branch", "crown", "obstacle"])),
        "width": mostly(st.floats(0, 50)),
        "closed": mostly(st.booleans()),
        "filled": mostly(st.booleans()),
    },
)
sketches = st.fixed_dictionaries(
    {"sketchtree": mostly(st.just(1)), "strokes": mostly(st.lists(rows, min_size=1, max_size=8))},
    optional={"y": mostly(st.sampled_from(["up", "down"])), "units": mostly(st.just("mm")), "view_deg": mostly(number)},
)
elements = st.fixed_dictionaries(
    {
        "type": mostly(st.sampled_from("line freedraw arrow rectangle ellipse diamond text frame image".split()), st.text(max_size=5)),
        "x": mostly(coordinate),
        "y": mostly(coordinate),
        "width": mostly(coordinate),
        "height": mostly(coordinate),
        "points": mostly(points, odd_points),
    },
    optional={
        "id": mostly(name),
        "angle": mostly(st.floats(-7, 7)),
        "roundness": mostly(st.fixed_dictionaries({"type": mostly(st.integers(1, 3))}, optional={"value": mostly(number)})),
        "backgroundColor": mostly(st.sampled_from(["transparent", "#ff0000"])),
        "strokeWidth": mostly(st.floats(0, 9)),
        "pressures": mostly(st.lists(number, max_size=12)),
        "simulatePressure": mostly(st.booleans()),
        "groupIds": mostly(st.lists(name, max_size=3)),
        "frameId": mostly(name),
        "text": mostly(name),
        "containerId": mostly(name),
        "customData": mostly(st.fixed_dictionaries({"label": mostly(name)})),
        "isDeleted": mostly(st.booleans()),
        "opacity": mostly(number),
        "polygon": mostly(st.booleans()),
        "startBinding": mostly(st.fixed_dictionaries({"elementId": mostly(name)})),
    },
)
items = st.lists(mostly(st.fixed_dictionaries({"elements": st.lists(elements)})), max_size=2)
scenes = st.one_of(
    st.fixed_dictionaries({"type": st.just("excalidraw"), "elements": mostly(st.lists(elements, min_size=1, max_size=8))}),
    st.fixed_dictionaries({"type": st.just("excalidrawlib"), "libraryItems": items}),
)
columns = points.map(lambda rows: list(zip(*rows, strict=True)))
drawings = st.fixed_dictionaries({"drawing": mostly(st.lists(mostly(columns, st.lists(st.lists(number, max_size=5), max_size=4)), max_size=5))})

values = st.sampled_from(["1", "-2", "30", "4.5", "'1", '"2', "!7", "*", "?", "T", "#F", "1e999", "-", "x"])
texts = st.one_of(
    points.map(lambda p: ",".join(f"{x} {y}" for x, y in p)),
    points.map(lambda p: ", ".join(f"{x} {y} {k}" for k, (x, y) in enumerate(p))),
    st.lists(st.lists(values, min_size=1, max_size=4).map(" ".join), max_size=6).map(",".join),
)
quoted = st.sampled_from("a #a b #b X Y F T 0 1 -1 1e999 nan begin end penUp 1:2 mm 1/cm crown".split() + [""])
attributes = st.dictionaries(
    st.sampled_from(
        "xml:id contextRef brushRef traceDataRef traceFormatRef inkSourceRef timestampRef priorTrace continuation type from to name value "
        "units min max timeOffset duration time channel orientation respectTo".split()
    ),
    quoted,
    max_size=4,
)
FORMAT = '<traceFormat><channel name="X"/><channel name="Y"/></traceFormat>'


def element(tag: str, inner: str, given: dict[str, str]) -> str:
    return f"<{tag} " + " ".join(f'{key}="{text}"' for key, text in given.items()) + f">{inner}</{tag}>"


tags = st.sampled_from(
    "traceGroup traceView definitions context brush brushProperty inkSource traceFormat channel channelProperties channelProperty "
    "timestamp annotation canvasTransform intermittentChannels".split()
)
leaves = st.one_of(st.builds(element, st.just("trace"), texts, attributes), st.just(FORMAT), st.builds(element, tags, quoted, attributes))
inks = st.recursive(leaves, lambda inner: st.builds(element, tags, st.lists(inner, max_size=4).map("".join), attributes), max_leaves=12)


def sound(data: bytes, path) -> None:
    path.write_bytes(data)
    outcome(path)


@pytest.mark.parametrize("reader", READERS)
def test_mutants_of_valid_files_end_in_a_graph_or_a_clear_error(reader, tmp_path):
    path = tmp_path / f"mutant.{'png' if reader == 'picture' else reader}"
    found = []
    for k in range(COUNT.get(reader, 50)):
        path.write_bytes(mutant(reader, np.random.default_rng((1, k))))
        found.append(outcome(path))
    assert found.count("read") >= 0.05 * len(found), "too few files are read for the others to mean anything"


@short
@given(start=st.sampled_from(STARTS), data=st.binary(max_size=200))
def test_random_bytes(start, data, tmp_path_factory):
    sound(start + data, tmp_path_factory.getbasetemp() / "random.bin")


@short
@given(document=sketches)
def test_sketch_json_in_its_own_grammar(document, tmp_path_factory):
    sound(json.dumps(document).encode(), tmp_path_factory.getbasetemp() / "grammar.json")


@short
@given(document=scenes)
def test_excalidraw_in_its_own_grammar(document, tmp_path_factory):
    sound(json.dumps(document).encode(), tmp_path_factory.getbasetemp() / "grammar.excalidraw")


@short
@given(document=drawings)
def test_quick_draw_in_its_own_grammar(document, tmp_path_factory):
    sound(json.dumps(document).encode(), tmp_path_factory.getbasetemp() / "grammar.ndjson")


@short
@given(body=st.lists(inks, max_size=5).map("".join))
def test_ink_in_its_own_grammar(body, tmp_path_factory):
    sound(f"<ink>{body}</ink>".encode(), tmp_path_factory.getbasetemp() / "grammar.inkml")
