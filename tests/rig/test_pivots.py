"""Pivots, and the textures that Pivot Painter 2 reads them from."""

import struct

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import centre_lines
from sketchtree.rig.boughs import boughs
from sketchtree.rig.exr import exr_bytes
from sketchtree.rig.pivots import DEEPEST, axis_texture, pivots, position_texture, texel
from tests.geometry.growing import bushy
from tests.rig.rigged_trees import rigged


def made(tree, **given):
    lines = centre_lines(tree)
    limbs = boughs(tree, lines)
    return lines, limbs, pivots(lines, limbs, **given)


def test_parents_stand_before_their_children_and_chains_are_four_deep():
    lines, limbs, found = made(bushy(levels=4), most=500)
    child = found.parent != NULL
    assert len(found) <= 500 and np.all(found.parent[child] < np.flatnonzero(child))
    depth = np.zeros(len(found), int)
    for k in np.flatnonzero(child):
        depth[k] = depth[found.parent[k]] + 1
    assert depth.max() == DEEPEST


def test_a_pivot_is_the_foot_of_its_limb_and_its_axis_points_to_the_tip():
    lines, _, found = made(bushy(levels=2))
    assert np.array_equal(found.position, lines.point[lines.start[found.limb]])
    assert np.allclose(found.position + found.extent[:, None] * found.axis, lines.point[lines.start[found.limb + 1] - 1])


def test_limbs_without_an_element_go_with_what_they_grow_from():
    lines, _, found = made(bushy(levels=3), most=40)
    assert len(found) == 40 and np.array_equal(found.of_limb[found.limb], np.arange(40))
    others = np.setdiff1d(np.arange(len(lines)), found.limb)
    assert np.array_equal(found.of_limb[others], found.of_limb[lines.parent[others]])


@pytest.mark.parametrize(("count", "size"), [(1, (1, 1)), (2, (2, 1)), (5, (4, 2)), (33, (8, 8)), (1000, (32, 32))])
def test_textures_have_sides_of_powers_of_two(count, size):
    _, _, found = made(bushy(levels=3))
    some = type(found)(*(np.resize(column, (count, *column.shape[1:])) for column in (found.parent, found.position, found.axis, found.extent, found.limb)), found.of_limb)
    assert some.size == size and position_texture(some).shape == (size[1], size[0], 4)


def test_what_a_vertex_reads_at_its_place_is_its_pivot():
    """As Unreal would: the nearest pixel, halves, bits of the parent's number."""
    rigging, wood, leaf = rigged()
    found = rigging.pivots
    position, axis = position_texture(found), axis_texture(found)
    for mesh in (wood, leaf):
        uv = mesh.extra["TEXCOORD_1"].astype(float)
        column, row = (np.floor(uv * found.size)).astype(int).T
        pixel = position[row, column]
        element = row * found.size[0] + column
        world = pixel[:, [0, 2, 1]].astype(float) / 100.0  # back from (100 x, 100 z, 100 y)
        assert np.allclose(world, found.position[element], atol=0.005)
        assert np.allclose(np.column_stack([mesh.extra["TEXCOORD_4"], mesh.extra["TEXCOORD_5"][:, :1]]), found.position[element], atol=1e-5)
        above = pixel[:, 3].copy().view(np.uint16).astype(int) - 1024
        assert np.array_equal(above, np.where(found.parent == NULL, np.arange(len(found)), found.parent)[element])
        assert np.array_equal(above, mesh.extra["TEXCOORD_5"][:, 1].astype(int))
        unit = 2.0 * axis[row, column, :3][:, [0, 2, 1]] / 255.0 - 1.0
        assert np.allclose(unit, found.axis[element], atol=0.005)
        extent = axis[row, column, 3] / 255.0 * 256.0 * 8.0 / 100.0
        assert np.allclose(extent, np.clip(found.extent[element], 0.08, 20.48), atol=0.045)


def test_vertices_of_a_limb_point_at_its_pixel():
    rigging, wood, _ = rigged()
    assert {tuple(row) for row in wood.extra["TEXCOORD_1"].tolist()} <= {tuple(row) for row in texel(rigging.pivots, np.arange(len(rigging.pivots))).astype(np.float32).tolist()}
    foot = wood.position[:, 1] < 0.3
    assert np.all(wood.extra["TEXCOORD_1"][foot] == texel(rigging.pivots, np.zeros(1, int)).astype(np.float32))


def test_numbers_up_to_thirty_thousand_survive_as_halves():
    _, _, found = made(bushy(levels=1))
    many = type(found)(np.r_[NULL, np.arange(29_999)], np.zeros((30_000, 3)), np.zeros((30_000, 3)), np.zeros(30_000), np.zeros(30_000, int), found.of_limb)
    bits = position_texture(many).reshape(-1, 4)[:30_000, 3]
    assert np.isfinite(bits).all() and np.all(np.abs(bits) >= np.finfo(np.float16).smallest_normal)
    assert np.array_equal(bits.astype(np.float32).astype(np.float16).view(np.uint16) - 1024, np.r_[0, np.arange(29_999)])


def read_exr(data: bytes):
    """A reader of our own making: no compression, one part, halves."""
    assert data[:8] == struct.pack("<II", 20000630, 2)
    at, attributes = 8, {}
    while data[at]:
        name, kind, rest = data[at:].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name.decode()] = data[at + 4 : at + 4 + size]
        at += 4 + size
    at += 1
    _, _, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    names = [part[-1:].decode() for part in attributes["channels"].split(b"\0") if part[-1:] in (b"A", b"B", b"G", b"R")]
    image = np.zeros((bottom + 1, right + 1, 4), np.float16)
    for row, offset in enumerate(struct.unpack_from(f"<{bottom + 1}Q", data, at)):
        y, size = struct.unpack_from("<iI", data, offset)
        line = np.frombuffer(data, "<f2", size // 2, offset + 8).reshape(4, right + 1)
        assert y == row
        for name, values in zip(names, line, strict=True):
            image[row, :, "RGBA".index(name)] = values
    assert offset + 8 + size == len(data)
    return image


def test_an_exr_holds_the_halves_bit_by_bit():
    rng = np.random.default_rng(0)
    image = rng.integers(0, 0x7C00, (3, 5, 4)).astype(np.uint16).view(np.float16)
    found = read_exr(exr_bytes(image))
    assert np.array_equal(found.view(np.uint16), image.view(np.uint16))
    assert exr_bytes(image) == exr_bytes(image.copy())


def test_openexrs_own_library_reads_the_same(tmp_path):
    library = pytest.importorskip("OpenEXR", reason="the OpenEXR package is not installed")
    image = position_texture(rigged()[0].pivots)
    (tmp_path / "pivots.exr").write_bytes(exr_bytes(image))
    found = library.File(str(tmp_path / "pivots.exr")).channels()["RGBA"].pixels
    assert np.array_equal(found.view(np.uint16), image.view(np.uint16))
