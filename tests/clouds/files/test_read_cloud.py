"""Any file: read by what it holds; bounded in memory; everything that is no cloud is named."""

import numpy as np
import pytest
from written import place, ply, points

from sketchtree.clouds.files.placed import Placement
from sketchtree.clouds.files.read_cloud import read_cloud, read_placed
from sketchtree.errors import OptionError, SketchError

XYZ = points()


def refused(tmp_path, data: bytes, name: str = "cloud.dat") -> str:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(SketchError) as error:
        read_cloud(tmp_path / name)
    return str(error.value)


def test_a_file_is_read_by_what_it_holds_not_by_its_name(tmp_path):
    (tmp_path / "cloud.las").write_bytes(ply(place(XYZ)))
    assert read_placed(tmp_path / "cloud.las").what == "PLY"


@pytest.mark.parametrize("key", ["xyz", "points"])
def test_npz_has_points_and_colours_by_name(tmp_path, key):
    np.savez(tmp_path / "c.npz", **{key: XYZ, "colours": np.full((50, 4), 51, np.uint8), "normals": np.tile([0.0, 2.0, 0.0], (50, 1))})
    cloud = read_cloud(tmp_path / "c.npz")
    np.testing.assert_array_equal(cloud.xyz, XYZ)
    np.testing.assert_allclose(cloud.colour, 0.2, atol=1e-6)
    np.testing.assert_array_equal(cloud.normal, np.tile([0.0, 1.0, 0.0], (50, 1)))


def test_npy_is_a_table_or_has_named_columns(tmp_path):
    np.save(tmp_path / "a.npy", np.c_[XYZ, np.zeros(50)])
    np.testing.assert_array_equal(read_cloud(tmp_path / "a.npy").xyz, XYZ)
    rows = np.zeros(50, [("X", "f8"), ("Y", "f8"), ("Z", "f8"), ("t", "i4")])
    rows["X"], rows["Y"], rows["Z"] = XYZ.T
    np.save(tmp_path / "b.npy", rows)
    np.testing.assert_array_equal(read_cloud(tmp_path / "b.npy").xyz, XYZ)


def test_a_unit_makes_metres_of_the_files_numbers(tmp_path):
    np.save(tmp_path / "a.npy", XYZ * 1000)
    placed = read_placed(tmp_path / "a.npy", unit=0.001)
    np.testing.assert_allclose(placed.cloud.xyz, XYZ)
    np.testing.assert_allclose(placed.placement.to_file(placed.cloud.xyz), XYZ * 1000)


def test_a_file_of_any_size_is_thinned_while_it_is_read_and_that_is_said(tmp_path):
    xyz = np.random.default_rng(1).uniform(size=(40_000, 3))
    np.save(tmp_path / "a.npy", xyz)
    placed = read_placed(tmp_path / "a.npy", max_points=2_000)
    assert 1_200 < len(placed.cloud) <= 2_000
    assert len(np.unique(np.floor(placed.cloud.xyz / placed.voxel), axis=0)) == len(placed.cloud)
    assert {tuple(row) for row in placed.cloud.xyz} <= {tuple(row) for row in xyz}
    assert placed.remarks == (f"a.npy holds 40,000 points; {len(placed.cloud):,} were kept, one in each voxel of {1000 * placed.voxel:.3g} mm.",)


def test_progress_is_told_from_0_to_1(tmp_path):
    np.save(tmp_path / "a.npy", XYZ)
    told = []
    read_cloud(tmp_path / "a.npy", progress=told.append)
    assert told[-1] == 1.0


