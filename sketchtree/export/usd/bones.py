"""Bones as UsdSkel: a Skeleton prim whose joints are named by their paths, bound and at rest where the armature stands."""

import numpy as np
from pxr import Gf, UsdSkel, Vt
from scipy.spatial.transform import Rotation

from sketchtree.asset import Armature
from sketchtree.axes import NULL
from sketchtree.export.pose import inverse_bind, local_pose
from sketchtree.export.usd.names import prim_name


def define_bones(stage, path: str, bones: Armature):
    """The skeleton's path."""
    made = UsdSkel.Skeleton.Define(stage, path)
    made.CreateJointsAttr(_joint_paths(bones))
    made.CreateJointNamesAttr(list(bones.name))
    made.CreateBindTransformsAttr(_matrices(np.linalg.inv(inverse_bind(bones))))
    rotation, translation = local_pose(bones)
    rest = np.tile(np.eye(4), (len(bones), 1, 1))
    rest[:, :3, :3] = Rotation.from_quat(rotation).as_matrix()
    rest[:, :3, 3] = translation
    made.CreateRestTransformsAttr(_matrices(rest))
    extent = np.stack([bones.position.min(axis=0), bones.position.max(axis=0)]).astype(np.float32)
    made.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(extent))
    made.GetPrim().SetCustomDataByKey("length", Vt.DoubleArray(bones.length.tolist()))  # metres, of each bone
    return made.GetPath()


def read_bones(stage) -> Armature | None:
    """The stage's first skeleton, parents first as UsdSkel asks. None without one."""
    prim = next((prim for prim in stage.Traverse() if prim.IsA(UsdSkel.Skeleton)), None)
    if prim is None:
        return None
    made = UsdSkel.Skeleton(prim)
    paths = list(made.GetJointsAttr().Get())
    bind = np.array([np.array(matrix).T for matrix in made.GetBindTransformsAttr().Get()])
    above = [path.rpartition("/")[0] for path in paths]
    length = prim.GetCustomDataByKey("length")
    return Armature(
        tuple(made.GetJointNamesAttr().Get() or (path.rpartition("/")[2] for path in paths)),
        np.array([paths.index(path) if path in paths else NULL for path in above]),
        bind[:, :3, 3],
        Rotation.from_matrix(bind[:, :3, :3]).as_quat(canonical=True),
        np.zeros(len(paths)) if length is None else np.array(length, float),
    )


def influences(prim, count: int) -> dict:
    """JOINTS_0 and WEIGHTS_0 of a mesh of `count` vertices; nothing where no joint moves it, or other than four a vertex."""
    if not prim.HasAPI(UsdSkel.BindingAPI):
        return {}
    binding = UsdSkel.BindingAPI(prim)
    joints, weights = binding.GetJointIndicesPrimvar().Get(), binding.GetJointWeightsPrimvar().Get()
    if joints is None or weights is None or len(joints) != 4 * count or len(weights) != 4 * count:
        return {}
    return {"JOINTS_0": np.array(joints).reshape(count, 4), "WEIGHTS_0": np.array(weights, float).reshape(count, 4)}


def _joint_paths(bones: Armature) -> list[str]:
    """`root/limb/…`: each joint by all those it hangs on."""
    taken, paths = set(), []
    for name, parent in zip(bones.name, bones.parent.tolist(), strict=True):
        own = prim_name(name, taken)
        paths.append(own if parent == NULL else f"{paths[parent]}/{own}")
    return paths


def _matrices(rows):
    """Row vectors multiply from the left in USD: each matrix is transposed."""
    return Vt.Matrix4dArray([Gf.Matrix4d(*row.T.reshape(-1).tolist()) for row in rows])
