"""What a glTF file of ours holds, read back: meshes, places, levels of detail, bones, the skeleton.

The same features are read of files from elsewhere: plain accessors, metallic-roughness materials, node transforms as a matrix or as
translation, rotation and scale, the first animation. Sparse accessors and compressed meshes are not, and of morph targets only what an animation moves.
"""

import os
import struct
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from sketchtree.asset import Armature, Asset, Level
from sketchtree.axes import NULL
from sketchtree.errors import ExportError
from sketchtree.export.capsules import capsules_from_json
from sketchtree.export.gltf.document import Document, read_glb_json
from sketchtree.export.gltf.instancing import EXTENSION
from sketchtree.export.gltf.materials import TRANSMISSION
from sketchtree.export.gltf.read_animation import read_animation
from sketchtree.export.gltf.scene import COVERAGE, LOD
from sketchtree.export.skeletons.packed import skeleton_from_extras
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.skeleton import TreeSkeleton

_BROKEN = (KeyError, IndexError, ValueError, TypeError, AttributeError, struct.error)


def read_glb(path: str | os.PathLike) -> list[Mesh]:
    """What the finest level draws, as meshes in world metres. Raises ExportError for what is no glTF file."""
    return [part.merged() for part in read_asset(path).parts]


def read_asset(path: str | os.PathLike) -> Asset:
    """All that the file holds, `.glb` or `.gltf`. Raises ExportError for what is no glTF file."""
    try:
        document = Document.read(Path(path))
        return _asset(document)
    except OSError as error:
        missing = f"{Path(error.filename).name}: " if error.filename and Path(error.filename).name != Path(path).name else ""
        what = f"{path} can't be read: {missing}{(error.strerror or 'an image in it is damaged').lower()}"
        raise ExportError(f"{what}.", remedy="Check the path.") from error
    except _BROKEN as error:
        loose = Path(path).suffix.lower() == ".gltf"
        remedy = "Give a .gltf file with its buffers and textures beside it." if loose else "Give a .glb file with its textures inside."
        raise ExportError(f"{path} is not a {'glTF' if loose else 'GLB'} file that can be shown.", remedy=remedy) from error


def read_glb_skeleton(path: str | os.PathLike) -> TreeSkeleton:
    """The skeleton inside a glTF file that we wrote. Raises `ExportError` where the file is none or holds none."""
    skeleton = _skeleton(_scene(read_glb_json(path)).get("extras", {}))
    if skeleton is None:
        raise ExportError(f"{path} holds no skeleton.", remedy="Give a GLB file written by `sketchtree build`.")
    return skeleton


def _scene(content: dict) -> dict:
    scenes = content.get("scenes") or [{"nodes": list(range(len(content.get("nodes", []))))}]
    return scenes[content.get("scene", 0)]


def _skeleton(extras: dict) -> TreeSkeleton | None:
    found = [value for value in (extras, *extras.values()) if isinstance(value, dict) and "sketchtree_skeleton" in value]
    return skeleton_from_extras(found[0]) if found else None


def _asset(document: Document) -> Asset:
    scene, nodes = _scene(document.content), document.content.get("nodes", [])
    extras = scene.get("extras", {})
    capsules = capsules_from_json(extras["capsules"]) if extras.get("capsules") else None
    materials: dict = {}
    levels, drawn_by = [], []
    for roots in _levels(nodes, scene.get("nodes", [])):
        parts = [(row, part) for row, matrix in _walk(nodes, roots) for part in _parts(document, nodes[row], matrix, materials)]
        parts = [(row, part) for row, part in parts if capsules is None or _drawn(part)]
        levels.append(tuple(part for _, part in parts))
        drawn_by.append([row for row, _ in parts])
    coverage = next((node["extras"][COVERAGE] for node in nodes if COVERAGE in node.get("extras", {})), [0.0] * len(levels))
    levels = tuple(Level(parts, float(share)) for parts, share in zip(levels, coverage, strict=False))
    name = scene.get("name") or (nodes[scene["nodes"][0]].get("name", "tree") if scene.get("nodes") else "tree")
    armature, joints = _armature(document.content)
    moves = None if armature is None else read_animation(document, joints, drawn_by[0])
    return Asset(levels, _skeleton(extras), name, armature, capsules, moves, about=extras.get("about", {}))


def _drawn(part: Mesh | Instances) -> bool:
    return (part.mesh if isinstance(part, Instances) else part).material.name != "collision"


def _levels(nodes: list, roots: list) -> list[list[int]]:
    """The nodes at which each level's drawing starts: the scene's, then what MSFT_lod names."""
    coarser = [nodes[row]["extensions"][LOD]["ids"] for row, _ in _walk(nodes, roots) if LOD in nodes[row].get("extensions", {})]
    count = max(map(len, coarser), default=0)
    return [roots, *([ids[k] for ids in coarser if k < len(ids)] for k in range(count))]


def _walk(nodes: list, roots: list):
    """(number, world matrix) of every node below, parents first."""
    todo = [(row, np.eye(4)) for row in roots]
    while todo:
        row, above = todo.pop(0)
        matrix = above @ _local(nodes[row])
        yield row, matrix
        todo += [(child, matrix) for child in nodes[row].get("children", [])]


