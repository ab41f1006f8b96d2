"""LAS 1.0 to 1.4, point formats 0 to 10; LAZ by lazrs, record for record the same."""

import sys

import numpy as np
import pytest
from written import las, laz, points

from sketchtree.clouds.files.read_cloud import read_placed
from sketchtree.errors import SketchError

XYZ = np.round(points(200) * 3, 3)
COLOURED = (2, 3, 5, 7, 8, 10)


def read(tmp_path, data: bytes, name: str = "cloud.las"):
    (tmp_path / name).write_bytes(data)
    return read_placed(tmp_path / name)


@pytest.mark.parametrize("form", range(11))
def test_every_point_format(tmp_path, form):
    colour = np.arange(600).reshape(200, 3) * 100 if form in COLOURED else None
    placed = read(tmp_path, las(XYZ, form, (1, 4) if form >= 6 else (1, 2), colour))
    np.testing.assert_allclose(placed.cloud.xyz, XYZ, atol=1e-9)
    assert (placed.cloud.colour is None) == (colour is None)
    if colour is not None:
        np.testing.assert_allclose(placed.cloud.colour, colour / 65535, atol=1e-6)
    assert placed.says_up == "z"


@pytest.mark.parametrize("version", [(1, 0), (1, 1), (1, 2), (1, 3), (1, 4)])
def test_every_version(tmp_path, version):
    np.testing.assert_allclose(read(tmp_path, las(XYZ, 1, version)).cloud.xyz, XYZ, atol=1e-9)


def test_colours_of_8_bits_are_told_from_those_of_16(tmp_path):
    cloud = read(tmp_path, las(XYZ, 2, colour=np.full((200, 3), 255))).cloud
    np.testing.assert_allclose(cloud.colour, 1.0)


def test_map_coordinates_are_moved_near_the_origin_and_can_be_had_back(tmp_path):
    placed = read(tmp_path, las(XYZ + [500_000, 4_100_000, 250], offset=(500_000.0, 4_100_000.0, 0.0)))
    assert np.abs(placed.cloud.xyz).max() < 20
    np.testing.assert_allclose(placed.placement.to_file(placed.cloud.xyz), XYZ + [500_000, 4_100_000, 250], atol=1e-6)
    np.testing.assert_allclose(placed.placement.to_world(XYZ + [500_000, 4_100_000, 250]), placed.cloud.xyz, atol=1e-6)
    assert placed.remarks == ("The points of cloud.las lie far from the origin; they were moved by -500,000, -4,100,000, -250.",)


@pytest.mark.parametrize("form", [0, 6])
def test_points_of_noise_are_left_out_and_that_is_said(tmp_path, form):
    kind = np.zeros(200, np.uint8)
    kind[:3], kind[3] = 7, 18
    placed = read(tmp_path, las(XYZ, form, (1, 4) if form else (1, 2), kind=kind))
    np.testing.assert_allclose(placed.cloud.xyz, XYZ[4:], atol=1e-9)
    assert placed.remarks == ("4 points of cloud.las are marked as noise or withheld; they were left out.",)


@pytest.mark.parametrize("form", [0, 3, 6, 7])
def test_laz_holds_the_same_records(tmp_path, form):
    placed = read(tmp_path, laz(XYZ, form), "cloud.laz")
    np.testing.assert_allclose(placed.cloud.xyz, XYZ, atol=1e-9)
    assert placed.what == "LAZ"


def test_laz_without_lazrs_says_what_to_install(tmp_path, monkeypatch):
    data = laz(XYZ)
    monkeypatch.setitem(sys.modules, "lazrs", None)
    with pytest.raises(SketchError) as error:
        read(tmp_path, data, "cloud.laz")
    assert str(error.value) == "cloud.laz is a LAZ file, which needs the package `lazrs`. Install it: pip install 'sketchtree[multiview]'."


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (las(XYZ)[:-50], "cloud.las ends after 197 of its 200 points. The file was cut off: copy or export it again."),
        (las(XYZ)[:100], "cloud.las is a LAS file that ends in its header. The file was cut off: copy or export it again."),
        (las(XYZ, count=0), "cloud.las holds no points. Export the cloud again, with its points."),
        (las(XYZ, version=(2, 0)), "cloud.las is a LAS file (version 2.0, point format 0) whose header makes no sense. Export the cloud again."),
        (las(XYZ, packed=True), "cloud.las is a LAZ file that doesn't say how it was packed. Export the cloud again."),
        (las(XYZ, kind=np.full(200, 7)), "None of the 200 points of cloud.las is a place. Export the cloud again: all its numbers are missing, infinite or marked as noise."),
    ],
)
def test_a_file_that_makes_no_sense_is_named(tmp_path, data, says):
    with pytest.raises(SketchError) as error:
        read(tmp_path, data)
    assert str(error.value) == says


def test_a_laz_file_that_was_cut_off_is_named(tmp_path):
    with pytest.raises(SketchError) as error:
        read(tmp_path, laz(XYZ)[:-100], "cloud.laz")
    assert str(error.value) == "cloud.laz is a LAZ file whose table of chunks makes no sense. Copy or export it again."


def test_a_laz_file_that_is_damaged_inside_is_named(tmp_path):
    data = bytearray(laz(XYZ, 0))
    begins = int.from_bytes(data[96:100], "little") + 8  # past the table's place
    data[begins + 200 : begins + 400] = b"\xff" * 200
    with pytest.raises(SketchError, match=r"^cloud\.laz can't be unpacked after 0 of its 200 points \("):
        read(tmp_path, bytes(data), "cloud.laz")


def test_layers_of_a_laz_file_that_say_they_are_gigabytes_are_not_believed(tmp_path):
    data = bytearray(laz(XYZ, 6))
    begins = int.from_bytes(data[96:100], "little") + 8  # past the table's place
    data[begins + 30 : begins + 70] = b"\xff" * 40
    with pytest.raises(SketchError) as error:
        read(tmp_path, bytes(data), "cloud.laz")
    assert str(error.value) == "cloud.laz is a LAZ file whose layers make no sense. Copy or export it again."