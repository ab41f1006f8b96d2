"""Tables of cylinders under the spellings that programs use, and our HDF5."""

import h5py
import numpy as np
import pytest

from sketchtree.errors import SkeletonError
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_cylinders import read_cylinders
from sketchtree.skeleton_files import read_skeleton
from sketchtree.skeleton_hdf5 import read_skeleton_hdf5, write_skeleton_hdf5

# radius length start axis parent extension added unmodified branch order place: a trunk of two, a lateral beside the lower one's end
TREEQSM = np.array([
    [0.20, 1.0, 5, 5, 1, 0, 0, 1, 0, 2, 0, 0.20, 1, 0, 1],
    [0.15, 1.0, 5, 5, 2, 0, 0, 1, 1, 0, 0, 0.15, 1, 0, 2],
    [0.05, 0.5, 5.1, 5, 1.9, 1, 0, 0, 1, 0, 0, 0.05, 2, 1, 1],
    [0.04, 0.5, 5.1, 5, 2.1, 0, 1, 0, 2, 0, 0, 0.04, 3, 1, 1],
])  # fmt: skip
TIP = [[5, 5, 1], [5, 5, 2], [5, 5, 3], [5.6, 5, 1.9], [5.1, 5.5, 2.1]]


def _check(tree):
    by_tip = {tuple(np.round(tip, 6)): row for row, tip in enumerate(tree.tip.tolist())}
    base, lower, upper, first, second = (by_tip[tuple(map(float, tip))] for tip in TIP)
    assert tree.parent[[base, lower, upper, first, second]].tolist() == [-1, base, lower, lower, lower]
    assert tree.order[[base, lower, upper, first, second]].tolist() == [0, 0, 0, 1, 1]
    assert tree.limb[base] == tree.limb[lower] == tree.limb[upper] and len(set(tree.limb.tolist())) == 3
    np.testing.assert_allclose(tree.radius[[base, lower, upper, first, second]], [0.2, 0.2, 0.15, 0.05, 0.04])


def test_treeqsm_without_names(tmp_path):
    """The last cylinder starts nearer to its parent's start than to its end, and stands there."""
    np.savetxt(tmp_path / "q.txt", TREEQSM, delimiter="\t")
    _check(read_skeleton(tmp_path / "q.txt"))


@pytest.mark.parametrize("cut", [",", ";", "\t", " "])
def test_named_columns_with_ends_and_ids(tmp_path, cut):
    names = ["ID", "parentID", "startX", "startY", "startZ", "endX", "endY", "endZ", "radius", "branchID"]
    end = TREEQSM[:, 2:5] + TREEQSM[:, 1:2] * TREEQSM[:, 5:8]
    table = np.column_stack([np.arange(4), TREEQSM[:, 8] - 1, TREEQSM[:, 2:5], end, TREEQSM[:, 0], TREEQSM[:, 12]])
    np.savetxt(tmp_path / "q.csv", table, delimiter=cut, header=cut.join(names), comments="")
    _check(read_cylinders(tmp_path / "q.csv"))


@pytest.mark.parametrize(
    "names",
    [
        "radius_cyl,length,startX,startY,startZ,axisX,axisY,axisZ,parent_ID,axis_ID",
        '"radius","length","start.1","start.2","start.3","axis.1","axis.2","axis.3","parent","branch"',
        " Radius, Length, x, y, z, ax, ay, az, Parent, Branch_ID",
    ],
)
def test_other_spellings(tmp_path, names):
    rows = "\n".join(",".join(f"{x:.9g}" for x in row) for row in TREEQSM[:, [0, 1, 2, 3, 4, 5, 6, 7, 8, 12]])
    (tmp_path / "q.csv").write_text(f"{names}\n{rows}\n")
    _check(read_cylinders(tmp_path / "q.csv"))


