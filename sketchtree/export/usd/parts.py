"""Meshes and places as USD prims.

Triangles, normals a vertex, `primvars:st` with the image's first row at v = 1, no subdivision. A mesh with tints has its faces in subsets, one a
tint; places of one mesh are a PointInstancer with a prototype a tint. The exact tint is `primvars:displayColor` besides.
"""

import re

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, UsdSkel, Vt

from sketchtree.export.usd.materials import Materials
from sketchtree.export.usd.names import prim_name
from sketchtree.export.usd.tints import nearest, tint_of
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh


def define_mesh(stage, path: str, mesh: Mesh, materials: Materials, *, skeleton=None) -> None:
    """A UsdGeom.Mesh with its material, bound to the skeleton (its path) where it names joints."""
    made = _shape(stage, path, mesh)
    tint = tint_of(mesh)
    if tint is None:
        _bind(made.GetPrim(), materials.of(mesh.material))
    else:
        _primvar(made, "displayColor", Sdf.ValueTypeNames.Color3fArray, np.asarray(mesh.color, float)[:, :3], "vertex")
        _bind_tints(made, mesh, tint, materials)
    if skeleton is not None and "JOINTS_0" in mesh.extra:
        _bend(made, mesh, skeleton)


def define_places(stage, path: str, places: Instances, materials: Materials) -> None:
    """A UsdGeom.PointInstancer whose prototypes are the mesh in each of a few tints."""
    made = UsdGeom.PointInstancer.Define(stage, path)
    plain = Mesh(places.mesh.name, places.mesh.position, places.mesh.normal, places.mesh.uv, places.mesh.triangle, places.mesh.material, None, _movable(places.mesh))
    tint = tint_of(places)
    tint = np.ones((len(places), 3)) if tint is None else tint
    used, which = np.unique(nearest(tint, materials.palettes[id(plain.material)]), return_inverse=True)
    taken: set[str] = set()
    prototypes = []
    for number in used:
        prototype = f"{path}/{prim_name(places.name, taken)}"
        _bind(_shape(stage, prototype, plain).GetPrim(), materials.of(plain.material, materials.palettes[id(plain.material)][number]))
        prototypes.append(Sdf.Path(prototype))
    made.CreatePrototypesRel().SetTargets(prototypes)
    made.CreateProtoIndicesAttr(Vt.IntArray.FromNumpy(which.astype(np.int32)))
    made.CreatePositionsAttr(_vectors(places.translation))
    made.CreateOrientationsAttr(_quaternions(places.rotation))
    made.CreateScalesAttr(_vectors(places.scale))
    UsdGeom.PrimvarsAPI(made).CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, "varying").Set(_vectors(tint))
    extent = UsdGeom.PointInstancer.ComputeExtentAtTime(made, Usd.TimeCode.Default(), Usd.TimeCode.Default())
    if extent is not None and len(extent) == 2:
        made.CreateExtentAttr(extent)


def _shape(stage, path: str, mesh: Mesh):
    """Points, faces, normals, texture coordinates, further columns."""
    made = UsdGeom.Mesh.Define(stage, path)
    made.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    made.CreatePointsAttr(_vectors(mesh.position))
    made.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(mesh.triangle), 3, np.int32)))
    made.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(np.ascontiguousarray(mesh.triangle.reshape(-1), np.int32)))
    made.CreateNormalsAttr(_vectors(mesh.normal))
    made.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
    made.CreateDoubleSidedAttr(bool(mesh.material.double_sided))
    made.CreateExtentAttr(_vectors(np.stack([mesh.position.min(axis=0), mesh.position.max(axis=0)])))
    _primvar(made, "st", Sdf.ValueTypeNames.TexCoord2fArray, mesh.uv * [1.0, -1.0] + [0.0, 1.0], "vertex")
    for name, column in mesh.extra.items():
        column = np.asarray(column, float)
        if match := re.fullmatch(r"TEXCOORD_(\d+)", name):
            _primvar(made, f"st{match[1]}", Sdf.ValueTypeNames.TexCoord2fArray, column * [1.0, -1.0] + [0.0, 1.0], "vertex")
        elif not re.match(r"JOINTS_|WEIGHTS_", name):
            _primvar(made, name.strip("_").lower(), _TYPE[column.shape[1]], column, "vertex")
    return made


def _movable(mesh: Mesh) -> dict:
    return {name: column for name, column in mesh.extra.items() if not re.match(r"JOINTS_|WEIGHTS_", name)}


def _bind(prim, material) -> None:
    UsdShade.MaterialBindingAPI.Apply(prim).Bind(material)


def _bind_tints(made, mesh: Mesh, tint, materials: Materials) -> None:
    palette = materials.palettes[id(mesh.material)]
    which = nearest(tint, palette)
    used = np.unique(which)
    _bind(made.GetPrim(), materials.of(mesh.material, palette[used[0]]))
    if len(used) == 1:
        return
    binding = UsdShade.MaterialBindingAPI(made.GetPrim())
    for number in used:
        faces = np.flatnonzero(which == number).astype(np.int32)
        subset = binding.CreateMaterialBindSubset(f"tint_{number + 1}", Vt.IntArray.FromNumpy(faces))
        _bind(subset.GetPrim(), materials.of(mesh.material, palette[number]))
    binding.SetMaterialBindSubsetsFamilyType(UsdGeom.Tokens.partition)


def _bend(made, mesh: Mesh, skeleton) -> None:
    """Which joints move each vertex, and how much."""
    binding = UsdSkel.BindingAPI.Apply(made.GetPrim())
    joints, weights = np.asarray(mesh.extra["JOINTS_0"]), np.asarray(mesh.extra["WEIGHTS_0"], float)
    weights = weights / np.maximum(weights.sum(axis=1, keepdims=True), 1e-12)
    binding.CreateJointIndicesPrimvar(False, joints.shape[1]).Set(Vt.IntArray.FromNumpy(joints.reshape(-1).astype(np.int32)))
    binding.CreateJointWeightsPrimvar(False, weights.shape[1]).Set(Vt.FloatArray.FromNumpy(weights.reshape(-1).astype(np.float32)))
    binding.CreateGeomBindTransformAttr(Gf.Matrix4d(1.0))
    binding.CreateSkeletonRel().SetTargets([skeleton])


_TYPE = {1: Sdf.ValueTypeNames.FloatArray, 2: Sdf.ValueTypeNames.Float2Array, 3: Sdf.ValueTypeNames.Float3Array, 4: Sdf.ValueTypeNames.Float4Array}
_ARRAY = {1: Vt.FloatArray, 2: Vt.Vec2fArray, 3: Vt.Vec3fArray, 4: Vt.Vec4fArray}


def _primvar(made, name: str, kind, column, interpolation: str) -> None:
    column = np.ascontiguousarray(column, np.float32)
    array = _ARRAY[column.shape[1]].FromNumpy(column[:, 0] if column.shape[1] == 1 else column)
    UsdGeom.PrimvarsAPI(made).CreatePrimvar(name, kind, interpolation).Set(array)


def _vectors(rows):
    return Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(rows, np.float32))


def _quaternions(rows):
    """x y z w → USD's half-precision quaternions."""
    rows = np.asarray(rows, float)
    return Vt.QuathArray([Gf.Quath(w, x, y, z) for x, y, z, w in rows.tolist()])
