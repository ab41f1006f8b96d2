"""Skeletons from files, told by their endings."""

import numpy as np
import pytest

from sketchtree.errors import SkeletonError
from sketchtree.export.skeletons import write_skeleton_json, write_swc
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.skeleton_files import read_npz, read_skeleton
from sketchtree.skeleton_hdf5 import write_skeleton_hdf5

PARENT = np.array([-1, 0, 1, 1, 2])
POS = np.array([[0, 0, 0], [0, 1, 0], [0, 2, 0], [1, 1.5, 0], [0, 3, 0.5]], float)
RADIUS = np.array([0.3, 0.2, 0.1, 0.05, 0.04])


def _npz(folder, name="t.npz", **changed):
    columns = {"parent": PARENT, "pos": POS, "radius": RADIUS} | changed
    np.savez(folder / name, **{k: v for k, v in columns.items() if v is not None})
    return folder / name


def test_an_npz_s_columns_become_the_tree_s(tmp_path):
    tree = read_npz(_npz(tmp_path))
    np.testing.assert_array_equal(tree.parent, PARENT)
    np.testing.assert_array_equal(tree.tip, POS)
    np.testing.assert_array_equal(tree.radius, RADIUS)
    assert (tree.kind == int(Kind.OBSERVED)).all() and (tree.tree == 0).all()


def test_limbs_follow_the_thickest_child_and_the_straightest_of_equals(tmp_path):
    tree = read_npz(_npz(tmp_path))
    assert tree.order.tolist() == [0, 0, 0, 1, 0]
    assert tree.limb[2] == tree.limb[0] != tree.limb[3]
    aside = read_npz(_npz(tmp_path, radius=np.array([0.3, 0.2, 0.05, 0.1, 0.04])))
    assert aside.order.tolist() == [0, 0, 1, 0, 1]
    equal = read_npz(_npz(tmp_path, radius=np.full(5, 0.1)))
    assert equal.order.tolist() == [0, 0, 0, 1, 0]


def test_rows_in_any_order_are_put_parents_first(tmp_path):
    order = np.array([4, 3, 2, 1, 0])
    back = np.argsort(order)
    parent = np.where(PARENT[order] < 0, -1, back[PARENT[order]])
    tree = read_npz(_npz(tmp_path, parent=parent, pos=POS[order], radius=RADIUS[order]))
    assert (tree.parent < np.arange(5)).all()
    start = tree.tip[np.maximum(tree.parent, 0)]
    pairs = {(tuple(a), tuple(b)) for a, b in zip(tree.tip, start, strict=True)}
    assert pairs == {(tuple(a), tuple(b)) for a, b in zip(POS, POS[np.maximum(PARENT, 0)], strict=True)}


def test_radii_that_are_not_known_become_the_median_of_those_that_are(tmp_path):
    tree = read_npz(_npz(tmp_path, radius=np.array([0.3, np.nan, 0.1, -1.0, 0.2])))
    np.testing.assert_allclose(tree.radius, [0.3, 0.2, 0.1, 0.2, 0.2])
    assert (read_npz(_npz(tmp_path, radius=np.full(5, np.nan))).radius == 1e-3).all()


def test_several_bases_are_several_trees(tmp_path):
    tree = read_npz(_npz(tmp_path, parent=np.array([-1, 0, -1, 2, 3])))
    assert tree.tree.tolist() == [0, 0, 1, 1, 1]


@pytest.mark.parametrize(
    "changed, message",
    [
        ({"radius": None}, "{path} holds no skeleton. Give an .npz file with the arrays `parent`, `pos` and `radius`."),
        ({"parent": np.array(["a"] * 5)}, "{path} holds no skeleton. Give an .npz file with the arrays `parent`, `pos` and `radius`."),
        ({"pos": np.array([object()] * 5)}, "{path} holds no skeleton. Give an .npz file with the arrays `parent`, `pos` and `radius`."),
        ({"pos": POS[:, :2]}, "{path}: `parent`, `pos` and `radius` have different lengths. Give one row a node, three columns of `pos`."),
        ({"radius": RADIUS[:4]}, "{path}: `parent`, `pos` and `radius` have different lengths. Give one row a node, three columns of `pos`."),
        ({"parent": np.array([1, 0, 1, 1, 2])}, "{path}: some nodes hang in a circle. Give every branch a path to a node whose parent is -1."),
    ],
    ids=["no radius", "words", "objects", "flat", "short", "circle"],
)
def test_an_npz_that_holds_no_tree_is_named(tmp_path, changed, message):
    path = _npz(tmp_path, **changed)
    with pytest.raises(SkeletonError) as raised:
        read_npz(path)
    assert str(raised.value) == message.format(path=path)


@pytest.mark.parametrize(
    "changed",
    [{"parent": np.array([-1, 0, 1, 1, 9])}, {"parent": np.zeros(0, int), "pos": np.zeros((0, 3)), "radius": np.zeros(0)}],
    ids=["no such parent", "empty"],
)
def test_a_parent_that_is_not_in_the_file_and_a_file_without_nodes_are_named(tmp_path, changed):
    with pytest.raises(SkeletonError, match=r"t\.npz"):
        read_npz(_npz(tmp_path, **changed))


def test_positions_that_are_not_finite_are_named(tmp_path):
    with pytest.raises(SkeletonError, match="Row 3"):
        read_npz(_npz(tmp_path, pos=np.where(np.arange(5)[:, None] == 3, np.nan, POS)))


