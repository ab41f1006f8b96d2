"""A crown or an obstacle that encloses nothing is left out, and the user is told."""

import json

import pytest

from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.reading import sketch_graph


@pytest.mark.parametrize("kind, article", [("crown", "a"), ("obstacle", "an")])
def test_it_is_named_with_the_way_out(tmp_path, kind, article):
    strokes = [
        {"id": "trunk", "kind": "branch", "points": [[0, 100], [0, 0]]},
        {"id": "limb", "kind": "branch", "points": [[0, 50], [30, 20]]},
        {"id": "flat", "kind": kind, "points": [[-20, 20], [20, 60]]},
    ]
    path = tmp_path / "drawing.json"
    path.write_text(json.dumps({"sketchtree": 1, "units": "px", "y": "down", "strokes": strokes, "view_deg": 0}))
    graph = sketch_graph(read_sketch(path))
    assert graph.crown == () and graph.obstacles == ()
    (said,) = [warning for warning in graph.warnings if "flat" in warning]
    assert said.startswith("Stroke flat is ") and f"{article} {kind}" in said
    assert said.endswith("but it encloses nothing: left out. Draw it as a closed curve.")
