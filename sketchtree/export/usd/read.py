"""What a USD file of ours holds, read back: meshes, places, levels of detail, materials, the skeleton.

Of files from elsewhere what our writer uses is read: triangles without subdivision (polygons are cut into fans), `primvars:st`,
UsdPreviewSurface with textures, PointInstancers, the first UsdSkel skeleton and how it moves; transforms are applied.
"""

import json
import os

import numpy as np
from pxr import Ar, Usd, UsdGeom, UsdShade

from sketchtree.asset import Asset, Level
from sketchtree.errors import ExportError
from sketchtree.export.capsules import capsules_from_json
from sketchtree.export.images import decode
from sketchtree.export.skeletons.packed import skeleton_from_extras
from sketchtree.export.usd.bones import influences, read_bones
from sketchtree.export.usd.moving import read_animation
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Material, Mesh


def read_usd(path: str | os.PathLike) -> Asset:
    """All that the file holds. Raises `ExportError` for what is no USD file, or holds no mesh."""
    try:
        stage = Usd.Stage.Open(str(path))
    except Exception as error:  # pxr raises Tf.ErrorException for every kind of damage
        raise ExportError(f"{path} can't be read as USD.", remedy="Check the path, or write it again.") from error
    told = stage.GetRootLayer().customLayerData
    top = stage.GetDefaultPrim() or stage.GetPseudoRoot()
    levels = _levels(stage, top, json.loads(told.get("lod_coverage", "[]")))
    if not any(level.parts for level in levels):
        raise ExportError(f"{path} holds no mesh.", remedy="Give a USD file with meshes of triangles.")
    skeleton = skeleton_from_extras(json.loads(told["skeleton"])) if "skeleton" in told else None
    capsules = capsules_from_json(json.loads(told["capsules"])) if "capsules" in told else None
    about = {name: value for name, value in told.items() if name not in ("skeleton", "capsules", "creator", "lod_coverage")}
    bones = read_bones(stage)
    moves = None if bones is None else read_animation(stage, bones, _part_prims(stage, top))
    return Asset(levels, skeleton, top.GetName() or "tree", bones, capsules, moves, about)


def _levels(stage, top, coverage: list[float]) -> tuple[Level, ...]:
    names = top.GetVariantSet("LOD").GetVariantNames() if top.HasVariantSets() else []
    materials: dict = {}
    if not names:
        return (Level(tuple(_parts(stage, top, materials))),)
    levels = []
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        for number, name in enumerate(sorted(names)):
            top.GetVariantSet("LOD").SetVariantSelection(name)
            levels.append(Level(tuple(_parts(stage, top, materials)), coverage[number] if number < len(coverage) else 0.0))
    return tuple(levels)


def _part_prims(stage, top) -> list:
    """The prim of each part of the finest level, as `_parts` finds them."""
    levels = top.GetVariantSet("LOD").GetVariantNames() if top.HasVariantSets() else []
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        if levels:
            top.GetVariantSet("LOD").SetVariantSelection(min(levels))
    found, prims = [], iter(Usd.PrimRange(top))
    for prim in prims:
        if prim.IsA(UsdGeom.PointInstancer):
            prims.PruneChildren()
        if prim.IsA(UsdGeom.PointInstancer) or prim.IsA(UsdGeom.Mesh):
            found.append(prim)
    return found


def _parts(stage, top, materials: dict) -> list[Mesh | Instances]:
    parts: list[Mesh | Instances] = []
    prims = iter(Usd.PrimRange(top))
    for prim in prims:
        if prim.IsA(UsdGeom.PointInstancer):
            parts += _instances(stage, prim, materials)
            prims.PruneChildren()
        elif prim.IsA(UsdGeom.Mesh):
            parts.append(_mesh(prim, materials, np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(0)).T))
    return parts


def _instances(stage, prim, materials: dict) -> list[Instances]:
    """All prototypes are one mesh where only their tints differ, as ours are; their tints are `displayColor`."""
    made = UsdGeom.PointInstancer(prim)
    position, scale = np.array(made.GetPositionsAttr().Get(), float), np.array(made.GetScalesAttr().Get(), float)
    turn = np.array([[*q.GetImaginary(), q.GetReal()] for q in made.GetOrientationsAttr().Get()], float).reshape(-1, 4)
    turn /= np.maximum(np.linalg.norm(turn, axis=1, keepdims=True), 1e-12)
    which = np.array(made.GetProtoIndicesAttr().Get())
    color = _column(prim, "displayColor")
    color = None if color is None or len(color) != len(which) else np.column_stack([color, np.ones(len(color))])
    meshes = [_mesh(stage.GetPrimAtPath(path), materials, np.eye(4)) for path in made.GetPrototypesRel().GetTargets()]
    if len({mesh.material.name for mesh in meshes}) == 1 and color is not None:
        return [Instances(_named(meshes[0], prim.GetName()), position, turn, scale, color)]
    rows = [np.flatnonzero(which == number) for number in range(len(meshes))]
    return [Instances(mesh, position[at], turn[at], scale[at], None if color is None else color[at]) for mesh, at in zip(meshes, rows, strict=True)]


