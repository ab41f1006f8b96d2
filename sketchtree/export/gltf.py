"""A tree as one binary glTF 2.0 file (GLB).

One scene; a root node `tree` with one node a mesh, named as the mesh (`wood…`, `leaf…`); physically based materials with
their textures inside the file; tangents wherever there is a normal map. Metres, y up. The same
meshes give the same bytes: there is no date and no path in the file. What the caller passes as `extras` stands on the scene.
"""

import json
import os
import struct
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from sketchtree.errors import ExportError
from sketchtree.export.files import check_extension, write_whole
from sketchtree.export.images import encode
from sketchtree.export.tangents import tangents
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.version import __version__

_VERTEX, _INDEX = 34962, 34963  # buffer view targets
_FLOAT, _USHORT, _UINT, _UBYTE = 5126, 5123, 5125, 5121
_LINEAR, _MIPMAP, _REPEAT = 9729, 9987, 10497
GENERATOR = f"SketchTree {__version__}"


def write_glb(path: str | os.PathLike, meshes: Sequence[Mesh], *, extras: dict | None = None) -> None:
    """Write the meshes as a GLB file, all or nothing. `extras` must be JSON; it stands on the scene.

    Meshes without triangles are left out. Raises `ExportError` where a number is not finite or the file can't be written.
    """
    check_extension(path, (".glb",))
    write_whole(path, glb_bytes(meshes, extras=extras))


def glb_bytes(meshes: Sequence[Mesh], *, extras: dict | None = None) -> bytes:
    """The file as bytes."""
    document = _Document()
    nodes = [{"name": "tree"}]
    for mesh in meshes:
        _check(mesh)
        if len(mesh.triangle):
            nodes.append({"name": mesh.name, "mesh": document.mesh(mesh)})
    if len(nodes) > 1:
        nodes[0]["children"] = list(range(1, len(nodes)))
    scene = {"name": "tree", "nodes": [0]} | ({"extras": extras} if extras else {})
    content = {"asset": {"version": "2.0", "generator": GENERATOR}, "scene": 0, "scenes": [scene], "nodes": nodes}
    content |= {name: rows for name, rows in document.tables().items() if rows}
    return _pack(content, bytes(document.binary))


def read_glb_json(path: str | os.PathLike) -> dict:
    """The JSON part of a GLB file. Raises `ExportError` where it is none."""
    with open(path, "rb") as file:
        head = file.read(20)
        if len(head) < 20 or head[:4] != b"glTF" or head[16:20] != b"JSON":
            raise ExportError(f"{path} is not a GLB file.", remedy="Give a file that ends in .glb.")
        return json.loads(file.read(struct.unpack("<I", head[12:16])[0]))