def test_without_branches_the_order_tells_and_without_both_thickness(tmp_path):
    names = "radius,length,x,y,z,ax,ay,az,parent,BranchOrder"
    rows = [[0.2, 1, 0, 0, 0, 0, 0, 1, 0, 0], [0.05, 1, 0, 0, 1, 0, 0, 1, 1, 0], [0.1, 1, 0, 0, 1, 1, 0, 0, 1, 1]]
    text = "\n".join(",".join(map(str, row)) for row in rows)
    (tmp_path / "q.csv").write_text(f"{names}\n{text}\n")
    by_order = read_cylinders(tmp_path / "q.csv")
    (tmp_path / "q.csv").write_text("\n".join(line.rsplit(",", 1)[0] for line in f"{names}\n{text}".splitlines()))
    by_thickness = read_cylinders(tmp_path / "q.csv")
    upright = [int(np.flatnonzero(tree.tip[:, 2] == 2)[0]) for tree in (by_order, by_thickness)]
    assert by_order.order[upright[0]] == 0 and by_thickness.order[upright[1]] == 1


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", r"q\.csv is empty"),
        ("1,2,3\n", r"q\.csv, line 1: 3 numbers and no names of columns\. Let the first line name the columns"),
        ("radius,x,y,z,parent\n1,0,0,0,0\n", r"there is no column for length \(looked for `length`, `len`\)\. Name the column so"),
        ("radius,length,x,y,z,ax,ay,az,parent\n", r"q\.csv has no cylinders"),
        ("radius,length,x,y,z,ax,ay,az,parent\n1,1,0,0,0,0,0,one,0\n", r"q\.csv, line 2: expected 9 columns of numbers, got `1,1,0,0,0,0,0,one,0`"),
        ("radius,length,x,y,z,ax,ay,az,parent\n1,1,0,0,0,0,0\n", r"q\.csv, line 2: expected 9 columns of numbers"),
        ("radius,length,x,y,z,ax,ay,az,parent\n1,1,0,0,0,0,0,nan,0\n", r"q\.csv, line 2: expected 9 columns of numbers"),
        ("radius,length,x,y,z,ax,ay,az,parent\n1,1,0,0,0,0,0,1,7\n", r"line 2: its parent 7 is not in the file\. Name the id of a cylinder, or 0"),
        ("radius,length,x,y,z,ax,ay,az,parent\n1,1,0,0,0,0,0,1,1\n", r"no cylinder stands on the ground"),
        ("radius,length,x,y,z,ax,ay,az,parent,id\n" + "1,1,0,0,0,0,0,1,0,4\n" * 2, r"line 3: the id 4 stands twice"),
        ("radius,length,x,y,z,ax,ay,az,parent\n1,1,0,0,0,0,0,1,0\n1,1,0,0,0,0,0,1,3\n1,1,0,0,0,0,0,1,2\n", r"some nodes hang in a circle"),
    ],
)
def test_what_is_wrong_is_named(tmp_path, text, says):
    (tmp_path / "q.csv").write_text(text)
    with pytest.raises(SkeletonError, match=says):
        read_cylinders(tmp_path / "q.csv")


def test_hdf5_there_and_back(tmp_path):
    tree = TreeSkeleton.from_columns(
        np.array([-1, 0, 1]), np.arange(9.0).reshape(3, 3), np.array([0.3, 0.2, 0.1]), limb=np.array([2**62, 2**62, 5]),
        order=np.array([0, 0, 1]), curve_points=np.ones((1, 3)), curve_start=np.array([0, 0, 1, 1]),
    )  # fmt: skip
    write_skeleton_hdf5(tmp_path / "t.h5", tree)
    back = read_skeleton(tmp_path / "t.h5")
    for name in ("parent", "tip", "radius", "limb", "order", "kind", "depth_sd", "curve_points", "curve_start"):
        np.testing.assert_array_equal(getattr(back, name), getattr(tree, name))
    with h5py.File(tmp_path / "t.h5", "a") as file:
        for name in ("curve_points", "age", "limb"):
            del file[name]
    assert len(read_skeleton_hdf5(tmp_path / "t.h5").curve_points) == 0
    with h5py.File(tmp_path / "t.h5", "a") as file:
        file.attrs["schema"] = 9
    with pytest.raises(SkeletonError, match="has skeleton schema 9; this version reads 1"):
        read_skeleton_hdf5(tmp_path / "t.h5")


def test_hdf5_that_is_none_or_another_s_is_named(tmp_path):
    (tmp_path / "t.h5").write_bytes(b"no")
    with pytest.raises(SkeletonError, match=r"t\.h5 is no HDF5 file, or is damaged"):
        read_skeleton_hdf5(tmp_path / "t.h5")
    with h5py.File(tmp_path / "t.h5", "w") as file:
        file["x"] = 1
    with pytest.raises(SkeletonError, match=r"t\.h5 is an HDF5 file, but holds no skeleton"):
        read_skeleton_hdf5(tmp_path / "t.h5")
    with h5py.File(tmp_path / "t.h5", "w") as file:
        file.attrs["format"], file.attrs["schema"] = "SketchTree skeleton", 1
    with pytest.raises(SkeletonError, match=r"t\.h5 has no column `parent`"):
        read_skeleton_hdf5(tmp_path / "t.h5")
    with pytest.raises(SkeletonError, match=r"Can't read .*none\.h5: no such file"):
        read_skeleton_hdf5(tmp_path / "none.h5")
