"""PLY: text or binary, either byte order; place, colour and normal are taken, the rest is passed over."""

import struct

import numpy as np
import pytest
from written import place, ply, points

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.read_cloud import read_cloud, read_placed
from sketchtree.clouds.files.write_cloud import write_cloud
from sketchtree.errors import ExportError, SketchError

XYZ = points()


def read(tmp_path, data: bytes):
    (tmp_path / "cloud.ply").write_bytes(data)
    return read_placed(tmp_path / "cloud.ply")


def refused(tmp_path, data: bytes) -> str:
    with pytest.raises(SketchError) as error:
        read(tmp_path, data)
    return str(error.value)


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("kind", ["float", "double"])
def test_either_byte_order_and_either_precision(tmp_path, order, kind):
    np.testing.assert_array_equal(read(tmp_path, ply(place(XYZ, kind), order)).cloud.xyz, XYZ)


def test_text_is_read_as_well(tmp_path):
    head = "ply\r\nformat ascii 1.0\r\nelement vertex 2\r\nproperty float x\r\nproperty float y\r\nproperty uchar alpha\r\nproperty float z\r\nend_header\r\n"
    np.testing.assert_array_equal(read(tmp_path, (head + "1 2 9 3\r\n4 5 9 6.5\r\n").encode()).cloud.xyz, [[1, 2, 3], [4, 5, 6.5]])


@pytest.mark.parametrize(("kind", "full"), [("uchar", 255), ("ushort", 65535), ("float", 1.0)])
def test_colours_are_0_to_1_however_they_are_written(tmp_path, kind, full):
    colour = np.linspace(0, 1, len(XYZ))
    cloud = read(tmp_path, ply(place(XYZ) + [(kind, name, np.round(colour * full) if full > 1 else colour) for name in ("red", "green", "blue")])).cloud
    np.testing.assert_allclose(cloud.colour[:, 1], colour, atol=0.003)


def test_normals_have_length_1(tmp_path):
    cloud = read(tmp_path, ply(place(XYZ) + [("float", name, np.full(len(XYZ), 2.0)) for name in ("nx", "ny", "nz")])).cloud
    np.testing.assert_allclose(cloud.normal, 3**-0.5, atol=1e-6)


def test_normals_without_direction_are_all_passed_over_and_that_is_said(tmp_path):
    placed = read(tmp_path, ply(place(XYZ) + [("float", name, np.zeros(len(XYZ))) for name in ("nx", "ny", "nz")]))
    assert placed.cloud.normal is None
    assert placed.remarks == ("Some normals of cloud.ply have no direction; all were passed over.",)


def test_other_properties_are_passed_over(tmp_path):
    np.testing.assert_array_equal(read(tmp_path, ply([("int", "label", np.arange(len(XYZ))), *place(XYZ), ("double", "time", XYZ[:, 0])])).cloud.xyz, XYZ)


def test_of_a_mesh_the_vertices_are_taken_and_that_is_said(tmp_path):
    placed = read(tmp_path, ply(place(XYZ), after=b"\x03" + struct.pack("<3i", 0, 1, 2)))
    np.testing.assert_array_equal(placed.cloud.xyz, XYZ)
    assert placed.remarks == ("cloud.ply is a mesh; its 50 vertices were taken as points, its 2 faces were not.",)


def test_elements_before_the_vertices_are_left_behind(tmp_path):
    head = "element camera 1\nproperty double view\nelement range 2\nproperty list uchar int which"
    before = struct.pack("<d", 1.0) + b"\x02" + struct.pack("<2i", 5, 6) + b"\x00"
    np.testing.assert_array_equal(read(tmp_path, ply(place(XYZ), before=before, head=head)).cloud.xyz, XYZ)


def test_vertices_may_have_lists(tmp_path):
    head = b"ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty list uchar float seen\nproperty float y\nproperty float z\nend_header\n"
    data = struct.pack("<fB2fff", 1, 2, 8, 8, 2, 3) + struct.pack("<fBff", 4, 0, 5, 6)
    np.testing.assert_array_equal(read(tmp_path, head + data).cloud.xyz, [[1, 2, 3], [4, 5, 6]])
    np.testing.assert_array_equal(read(tmp_path, head.replace(b"binary_little_endian", b"ascii") + b"1 2 8 8 2 3\n4 0 5 6\n").cloud.xyz, [[1, 2, 3], [4, 5, 6]])


@pytest.mark.parametrize(("comment", "up"), [("comment up: +y", "y"), ("comment vertical axis: z", "z"), ("comment made up of points", None)])
def test_a_comment_may_say_which_axis_is_up(tmp_path, comment, up):
    assert read(tmp_path, ply(place(XYZ), head=comment)).says_up == up


def test_a_file_that_was_cut_off_is_named(tmp_path):
    assert refused(tmp_path, ply(place(XYZ))[:-100]) == "cloud.ply ends after 41 of its 50 points. The file was cut off: copy or export it again."
    text = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n"
    assert refused(tmp_path, text) == "cloud.ply ends after 1 of its 3 points. The file was cut off: copy or export it again."


def test_a_word_among_numbers_is_named_by_its_line(tmp_path):
    text = b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n4 five 6\n"
    assert refused(tmp_path, text) == "Line 9 of cloud.ply has `five` where a number should stand. Mend that line, or take it out."


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n", "cloud.ply holds no points."),
        (b"ply\nformat ascii 1.0\nelement face 1\nproperty int x\nend_header\n1\n", "cloud.ply is a PLY file without vertices."),
        (b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n1 2\n", "The vertices of cloud.ply have no z."),
        (b"ply\nformat ascii 1.0\nelement vertex 1\n", "cloud.ply is a PLY file whose header has no end."),
        (b"ply\nelement vertex 1\nend_header\n", "cloud.ply is a PLY file that doesn't say how its numbers are written (`format`)."),
        (b"ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n", "Line 4 of cloud.ply is `property quad x`, which no PLY header has."),
    ],
)
def test_a_header_that_makes_no_sense_is_named(tmp_path, data, says):
    assert refused(tmp_path, data).startswith(says)


def test_what_was_written_is_read_back(tmp_path):
    cloud = PointCloud(XYZ, np.linspace(0, 1, 150).reshape(50, 3), XYZ / np.linalg.norm(XYZ, axis=1, keepdims=True))
    write_cloud(cloud, tmp_path / "c.ply", ("of a test",))
    back = read_cloud(tmp_path / "c.ply")
    np.testing.assert_array_equal(back.xyz, XYZ)
    np.testing.assert_allclose(back.colour, cloud.colour, atol=0.002)
    np.testing.assert_allclose(back.normal, cloud.normal, atol=1e-6)
    assert read_placed(tmp_path / "c.ply").says_up == "y"


def test_only_ply_is_written(tmp_path):
    with pytest.raises(ExportError, match=r"`\.las` files are not written"):
        write_cloud(PointCloud(XYZ), tmp_path / "c.las")
    with pytest.raises(ExportError, match="A comment of the cloud is not one line of plain text"):
        write_cloud(PointCloud(XYZ), tmp_path / "c.ply", ("a\nb",))
