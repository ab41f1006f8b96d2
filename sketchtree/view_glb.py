"""The meshes of a GLB file, as far as a picture needs them: triangles, tint, textures.

Reads what our own writer writes (and the same features from elsewhere): plain accessors in one binary chunk,
metallic-roughness materials, node transforms given as a matrix or as translation, rotation and scale.
"""

import io
import json
import struct
from pathlib import Path

import numpy as np

from sketchtree.errors import ExportError
from sketchtree.geometry.mesh import Material, Mesh

_COMPONENT = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def read_glb(path: str | Path) -> list[Mesh]:
    """Every primitive of triangles as a mesh in world metres. Raises ExportError for what is no GLB file."""
    try:
        content, binary = _chunks(Path(path).read_bytes())
        return [
            _mesh(content, binary, primitive, content["meshes"][node["mesh"]].get("name", "mesh"), matrix)
            for node, matrix in _nodes(content)
            if "mesh" in node
            for primitive in content["meshes"][node["mesh"]]["primitives"]
            if primitive.get("mode", 4) == 4
        ]
    except OSError as error:
        raise ExportError(f"{path} can't be read: {error.strerror}.", remedy="Check the path.") from error
    except (KeyError, IndexError, ValueError, TypeError, struct.error) as error:
        raise ExportError(f"{path} is not a GLB file that can be shown.", remedy="Give a .glb file with its textures inside.") from error


def _chunks(data: bytes) -> tuple[dict, bytes]:
    if data[:4] != b"glTF":
        raise ValueError("no glTF header")
    length = struct.unpack_from("<I", data, 12)[0]
    content = json.loads(data[20 : 20 + length])
    rest = 20 + length
    size = struct.unpack_from("<I", data, rest)[0] if rest < len(data) else 0
    return content, data[rest + 8 : rest + 8 + size]


def _nodes(content: dict):
    """Every node with its world matrix, parents first."""
    nodes = content.get("nodes", [])
    scene = content.get("scenes", [{"nodes": range(len(nodes))}])[content.get("scene", 0)]
    todo = [(row, np.eye(4)) for row in scene.get("nodes", [])]
    while todo:
        row, above = todo.pop(0)
        matrix = above @ _local(nodes[row])
        yield nodes[row], matrix
        todo += [(child, matrix) for child in nodes[row].get("children", [])]


def _local(node: dict):
    if "matrix" in node:
        return np.reshape(node["matrix"], (4, 4)).T
    matrix = np.eye(4)
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    turn = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, :3] = np.array(turn) * node.get("scale", (1, 1, 1))
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def _mesh(content, binary, primitive, name, matrix) -> Mesh:
    read = lambda key: _column(content, binary, primitive["attributes"][key]) if key in primitive["attributes"] else None  # noqa: E731
    position = read("POSITION").astype(float) @ matrix[:3, :3].T + matrix[:3, 3]
    if "indices" in primitive:
        triangle = _column(content, binary, primitive["indices"]).reshape(-1, 3).astype(np.int64)
    else:
        triangle = np.arange(len(position)).reshape(-1, 3)
    normal, uv, color = read("NORMAL"), read("TEXCOORD_0"), read("COLOR_0")
    normal = _flat_normals(position, triangle) if normal is None else normal @ np.linalg.inv(matrix[:3, :3])
    uv = np.zeros((len(position), 2)) if uv is None else uv
    if color is not None and color.shape[1] == 3:
        color = np.column_stack([color, np.ones(len(color))])
    normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    return Mesh(name, position, normal, uv, triangle, _material(content, binary, primitive.get("material")), color)


def _column(content, binary, index):
    accessor = content["accessors"][index]
    view = content["bufferViews"][accessor["bufferView"]]
    kind, width = np.dtype(_COMPONENT[accessor["componentType"]]), _WIDTH[accessor["type"]]
    stride = view.get("byteStride", kind.itemsize * width)
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    rows = np.ndarray((accessor["count"], width), kind, binary, start, (stride, kind.itemsize))
    return rows / float(np.iinfo(kind).max) if accessor.get("normalized") else rows.copy()


def _material(content, binary, index) -> Material:
    entry = {} if index is None else content["materials"][index]
    pbr = entry.get("pbrMetallicRoughness", {})
    masked = entry.get("alphaMode", "OPAQUE") != "OPAQUE"
    return Material(
        name=entry.get("name", "material"),
        base_color_texture=_image(content, binary, pbr.get("baseColorTexture"), "RGBA" if masked else "RGB"),
        normal_texture=_image(content, binary, entry.get("normalTexture"), "RGB"),
        base_color=tuple(pbr.get("baseColorFactor", (1.0, 1.0, 1.0, 1.0))),
        roughness=pbr.get("roughnessFactor", 1.0),
        alpha_cutoff=entry.get("alphaCutoff", 0.5) if masked else None,
        double_sided=entry.get("doubleSided", False),
    )


def _image(content, binary, texture, mode):
    if texture is None:
        return None
    from PIL import Image

    view = content["bufferViews"][content["images"][content["textures"][texture["index"]]["source"]]["bufferView"]]
    start = view.get("byteOffset", 0)
    return np.asarray(Image.open(io.BytesIO(binary[start : start + view["byteLength"]])).convert(mode))


def _flat_normals(position, triangle):
    a, b, c = (position[triangle[:, i]] for i in range(3))
    normal = np.zeros_like(position)
    np.add.at(normal, triangle.ravel(), np.repeat(np.cross(b - a, c - a), 3, axis=0))
    return normal
