import dataclasses
import json

import numpy as np
import pytest
from shapes import curved, square

from sketchtree.errors import ExportError, SkeletonError
from sketchtree.export.gltf import read_glb_skeleton, write_glb
from sketchtree.export.skeletons import write_skeleton_json, write_swc
from sketchtree.export.skeletons.packed import skeleton_extras, skeleton_from_extras
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_files import read_skeleton_json, read_swc

COLUMNS = [field.name for field in dataclasses.fields(TreeSkeleton)]
HEADER = {"units": "m", "frame": "world", "version": "0.1.0", "seed": 0}


def rows_of(path):
    return [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]


def test_swc_text_is_exactly_this(tmp_path):
    write_swc(tmp_path / "t.swc", curved(), header=HEADER)
    lines = (tmp_path / "t.swc").read_text().splitlines()
    assert lines[1:5] == ["# units: m", "# frame: world", "# version: 0.1.0", "# seed: 0"]
    assert lines[6:] == [
        "1 0 0 0 0 0.3 -1",
        "2 0 0 1 0 0.2 1",
        "3 0 0 1.25 0 0.177098005 2",
        "4 0 0 1.5 0 0.154196011 3",
        "5 5 0.1 2 0.3 0.1 4",
        "6 6 0.5 3 0 0.05 5",
        "7 6 -0.5 3 0.333333333 0.04 5",
    ]


def test_swc_ids_count_from_one_and_parents_come_first(tmp_path):
    write_swc(tmp_path / "t.swc", curved(), header={})
    table = np.array(rows_of(tmp_path / "t.swc"), float)
    np.testing.assert_array_equal(table[:, 0], np.arange(1, len(table) + 1))
    assert (table[:, 6] < table[:, 0]).all()


def test_swc_round_trip(tmp_path):
    tree = curved()
    write_swc(tmp_path / "t.swc", tree, header=HEADER)
    back = read_swc(tmp_path / "t.swc")
    np.testing.assert_allclose(back.tip[[0, 1, 4, 5, 6]], tree.tip, rtol=1e-9)
    np.testing.assert_array_equal(back.parent, [-1, 0, 1, 2, 3, 4, 4])
    np.testing.assert_array_equal(back.order, [0, 0, 0, 0, 0, 0, 1])
    write_swc(tmp_path / "u.swc", back, header=HEADER)
    assert (tmp_path / "u.swc").read_text() == (tmp_path / "t.swc").read_text()


def test_swc_of_two_stems(tmp_path):
    tree = TreeSkeleton.from_columns(np.array([-1, 0, -1, 2]), np.array([(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0.0)]), np.full(4, 0.1))
    write_swc(tmp_path / "t.swc", tree, header={})
    assert [row[6] for row in rows_of(tmp_path / "t.swc")] == ["-1", "1", "-1", "3"]
    np.testing.assert_array_equal(read_swc(tmp_path / "t.swc").tree, [0, 0, 1, 1])


def test_a_foreign_swc_in_any_order_is_read(tmp_path):
    (tmp_path / "t.swc").write_text("# from elsewhere\n\n 30 3 0 2 0 0.1 20 extra\n20 3 0 1 0 0 10\n10 1 0 0 0 0.2 -1\n")
    tree = read_swc(tmp_path / "t.swc")
    np.testing.assert_allclose(tree.tip[:, 1], [0, 1, 2])
    assert tree.radius[1] == 0.1  # the smallest positive one


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "holds no nodes"),
        ("1 0 0 0\n", "line 1: expected `id type x y z radius parent`, got `1 0 0 0`"),
        ("1 0 0 0 nan 1 -1\n", "line 1: expected"),
        ("1 0 0 0 0 1 -1\n2 0 0 1 0 1 9\n", "line 2: its parent 9 is not in the file"),
        ("1 0 0 0 0 1 -1\n1 0 0 1 0 1 -1\n", "the id 1 stands twice"),
        ("1 0 0 0 0 1 2\n2 0 0 1 0 1 1\n", "some nodes hang in a circle"),
    ],
    ids=["empty", "short", "nan", "orphan", "twin", "circle"],
)
def test_what_is_wrong_in_an_swc_is_named(tmp_path, text, message):
    (tmp_path / "t.swc").write_text(text)
    with pytest.raises(SkeletonError, match=message):
        read_swc(tmp_path / "t.swc")


def test_an_swc_that_is_not_there_is_named(tmp_path):
    with pytest.raises(SkeletonError, match="Can't read .*: no such file or directory. Check the path."):
        read_swc(tmp_path / "t.swc")


def test_json_loses_nothing(tmp_path):
    tree = curved()
    write_skeleton_json(tmp_path / "t.json", tree, header=HEADER)
    back = read_skeleton_json(tmp_path / "t.json")
    for name in COLUMNS:
        np.testing.assert_array_equal(getattr(back, name), getattr(tree, name))


def test_json_is_strict_json(tmp_path):
    write_skeleton_json(tmp_path / "t.json", curved())
    content = json.loads((tmp_path / "t.json").read_text(), parse_constant=lambda word: pytest.fail(word))
    assert content["sketchtree_skeleton"] == 1 and content["columns"]["depth_sd"][2] is None


@pytest.mark.parametrize("text", ["{}", "[1]", "no json", '"x"'])
def test_another_json_is_named(tmp_path, text):
    (tmp_path / "t.json").write_text(text)
    with pytest.raises(SkeletonError, match="is not a skeleton of ours. Give a JSON file written by `sketchtree`."):
        read_skeleton_json(tmp_path / "t.json")


def test_a_newer_json_is_named(tmp_path):
    (tmp_path / "t.json").write_text('{"sketchtree_skeleton": 9}')
    with pytest.raises(SkeletonError, match="has skeleton format 9; this version reads 1. Update sketchtree."):
        read_skeleton_json(tmp_path / "t.json")


@pytest.mark.parametrize("place", [lambda extras: extras, lambda extras: {"sketchtree": extras, "seed": 1}], ids=["bare", "nested"])
def test_a_glb_holds_its_skeleton(tmp_path, place):
    tree = curved()
    write_glb(tmp_path / "t.glb", [square()], extras=place(skeleton_extras(tree)))
    back = read_glb_skeleton(tmp_path / "t.glb")
    for name in COLUMNS:
        np.testing.assert_allclose(getattr(back, name), getattr(tree, name), rtol=1e-6, atol=1e-7)
    np.testing.assert_array_equal(back.limb, tree.limb)


def test_extras_are_small():
    rows = 2000
    tree = TreeSkeleton.from_columns(np.arange(rows) - 1, np.random.default_rng(0).normal(size=(rows, 3)), np.full(rows, 0.1))
    assert len(json.dumps(skeleton_extras(tree))) < 25 * rows


def test_a_glb_without_a_skeleton_is_named(tmp_path):
    write_glb(tmp_path / "t.glb", [square()])
    with pytest.raises(ExportError, match="holds no skeleton. Give a GLB file written by `sketchtree build`."):
        read_glb_skeleton(tmp_path / "t.glb")


def test_extras_of_another_kind_are_named():
    with pytest.raises(SkeletonError, match="There is no skeleton of ours here"):
        skeleton_from_extras({"rows": 3})


def test_an_empty_tree_is_written(tmp_path):
    tree = TreeSkeleton.from_columns(np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))
    write_swc(tmp_path / "t.swc", tree, header={})
    assert rows_of(tmp_path / "t.swc") == []
    assert len(skeleton_from_extras(skeleton_extras(tree))) == 0