@pytest.mark.parametrize("up", ["y", "z"])
def test_a_placement_goes_there_and_back(up):
    placement = Placement().then_turned(up).then_moved(np.array([1.0, -2.0, 3.0]))
    np.testing.assert_allclose(placement.to_file(placement.to_world(XYZ)), XYZ, atol=1e-12)
    assert placement.to_world(np.eye(3)["xyz".index(up)])[1] == pytest.approx(-1.0)


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"", "cloud.dat is empty. Export the cloud again."),
        (b"\x89PNG\r\n\x1a\n0000", "cloud.dat is a picture, which is not read as a point cloud. Give a folder of photos to `sketchtree views`."),
        (b"ASTM-E57\x00\x00", "cloud.dat is an E57 scan, which is not read as a point cloud. Convert it to LAZ or PLY (CloudCompare and PDAL do)."),
        (b"# .PCD v0.7\n", "cloud.dat is a PCD cloud, which is not read as a point cloud. Convert it to LAZ or PLY (CloudCompare and PDAL do)."),
        (b"v 1 2 3\nf 1 1 1\n", "cloud.dat is an OBJ mesh, which is not read as a point cloud. Save it as PLY."),
        (b"\x1f\x8b\x08\x00", "cloud.dat is a gzip archive, which is not read as a point cloud. Unpack it, and give the cloud inside."),
        ("1 2 3\n".encode("utf-16"), "cloud.dat is text in UTF-16, which is not read as a point cloud. Save it as plain text (UTF-8)."),
        (b"\x01\x02\x03\x00", "cloud.dat is no point cloud that is known here. Give PLY, LAS, LAZ, XYZ (or other text with x, y, z), NPZ or NPY."),
        (b"PK\x03\x04junk", "cloud.dat is an archive that was cut off. Copy or export it again."),
    ],
)
def test_what_is_no_cloud_is_named(tmp_path, data, says):
    assert refused(tmp_path, data) == says


def test_a_skeleton_is_no_cloud(tmp_path):
    np.savez(tmp_path / "t.npz", parent=np.array([-1]), pos=np.zeros((1, 3)))
    with pytest.raises(SketchError) as error:
        read_cloud(tmp_path / "t.npz")
    assert str(error.value) == "t.npz is a skeleton, not a point cloud. Give the scan it was made from."


@pytest.mark.parametrize(
    ("held", "says"),
    [
        ({"image": np.zeros((4, 4))}, "t.npz holds image; none is `xyz` or `points`."),
        ({"xyz": np.zeros((4, 2))}, "The points of t.npz are a table of shape (4, 2)."),
        ({"xyz": np.zeros((4, 3)), "rgb": np.zeros((3, 3))}, "The colours of t.npz are a table of shape (3, 3)."),
        ({"xyz": np.zeros((0, 3))}, "t.npz holds no points."),
        ({"xyz": np.full((4, 3), np.nan)}, "None of the 4 points of t.npz is a place."),
        ({"xyz": np.array([[None] * 3])}, "t.npz can't be read (Object arrays cannot be loaded when allow_pickle=False)."),
    ],
)
def test_arrays_that_are_no_cloud_are_named(tmp_path, held, says):
    np.savez(tmp_path / "t.npz", **held)
    with pytest.raises(SketchError) as error:
        read_cloud(tmp_path / "t.npz")
    assert str(error.value).startswith(says)


def test_a_missing_file_and_a_folder_are_named(tmp_path):
    with pytest.raises(SketchError, match=r"There is no file .*none\.ply\. Check the path\."):
        read_cloud(tmp_path / "none.ply")
    with pytest.raises(SketchError, match=r"is a folder, not a point cloud\. Give the cloud inside it; a folder of photos is for `sketchtree views`\."):
        read_cloud(tmp_path)


def test_a_limit_or_a_unit_that_makes_no_sense_is_refused(tmp_path):
    np.save(tmp_path / "a.npy", XYZ)
    with pytest.raises(OptionError, match=r"`max_points` is 5\. Keep 1000 points or more\."):
        read_cloud(tmp_path / "a.npy", max_points=5)
    with pytest.raises(OptionError, match=r"`unit` is 0\. Say how many metres 1 in the file means: 0\.001 for millimetres\."):
        read_cloud(tmp_path / "a.npy", unit=0)
    with pytest.raises(OptionError, match=r"^`unit` is 1e\+30\. Say how many metres 1 in the file means: 0\.001 for millimetres\.$"):
        read_cloud(tmp_path / "a.npy", unit=1e30)
