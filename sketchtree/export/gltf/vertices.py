"""A mesh in glTF's words: one primitive, its columns as small as the format lets them be without an extension.

    POSITION NORMAL TEXCOORD_n TANGENT   32-bit floats; tangents where there is a normal map
    TEXCOORD_n, n > 0, within 0-1        normalised 16 bits: wind and places in small textures need no more
    COLOR_n                              normalised bytes, four channels
    JOINTS_n WEIGHTS_n                   bytes (joints: two where there are more than 256); weights sum to 255. Of a mesh that an animation moves far, weights are
                                         normalised 16 bits where some are shares: a 255th of ten metres shows
    indices                              16 bits up to 65,535 vertices

Compact (KHR_mesh_quantization, which a reader must know): NORMAL and TANGENT in 8 bits on leaves, 16 on wood; TEXCOORD_0 within 0-1 and morphs of a metre at most in 16.
"""

import re

import numpy as np

from sketchtree.export.gltf.materials import material_number
from sketchtree.export.gltf.tables import INDEX, Tables, as_bytes, signed, unit32
from sketchtree.export.gltf.tangents import tangents
from sketchtree.geometry.mesh import Mesh

QUANTIZED = "KHR_mesh_quantization"
_NARROW = 65535  # the last index of 16 bits restarts a strip
_JOINTS = re.compile(r"(JOINTS|WEIGHTS)_\d+")


def mesh_number(tables: Tables, mesh: Mesh, name: str, *, skinned: bool = False, moves: bool = False, target=None) -> int:
    """Its place in the table of meshes. Joints and weights are left out unless it is `skinned`; `moves`: by an animation of the file. `target`: how far a morph moves each vertex, [vertex 3]."""
    key = ("mesh", id(mesh), name)
    if key in tables.known:
        return tables.known[key]
    wide = len(mesh.position) > _NARROW
    primitive = {
        "attributes": _columns(tables, mesh) | (_influences(tables, mesh, moves) if skinned else {}),
        "indices": tables.column(mesh.triangle.astype("<u4" if wide else "<u2").ravel(), INDEX),
        "material": material_number(tables, mesh.material),
        "mode": 4,
    }
    entry = {"name": name, "primitives": [primitive]}
    if target is not None:
        primitive["targets"] = [{"POSITION": _target(tables, np.asarray(target, "<f4"))}]
        entry["weights"] = [0.0]
    tables.meshes.append(entry)
    tables.known[key] = len(tables.meshes) - 1
    return tables.known[key]


def is_skinned(mesh: Mesh) -> bool:
    """Does it say which joints move it?"""
    return "JOINTS_0" in mesh.extra


def _columns(tables: Tables, mesh: Mesh) -> dict:
    attributes = {"POSITION": tables.column(mesh.position.astype("<f4"), bounds=True)} | _directions(tables, mesh)
    attributes["TEXCOORD_0"] = _further(tables, "TEXCOORD_0", mesh.uv) if tables.compact else tables.column(mesh.uv.astype("<f4"))
    if mesh.color is not None:
        attributes["COLOR_0"] = _color(tables, mesh.color)
    elif any(name.startswith("COLOR_") for name in mesh.extra):  # sets are counted from 0 without a gap
        attributes["COLOR_0"] = _color(tables, np.ones((len(mesh.position), 4)))
    for name, column in mesh.extra.items():
        if not _JOINTS.fullmatch(name):
            attributes[name] = _color(tables, column) if name.startswith("COLOR_") else _further(tables, name, column)
    return attributes


def _directions(tables: Tables, mesh: Mesh) -> dict:
    """NORMAL and, where there is a normal map, TANGENT."""
    normal, tangent = unit32(mesh.normal), None if mesh.material.normal_texture is None else tangents(mesh)
    if tables.compact:
        tables.use(QUANTIZED, required=True)
        bits = 8 if mesh.name.startswith("leaf") else 16
        found = {"NORMAL": tables.padded(signed(normal, bits))}
        return found if tangent is None else found | {"TANGENT": tables.column(signed(tangent, bits), normalized=True)}
    found = {"NORMAL": tables.column(normal)}
    return found if tangent is None else found | {"TANGENT": tables.column(np.concatenate([unit32(tangent[:, :3]), tangent[:, 3:].astype("<f4")], axis=1))}


def _target(tables: Tables, offset) -> int:
    """How far a morph moves each vertex."""
    if tables.compact and len(offset) and np.abs(offset).max() <= 1.0:
        return tables.padded(signed(offset, 16), bounds=True)
    return tables.column(offset, bounds=True)


def _further(tables: Tables, name: str, column) -> int:
    """A texture set beyond the first, in half the bytes where it holds shares; any other column as it is."""
    if name.startswith("TEXCOORD_") and len(column) and column.min() >= 0 and column.max() <= 1:
        return tables.column(np.round(np.asarray(column, float) * 65535.0).astype("<u2"), normalized=True)
    return tables.column(column.astype("<f4"))


def _color(tables: Tables, color) -> int:
    whole = color if color.shape[1] == 4 else np.concatenate([color, np.ones((len(color), 4 - color.shape[1]))], axis=1)
    return tables.column(as_bytes(whole), normalized=True)


def _influences(tables: Tables, mesh: Mesh, moves: bool) -> dict:
    """JOINTS_0 and WEIGHTS_0; a joint without weight is joint 0, as the format asks."""
    weight = np.asarray(mesh.extra["WEIGHTS_0"], float)
    total = weight.sum(axis=1, keepdims=True)
    share = weight / np.where(total > 0, total, 1.0)
    whole, kind = (65535, "<u2") if moves and ((share > 0) & (share < 1)).any() else (255, "u1")
    part = np.floor(whole * share + 1e-9).astype(np.int64)
    part[np.arange(len(part)), weight.argmax(axis=1)] += whole - part.sum(axis=1)
    joint = np.where(part > 0, mesh.extra["JOINTS_0"], 0)
    small = joint.astype("<u1" if joint.size == 0 or joint.max() < 256 else "<u2")
    return {"JOINTS_0": tables.column(small), "WEIGHTS_0": tables.column(part.astype(kind), normalized=True)}