def test_a_file_that_is_no_npz_is_named(tmp_path):
    (tmp_path / "t.npz").write_bytes(b"no zip")
    with pytest.raises(SkeletonError) as raised:
        read_npz(tmp_path / "t.npz")
    assert str(raised.value) == f"{tmp_path / 't.npz'} holds no skeleton. Give an .npz file with the arrays `parent`, `pos` and `radius`."


def test_an_empty_file_is_named(tmp_path):
    (tmp_path / "t.npz").write_bytes(b"")
    with pytest.raises(SkeletonError, match=r"t\.npz"):
        read_npz(tmp_path / "t.npz")


def test_a_torn_file_is_named(tmp_path):
    whole = _npz(tmp_path).read_bytes()
    (tmp_path / "t.npz").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(SkeletonError, match=r"t\.npz holds no skeleton"):
        read_npz(tmp_path / "t.npz")


def test_a_file_that_is_not_there_is_named(tmp_path):
    for name in ("t.npz", "t.swc", "t.json"):
        with pytest.raises(SkeletonError) as raised:
            read_skeleton(tmp_path / name)
        assert str(raised.value) == f"Can't read {tmp_path / name}: no such file or directory. Check the path."


def test_every_ending_has_its_reader(tmp_path):
    tree = TreeSkeleton.from_columns(PARENT, POS, RADIUS, limb=np.array([0, 0, 0, 3, 0]), order=np.array([0, 0, 0, 1, 0]))
    write_swc(tmp_path / "t.SWC", tree, header={})
    write_skeleton_json(tmp_path / "t.Json", tree)
    _npz(tmp_path, "t.npz")
    for name in ("t.SWC", "t.Json", "t.npz"):
        found = read_skeleton(tmp_path / name)
        np.testing.assert_allclose(found.tip, POS)
        np.testing.assert_array_equal(found.order, tree.order)
        np.testing.assert_allclose(read_skeleton(str(tmp_path / name)).radius, RADIUS)


@pytest.mark.parametrize("name", ["t.glb", "t", "t.swc.gz"])
def test_another_ending_is_named(tmp_path, name):
    with pytest.raises(SkeletonError) as raised:
        read_skeleton(tmp_path / name)
    assert str(raised.value) == f"{tmp_path / name} is no skeleton that can be read. Give a file that ends in one of .swc, .json, .npz, .mtg, .csv, .txt, .h5, .sketchtree."


def test_an_id_beyond_what_a_number_holds_is_named_and_a_byte_order_mark_is_none(tmp_path):
    (tmp_path / "t.swc").write_text("99999999999999999999 0 0 0 0 1 -1\n")
    with pytest.raises(SkeletonError, match=r"t\.swc, line 1: expected `id type x y z radius parent`"):
        read_skeleton(tmp_path / "t.swc")
    (tmp_path / "t.swc").write_text("\ufeff1 0 0 0 0 1 -1\n2 0 0 1 0 1 1\n", encoding="utf-8")
    assert len(read_skeleton(tmp_path / "t.swc")) == 2


def test_json_with_a_column_missing_is_named(tmp_path):
    (tmp_path / "t.json").write_text('{"sketchtree_skeleton": 1, "columns": {"parent": [-1]}}')
    with pytest.raises(SkeletonError, match=r"t\.json: a column is missing or holds no numbers"):
        read_skeleton(tmp_path / "t.json")


@pytest.mark.parametrize("ending", ["swc", "json", "npz", "mtg", "csv", "h5"])
def test_torn_and_altered_files_are_read_or_refused(tmp_path, ending):
    """Bytes changed, cut out and put in at random: a tree or a `SkeletonError`, never another error."""
    tree = TreeSkeleton.from_columns(PARENT, POS, RADIUS, limb=np.array([0, 0, 0, 3, 0]), order=np.array([0, 0, 0, 1, 0]))
    path, rng = tmp_path / f"t.{ending}", np.random.default_rng(5)
    table = "id,parent,x,y,z,endX,endY,endZ,radius\n1,0,0,0,0,0,1,0,.2\n2,1,0,1,0,0,2,0,.1\n"
    mtg = "FEATURES:\nXX\tREAL\nMTG:\nENTITY-CODE\t\tXX\tYY\tZZ\n/P1\t\t0\t0\t0\n^/E1<<E4\t\t0\t0\t9\n\t+E1\t3\t0\t9\n"
    write = {
        "swc": lambda: write_swc(path, tree, header={}), "json": lambda: write_skeleton_json(path, tree), "npz": lambda: _npz(tmp_path),
        "mtg": lambda: path.write_text(mtg), "csv": lambda: path.write_text(table), "h5": lambda: write_skeleton_hdf5(path, tree),
    }  # fmt: skip
    write[ending]()
    whole = path.read_bytes()
    assert len(read_skeleton(path)) >= 3
    for _ in range(60):
        data, at = bytearray(whole), int(rng.integers(len(whole)))
        new = [bytes([rng.integers(256)]), b"", b"9999999999", b"nan", b"\n", b"\t"][rng.integers(6)]
        data[at : at + int(rng.integers(30))] = new
        path.write_bytes(data)
        try:
            read_skeleton(path)
        except SkeletonError as error:
            assert str(path) in str(error)