@dataclass
class _Document:
    """The tables of the file while it is put together."""

    binary: bytearray = field(default_factory=bytearray)
    views: list = field(default_factory=list)
    accessors: list = field(default_factory=list)
    meshes: list = field(default_factory=list)
    materials: list = field(default_factory=list)
    textures: list = field(default_factory=list)
    images: list = field(default_factory=list)
    known: dict = field(default_factory=dict)  # what was stored already, by its content

    def tables(self) -> dict:
        sampler = {"magFilter": _LINEAR, "minFilter": _MIPMAP, "wrapS": _REPEAT, "wrapT": _REPEAT}
        return {
            "meshes": self.meshes,
            "materials": self.materials,
            "textures": self.textures,
            "images": self.images,
            "samplers": [sampler] if self.textures else [],
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": len(self.binary)}] if self.binary else [],
        }

    def mesh(self, mesh: Mesh) -> int:
        attributes = {
            "POSITION": self.accessor(mesh.position.astype("<f4"), "VEC3", _FLOAT, _VERTEX, bounds=True),
            "NORMAL": self.accessor(_unit32(mesh.normal), "VEC3", _FLOAT, _VERTEX),
            "TEXCOORD_0": self.accessor(mesh.uv.astype("<f4"), "VEC2", _FLOAT, _VERTEX),
        }
        if mesh.material.normal_texture is not None and mesh.material.alpha_cutoff is None:  # cards: readers derive them
            attributes["TANGENT"] = self.accessor(_tangents32(mesh), "VEC4", _FLOAT, _VERTEX)
        if mesh.color is not None:
            tint = np.round(np.clip(mesh.color, 0.0, 1.0) * 255.0).astype("u1")
            attributes["COLOR_0"] = self.accessor(tint, "VEC4", _UBYTE, _VERTEX, normalized=True)
        wide = len(mesh.position) > 65535
        index = mesh.triangle.astype("<u4" if wide else "<u2").ravel()
        primitive = {
            "attributes": attributes,
            "indices": self.accessor(index, "SCALAR", _UINT if wide else _USHORT, _INDEX),
            "material": self.material(mesh.material),
            "mode": 4,
        }
        self.meshes.append({"name": mesh.name, "primitives": [primitive]})
        return len(self.meshes) - 1

    def accessor(self, array, kind: str, component: int, target: int, *, bounds=False, normalized=False) -> int:
        entry = {"bufferView": self.view(array.tobytes(), target), "componentType": component, "count": len(array), "type": kind}
        if normalized:
            entry["normalized"] = True
        if bounds:
            entry |= {"min": array.min(axis=0).astype(float).tolist(), "max": array.max(axis=0).astype(float).tolist()}
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def view(self, data: bytes, target: int | None = None) -> int:
        self.binary.extend(bytes(-len(self.binary) % 4))
        entry = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        self.views.append(entry | ({"target": target} if target else {}))
        self.binary.extend(data)
        return len(self.views) - 1

    def material(self, material: Material) -> int:
        if id(material) not in self.known:
            self.materials.append(self._material(material))
            self.known[id(material)] = len(self.materials) - 1
        return self.known[id(material)]

    def _material(self, material: Material) -> dict:
        pbr = {
            "baseColorFactor": list(map(float, material.base_color)),
            "metallicFactor": 0.0,
            "roughnessFactor": float(material.roughness),
        }
        if material.base_color_texture is not None:
            albedo = self.texture(material.base_color_texture, "albedo", material.name, photographic=True)
            pbr["baseColorTexture"] = {"index": albedo}
        if material.roughness_texture is not None:
            rough = material.roughness_texture
            packed = np.stack([np.full_like(rough, 255), rough, np.zeros_like(rough)], axis=-1)
            pbr |= {
                "roughnessFactor": 1.0,
                "metallicFactor": 1.0,
                "metallicRoughnessTexture": {"index": self.texture(packed, "roughness", material.name, photographic=True)},
            }
        entry = {"name": material.name, "pbrMetallicRoughness": pbr}
        if material.normal_texture is not None:
            entry["normalTexture"] = {"index": self.texture(material.normal_texture, "normal", material.name)}
        if material.alpha_cutoff is not None:
            entry |= {"alphaMode": "MASK", "alphaCutoff": float(material.alpha_cutoff)}
        return entry | ({"doubleSided": True} if material.double_sided else {})

    def texture(self, image, part: str, owner: str, *, photographic: bool = False) -> int:
        data, media = encode(image, photographic=photographic)
        if data not in self.known:
            self.images.append({"name": f"{owner}_{part}", "mimeType": media, "bufferView": self.view(data)})
            self.textures.append({"source": len(self.images) - 1, "sampler": 0, "name": f"{owner}_{part}"})
            self.known[data] = len(self.textures) - 1
        return self.known[data]


def _pack(content: dict, binary: bytes) -> bytes:
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=False, allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text
    if binary:
        chunks += struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def _unit32(vector):
    """Unit vectors that are still of unit length after rounding to 32 bits."""
    vector = vector.astype("<f4")
    return vector / np.linalg.norm(vector, axis=1, keepdims=True)


def _tangents32(mesh: Mesh):
    tangent = tangents(mesh)
    return np.concatenate([_unit32(tangent[:, :3]), tangent[:, 3:]], axis=1).astype("<f4")


def _check(mesh: Mesh) -> None:
    for name in ("position", "normal", "uv", "color"):
        column = getattr(mesh, name)
        if column is not None and not np.isfinite(column).all():
            raise ExportError(
                f"The {name} of a vertex of mesh `{mesh.name}` is not a finite number.",
                remedy="Check the skeleton it was made from for stray points.",
            )
