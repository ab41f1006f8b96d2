"""Real drawings, where a folder of them lies beside the checkout: each a tree, or an error that says why not."""

from pathlib import Path

import numpy as np
import pytest

import sketchtree as st

SHARED = Path(__file__).resolve().parents[2] / "shared" / "data"
BLOSSOMS = sorted((SHARED / "sketches" / "svg").glob("rp_blossomTree*.svg"))
CASES = sorted((SHARED / "sketch_cases").glob("*.svg"))
QUICKDRAW = sorted((SHARED / "sketches" / "quickdraw").glob("*.svg"))
KEY = st.root_key(0)

if not SHARED.exists():
    pytest.skip("the folder of shared drawings is not beside this checkout", allow_module_level=True)


@pytest.mark.parametrize("path", BLOSSOMS, ids=lambda path: path.stem)
def test_blossom_trees_become_leafy_trees(path):
    tree = st.sketch_to_tree(path, key=KEY, reading=st.ReadingOptions(method="okabe"))
    assert tree.drawn.graph.segment_count >= 9 and len(tree.leaves) > 500


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_drawings_with_known_depth_are_lifted_without_leaving_the_page(path):
    drawn = st.draw_out(path, key=KEY, options=st.ReadingOptions(method="okabe"))
    page = drawn.similarity.to_sketch(drawn.skeleton.tip)[:, :2]
    assert np.abs(page - drawn.graph.xy).max() <= 1e-6 * drawn.graph.height
    assert np.ptp(drawn.fit.depth) > 0


@pytest.mark.parametrize("path", QUICKDRAW, ids=lambda path: path.stem)
def test_quick_drawings_are_trees_or_say_there_are_no_branches(path):
    try:
        graph = st.sketch_graph(st.read_sketch(path))
    except st.SketchError as error:
        assert error.remedy
    else:
        assert graph.segment_count >= 1
