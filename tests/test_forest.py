"""Several sketches to one forest: each tree is its own, and all are in one table."""

import json
from pathlib import Path

import numpy as np
import pytest

from sketchtree import limb_ids
from sketchtree.errors import OptionError, SketchError
from sketchtree.forest import sketches_to_forest
from sketchtree.keys import root_key
from sketchtree.options import ReadingOptions, TreeOptions
from sketchtree.pipeline import sketch_to_tree
from sketchtree.skeleton import Kind
from sketchtree.templates.store.database import Database

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
APPLE, POPLAR = EXAMPLES / "apple.json", EXAMPLES / "poplar.svg"
READING = ReadingOptions(method="okabe")
KEY = root_key(0)


@pytest.fixture(scope="module")
def templates():
    return Database.open()


def forest(sketches, templates, spacing=None, **options):
    return sketches_to_forest(sketches, templates, key=KEY, spacing=spacing, reading=READING, tree=TreeOptions(generations=2, **options))


@pytest.fixture(scope="module")
def close(templates):
    return forest([APPLE, POPLAR, APPLE], templates, 2.0)


def test_the_drawn_branches_keep_their_projection_only_shifted(close):
    for tree, place in zip(close.trees, close.place, strict=True):
        drawn = tree.skeleton.kind == int(Kind.DRAWN)
        wanted = tree.drawn.skeleton.tip + place
        seen = {tuple(tip) for tip in tree.skeleton.tip[drawn]}
        assert all(tuple(tip) in seen for tip in wanted)


def test_far_apart_each_tree_is_the_tree_that_build_makes(templates):
    far = forest([APPLE, POPLAR], templates, 50.0)
    for sketch, tree, place in zip((APPLE, POPLAR), far.trees, far.place, strict=True):
        alone = sketch_to_tree(sketch, templates, key=KEY, reading=READING, tree=TreeOptions(generations=2))
        np.testing.assert_array_equal(tree.skeleton.tip, alone.skeleton.tip + place)
        np.testing.assert_array_equal(tree.skeleton.radius, alone.skeleton.radius)
        assert len(tree.leaves) == len(alone.leaves)


def test_the_same_sketch_twice_is_two_trees_even_far_apart(templates):
    one, two = forest([APPLE, APPLE], templates, 50.0).trees
    assert one.drawn is two.drawn
    assert one.skeleton.tip.shape != two.skeleton.tip.shape or not np.allclose(one.skeleton.tip, two.skeleton.tip - [50.0, 0, 0])


def test_one_table_holds_all_trees_and_uses_no_number_twice(close):
    whole = close.skeleton
    assert whole.segment_count == sum(tree.skeleton.segment_count for tree in close.trees)
    assert np.unique(whole.tree).tolist() == [0, 1, 2]
    for name in ("limb", "stroke"):
        column = getattr(whole, name)
        of_tree = [set(column[(whole.tree == k) & (column >= 0)].tolist()) for k in range(3)]
        assert not (of_tree[0] & of_tree[1]) and not (of_tree[0] & of_tree[2]) and not (of_tree[1] & of_tree[2])
    assert (whole.limb >= 0).all() and len(np.unique(whole.limb)) == sum(len(np.unique(t.skeleton.limb)) for t in close.trees)
    assert limb_ids.stroke_limb_id("a") >= 0


def test_meshes_are_named_by_their_trees(close):
    names = [mesh.name for mesh in close.meshes]
    assert len(set(names)) == len(names)
    assert {"wood_1", "wood_2", "wood_3"} <= set(names) and all(name.startswith(("wood", "leaf")) for name in names)
    assert sum(name.startswith("leaf") for name in names) == 3


def test_each_tree_has_its_own_template_bark_and_leaf(close):
    used = [tree.drawn.exemplar.name for tree in close.trees]
    assert used[0] == used[2] != used[1]


def test_one_sketch_is_the_tree_that_build_makes(templates):
    only = forest([APPLE], templates).trees[0]
    alone = sketch_to_tree(APPLE, templates, key=KEY, reading=READING, tree=TreeOptions(generations=2))
    np.testing.assert_array_equal(only.skeleton.tip, alone.skeleton.tip)


def test_pruning_counts_in_the_forests_own_frame(templates):
    cut = forest([APPLE, APPLE], templates, 6.0, prune=("x<7.0",), leaf="none")
    assert cut.skeleton.tip[:, 0].max() <= 7.0 + 1e-9
    whole = forest([APPLE, APPLE], templates, 6.0, leaf="none")
    np.testing.assert_array_equal(cut.trees[0].skeleton.tip, whole.trees[0].skeleton.tip)


@pytest.mark.parametrize("options", [dict(sag=1.0, shed=0.3), dict(light=0.8, shed_twigs=1.0), dict(fill=True)])
def test_everything_that_build_can_do_works_in_a_forest(options, templates):
    made = forest([APPLE, APPLE], templates, 1.5, leaf="none", **options)
    assert made.skeleton.segment_count > 2 * made.trees[0].drawn.graph.segment_count


def test_an_obstacle_stands_in_the_forests_frame(templates, tmp_path):
    import trimesh

    wall = trimesh.creation.box((0.2, 6.0, 8.0))
    wall.apply_translation((7.5, 3.0, 0.0))
    wall.export(tmp_path / "wall.stl")
    made = forest([APPLE, APPLE], templates, 6.0, obstacle=(str(tmp_path / "wall.stl"),), leaf="none")
    tree = made.trees[1].skeleton
    new = tree.tip[tree.kind == int(Kind.PROPAGATED)]
    assert not (np.abs(new[:, 0] - 7.5) < 0.1).any()


def test_a_sketch_that_fails_is_named(templates, tmp_path):
    (tmp_path / "empty.svg").write_text("")
    with pytest.raises(SketchError, match="empty.svg"):
        forest([APPLE, tmp_path / "empty.svg"], templates)
    with pytest.raises(SketchError, match="nowhere.svg"):
        forest([APPLE, tmp_path / "nowhere.svg"], templates)
    with pytest.raises(OptionError, match="apple.json: Pruning cuts the tree off at its foot"):
        forest([APPLE, APPLE], templates, 6.0, prune=("x<3",))


def test_a_drawing_of_a_file_that_holds_several_can_be_planted(templates, tmp_path):
    lines = [json.dumps({"drawing": [[[128, 128], [250, 20]], [[128, x], [120, 60]]]}) for x in (60, 200)]
    (tmp_path / "two.ndjson").write_text("\n".join(lines))
    made = forest([f"{tmp_path}/two.ndjson#1", f"{tmp_path}/two.ndjson#2", f"{tmp_path}/two.ndjson#1"], templates)
    assert made.copies == (0, 0, 1)


def test_trunks_in_each_other_and_segments_that_run_out_are_told(templates):
    made = forest([APPLE, APPLE], templates, 0.01, max_segments=500, leaf="none")
    assert any(warning.startswith("The trunks of apple.json and apple.json stand 0.01 m apart") for warning in made.warnings)
    assert any("max_segments = 250" in warning for warning in made.warnings)
    assert made.skeleton.segment_count <= 500
