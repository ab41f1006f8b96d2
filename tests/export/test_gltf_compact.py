"""A compact glTF file: the same tree in smaller numbers, and a reader is told that it must know them."""

import dataclasses
import json
import struct

import numpy as np
import pytest
from shapes import bending, bones, leafy, moved, square, textured

from sketchtree.asset import Asset, Morph
from sketchtree.export.gltf import asset_bytes, read_asset
from sketchtree.export.write import write_asset


def content(data: bytes) -> dict:
    return json.loads(data[20 : 20 + struct.unpack_from("<I", data, 12)[0]])


def tilted(mesh):
    """Its normals and its leaf's morph have parts that are no round numbers."""
    normal = np.array([(0.1, 0.2, 0.97), (-0.3, 0.1, 0.95), (0.0, 0.6, 0.8), (0.5, -0.5, 0.7)])
    return dataclasses.replace(mesh, normal=normal / np.linalg.norm(normal, axis=1, keepdims=True))


@pytest.fixture
def asset():
    whole = moved()
    return dataclasses.replace(whole, levels=(dataclasses.replace(whole.levels[0], parts=tuple(map(tilted, whole.parts))),))


def test_a_reader_is_told_that_it_must_know_small_numbers_and_a_plain_file_needs_nothing(asset):
    assert content(asset_bytes(asset, compact=True))["extensionsRequired"] == ["KHR_mesh_quantization"]
    assert "extensionsRequired" not in content(asset_bytes(asset))


def test_every_number_comes_back_as_near_as_its_bits_let_it(asset, tmp_path):
    write_asset(tmp_path / "small.glb", asset, compact=True)
    back = read_asset(tmp_path / "small.glb")
    for mine, read, step in zip(asset.parts, back.parts, (2**-15, 2**-7), strict=True):
        assert np.array_equal(mine.position, read.position) and np.array_equal(mine.triangle, read.triangle)
        assert np.abs(mine.normal - read.normal).max() <= step and np.abs(mine.uv - read.uv).max() <= 2**-16
    (own,), (morph,) = asset.animation.morphs, back.animation.morphs
    assert np.abs(own.offset - morph.offset).max() <= 2**-15 and np.array_equal(own.weight, morph.weight)


def test_what_does_not_fit_into_small_numbers_keeps_its_own():
    tiled = dataclasses.replace(textured(), uv=5.0 * square().uv)
    far = dataclasses.replace(leafy(), extra=bending().extra)
    asset = Asset.of([tiled, far], armature=bones(), animation=dataclasses.replace(moved().animation, morphs=(Morph(1, np.full((4, 3), 1.5), np.array([0.0, 1.0]), np.array([1.0, 0.0])),)))
    said = content(asset_bytes(asset, compact=True))
    wood, leaf = (mesh["primitives"][0] for mesh in said["meshes"])
    assert said["accessors"][wood["attributes"]["TEXCOORD_0"]]["componentType"] == 5126 and said["accessors"][leaf["targets"][0]["POSITION"]]["componentType"] == 5126


def test_rows_begin_at_multiples_of_four_bytes_and_bounds_are_whole_numbers(asset):
    said = content(asset_bytes(asset, compact=True))
    for mesh in said["meshes"]:
        primitive = mesh["primitives"][0]
        for number in (*primitive["attributes"].values(), *(target["POSITION"] for target in primitive.get("targets", ()))):
            accessor = said["accessors"][number]
            size = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5126: 4}[accessor["componentType"]] * int(accessor["type"][-1])
            assert said["bufferViews"][accessor["bufferView"]].get("byteStride", size) % 4 == 0
    bounds = said["accessors"][said["meshes"][1]["primitives"][0]["targets"][0]["POSITION"]]
    assert bounds["min"] == [-32767, -32767, 0] and bounds["max"] == [0, 0, 0]


def test_the_same_asset_makes_the_same_bytes(asset):
    assert asset_bytes(asset, compact=True) == asset_bytes(asset, compact=True)
