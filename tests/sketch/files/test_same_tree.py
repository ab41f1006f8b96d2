"""One tree, every format: the files say the same, so the graphs are the same."""

import numpy as np
import pytest
from hands import parents

from benchmarks import little_tree
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.reading import sketch_graph

NAMED = [name for name in little_tree.files() if not name.endswith("ndjson")]
EXPECTED = {"trunk": None, "left": "trunk", "right": "trunk", "upper": "trunk", "twig": "left", "bough": "right", "shoot": "trunk"}


def graph_of(name, folder):
    (folder / name).write_bytes(little_tree.files()[name])
    sketch = read_sketch(folder / name)
    assert sketch.warnings == ()
    return sketch_graph(sketch)


@pytest.mark.parametrize("name", NAMED)
def test_every_format_gives_the_graph_of_our_own(name, tmp_path):
    graph, own = graph_of(name, tmp_path), graph_of("tree.json", tmp_path)
    assert parents(graph) == parents(own) == EXPECTED
    assert np.array_equal(graph.parent, own.parent) and np.array_equal(graph.limb, own.limb)
    assert graph.xy == pytest.approx(own.xy, abs=1e-9) and graph.curve_points == pytest.approx(own.curve_points, abs=1e-9)
    (crown,), (ours,) = graph.crown, own.crown
    assert crown == pytest.approx(ours, abs=1e-9)


def test_a_drawing_without_names_gives_the_same_limbs(tmp_path):
    graph = graph_of("tree.ndjson", tmp_path)
    rows = [f"stroke-{k}" for k in range(1, 8)]
    names = dict(zip(rows, EXPECTED, strict=True)) | {None: None}
    assert {names[child]: names[parent] for child, parent in parents(graph).items()} == EXPECTED
    assert len(graph.crown) == 1
