"""On many drawings: cartoons are a trunk and a crown, and the limbs of grown trees stay limbs."""

import pytest
from cartoons import cartoon

from benchmarks.topology import drawings
from sketchtree.sketch.reading import sketch_graph
from sketchtree.sketch.roles.sorting import sort_strokes

SEEDS = range(100)
SHARE = 0.95  # of cartoons that must be one limb under one crown


def test_a_blob_on_a_trunk_is_one_limb_under_one_crown():
    good = 0
    for seed in SEEDS:
        graph = sketch_graph(cartoon(seed))
        good += len(graph.crown) == 1 and len(graph.limb_id) == 1 and not graph.root.any()
    assert good >= SHARE * len(SEEDS)


@pytest.mark.parametrize("jitter", [0.0, 1.0, 3.0])
def test_no_limb_of_a_grown_tree_is_taken_for_anything_else(jitter):
    for drawn in drawings(25, jitter):
        parts = sort_strokes(drawn.sketch)
        assert parts.roles == () and parts.roots == [] and parts.parts == () and parts.crowns == () and parts.ground == (), drawn.sketch.name