def _named(mesh: Mesh, name: str) -> Mesh:
    return Mesh(name, mesh.position, mesh.normal, mesh.uv, mesh.triangle, mesh.material, mesh.color, mesh.extra)


def _mesh(prim, materials: dict, matrix) -> Mesh:
    made = UsdGeom.Mesh(prim)
    position = np.array(made.GetPointsAttr().Get(), float).reshape(-1, 3)
    triangle = _fans(np.array(made.GetFaceVertexCountsAttr().Get()), np.array(made.GetFaceVertexIndicesAttr().Get(), np.int64))
    uv, color = _column(prim, "st"), _column(prim, "displayColor")
    normal = np.array(made.GetNormalsAttr().Get() or [], float).reshape(-1, 3)
    count = len(position)
    uv = np.zeros((count, 2)) if uv is None or len(uv) != count else uv * [1.0, -1.0] + [0.0, 1.0]
    color = np.column_stack([color, np.ones(count)]) if color is not None and len(color) == count else None
    normal = normal if len(normal) == count else np.tile([0.0, 1.0, 0.0], (count, 1))
    normal = normal @ np.linalg.inv(matrix[:3, :3])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    return Mesh(prim.GetName(), position @ matrix[:3, :3].T + matrix[:3, 3], normal, uv, triangle, _bound(prim, materials), color, influences(prim, count))


def _fans(counts, corners):
    """Polygons as triangles that share the polygon's first corner."""
    first = np.cumsum(counts) - counts
    pieces = np.maximum(counts - 2, 0)
    polygon = np.repeat(np.arange(len(counts)), pieces)
    step = np.arange(len(polygon)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
    at = first[polygon]
    return np.stack([corners[at], corners[at + step + 1], corners[at + step + 2]], axis=1)


def _column(prim, name: str):
    primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar(name)
    value = primvar.Get() if primvar else None
    return None if value is None else np.array(value, float)


def _bound(prim, materials: dict) -> Material:
    material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
    if not material:
        return Material(prim.GetName())
    name = material.GetPrim().GetCustomData().get("name") or material.GetPrim().GetName()
    if name not in materials:
        materials[name] = _material(material, name, UsdGeom.Mesh(prim).GetDoubleSidedAttr().Get())
    return materials[name]


def _material(made, name: str, double_sided) -> Material:
    custom = made.GetPrim().GetCustomData()
    surface = made.ComputeSurfaceSource()[0]
    value = lambda word: surface.GetInput(word).Get() if surface and surface.GetInput(word) else None  # noqa: E731
    cutoff = value("opacityThreshold")
    plain = value("diffuseColor")
    color = tuple(custom["base_color"]) if "base_color" in custom else (*plain, 1.0) if plain is not None else (1.0, 1.0, 1.0, 1.0)
    rough = _texture(surface, "roughness", "L")
    return Material(
        name,
        base_color_texture=_texture(surface, "diffuseColor", "RGB" if cutoff is None else "RGBA"),
        normal_texture=_texture(surface, "normal", "RGB"),
        roughness_texture=rough,
        base_color=tuple(map(float, color)),
        roughness=0.9 if value("roughness") is None else float(value("roughness")),
        alpha_cutoff=None if cutoff is None else float(cutoff),
        double_sided=bool(double_sided),
        translucency=float(custom.get("translucency", 0.0)),
    )


def _texture(surface, word: str, mode: str):
    """The pixels of the texture that an input is connected to, or None."""
    source = surface.GetInput(word).GetConnectedSources()[0] if surface and surface.GetInput(word) else []
    if not source:
        return None
    file = UsdShade.Shader(source[0].source.GetPrim()).GetInput("file")
    asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(file.Get().resolvedPath)) if file else None
    return None if asset is None else decode(bytes(asset.GetBuffer()), mode)
