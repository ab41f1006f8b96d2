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
    return made.GetPath()


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