def _local(node: dict):
    if "matrix" in node:
        return np.reshape(node["matrix"], (4, 4)).T
    matrix = np.eye(4)
    turn = Rotation.from_quat(node.get("rotation", (0, 0, 0, 1))).as_matrix()
    matrix[:3, :3] = turn * node.get("scale", (1, 1, 1))
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def _parts(document: Document, node: dict, matrix, materials: dict) -> list[Mesh | Instances]:
    """What a node draws: a mesh a primitive of triangles."""
    if "mesh" not in node:
        return []
    mesh = document.content["meshes"][node["mesh"]]
    name = node.get("name") or mesh.get("name", "mesh")
    triangles = [primitive for primitive in mesh["primitives"] if primitive.get("mode", 4) == 4]
    parts = [_mesh(document, primitive, name, materials) for primitive in triangles]
    places = node.get("extensions", {}).get(EXTENSION)
    if places is not None:
        parts = [_instances(document, part, places["attributes"]) for part in parts]
        if np.allclose(matrix, np.eye(4)):
            return parts
        parts = [part.merged() for part in parts]
    return [_moved(part, np.eye(4) if "skin" in node else matrix) for part in parts]


def _instances(document: Document, mesh: Mesh, attributes: dict) -> Instances:
    columns = {name: document.column(number).astype(float) for name, number in attributes.items()}
    count = len(next(iter(columns.values())))
    rotation = columns.get("ROTATION", np.tile([0.0, 0.0, 0.0, 1.0], (count, 1)))
    return Instances(
        mesh,
        columns.get("TRANSLATION", np.zeros((count, 3))),
        rotation / np.maximum(np.linalg.norm(rotation, axis=1, keepdims=True), 1e-12),
        columns.get("SCALE", np.ones((count, 3))),
        columns.get("_COLOR_0"),
    )


def _moved(mesh: Mesh, matrix) -> Mesh:
    if np.array_equal(matrix, np.eye(4)):
        return mesh
    normal = mesh.normal @ np.linalg.inv(matrix[:3, :3])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    triangle = mesh.triangle if np.linalg.det(matrix[:3, :3]) > 0 else mesh.triangle[:, ::-1]
    return Mesh(mesh.name, mesh.position @ matrix[:3, :3].T + matrix[:3, 3], normal, mesh.uv, triangle, mesh.material, mesh.color, mesh.extra)


def _mesh(document: Document, primitive: dict, name: str, materials: dict) -> Mesh:
    columns = {key: document.column(number) for key, number in primitive["attributes"].items()}
    position = columns.pop("POSITION").astype(float)
    count = len(position)
    triangle = document.column(primitive["indices"]).reshape(-1, 3).astype(np.int64) if "indices" in primitive else np.arange(count).reshape(-1, 3)
    normal, uv, color = columns.pop("NORMAL", None), columns.pop("TEXCOORD_0", None), columns.pop("COLOR_0", None)
    columns.pop("TANGENT", None)
    normal = _flat_normals(position, triangle) if normal is None else normal
    normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    if color is not None and color.shape[1] == 3:
        color = np.column_stack([color, np.ones(count)])
    number = primitive.get("material")
    if number not in materials:
        materials[number] = _material(document, number)
    return Mesh(name, position, normal, np.zeros((count, 2)) if uv is None else uv.astype(float), triangle, materials[number], color, columns)


def _material(document: Document, number: int | None) -> Material:
    entry = {} if number is None else document.content["materials"][number]
    pbr = entry.get("pbrMetallicRoughness", {})
    masked = entry.get("alphaMode", "OPAQUE") != "OPAQUE"
    rough = document.image(pbr.get("metallicRoughnessTexture"), "RGB")
    through = entry.get("extensions", {}).get(TRANSMISSION, {})
    return Material(
        name=entry.get("name", "material"),
        base_color_texture=document.image(pbr.get("baseColorTexture"), "RGBA" if masked else "RGB"),
        normal_texture=document.image(entry.get("normalTexture"), "RGB"),
        roughness_texture=None if rough is None else rough[..., 1],
        base_color=tuple(pbr.get("baseColorFactor", (1.0, 1.0, 1.0, 1.0))),
        roughness=pbr.get("roughnessFactor", 1.0),
        alpha_cutoff=entry.get("alphaCutoff", 0.5) if masked else None,
        double_sided=entry.get("doubleSided", False),
        translucency=through.get("diffuseTransmissionFactor", 0.0),
        translucency_texture=document.image(through.get("diffuseTransmissionColorTexture"), "RGB"),
    )


def _armature(content: dict) -> tuple[Armature | None, list[int]]:
    """The first skin's bones, parents first, and the node of each. None without a skin."""
    nodes, skins = content.get("nodes", []), content.get("skins")
    if not skins:
        return None, []
    joints = set(skins[0]["joints"])
    above = {child: row for row in joints for child in nodes[row].get("children", []) if child in joints}
    order = [row for row, _ in _walk(nodes, [row for row in skins[0]["joints"] if row not in above]) if row in joints]
    world = {row: matrix for row, matrix in _walk(nodes, _scene(content).get("nodes", [])) if row in joints}
    matrices = np.array([world[row] for row in order])
    number = {row: i for i, row in enumerate(order)}
    bones = Armature(
        tuple(nodes[row].get("name", f"joint_{i}") for i, row in enumerate(order)),
        np.array([number[above[row]] if row in above else NULL for row in order]),
        matrices[:, :3, 3],
        Rotation.from_matrix(matrices[:, :3, :3]).as_quat(canonical=True),
        np.array([nodes[row].get("extras", {}).get("length", 0.0) for row in order], float),
    )
    return bones, order


def _flat_normals(position, triangle):
    a, b, c = (position[triangle[:, i]] for i in range(3))
    normal = np.zeros_like(position)
    np.add.at(normal, triangle.ravel(), np.repeat(np.cross(b - a, c - a), 3, axis=0))
    return normal
