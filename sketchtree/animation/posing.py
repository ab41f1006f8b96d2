"""What does an animated asset look like at a moment? As any program that plays the file shows it.

Morphs first, then joints by linear blend skinning: x' = Σ_j w_j (R_j S_j R_j⁰ᵀ (x − p_j) + T_j), a joint's frame that of its parent's times its own.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float
from scipy.spatial.transform import Rotation

from sketchtree.asset import Animation, Armature, Asset, Keys
from sketchtree.export.pose import local_pose
from sketchtree.geometry.mesh import Mesh

_GONE = 1e-9  # m²: a triangle as small is not there


def posed(asset: Asset, second: float) -> tuple[Mesh, ...]:
    """The meshes of the finest level; triangles without area are left out. What no joint moves stays."""
    matrix, rest = joint_frames(asset.armature, asset.animation, second)
    frame = matrix @ np.linalg.inv(rest)
    morphs = {morph.part: morph for morph in asset.animation.morphs}
    return tuple(_posed(part.merged(), morphs.get(number), frame, second) for number, part in enumerate(asset.parts))


def joint_frames(bones: Armature, animation: Animation, second: float) -> tuple[Float[np.ndarray, "joint 4 4"], Float[np.ndarray, "joint 4 4"]]:
    """(each joint's frame in the world at that moment, at rest)."""
    rotation, translation = local_pose(bones)
    scale = np.ones_like(translation)
    rest = _world(bones, translation, rotation, scale)
    for keys, column in ((animation.translation, translation), (animation.scale, scale)):
        if len(keys):
            column[keys.joint] = _linear(keys, second)
    if len(animation.rotation):
        rotation = rotation.copy()
        rotation[animation.rotation.joint] = _turned(animation.rotation, second)
    return _world(bones, translation, rotation, scale), rest


def _world(bones: Armature, translation, rotation, scale):
    matrix = np.tile(np.eye(4), (len(bones), 1, 1))
    matrix[:, :3, :3] = Rotation.from_quat(rotation).as_matrix() * scale[:, None]
    matrix[:, :3, 3] = translation
    for joints in _by_depth(bones):
        matrix[joints] = matrix[bones.parent[joints]] @ matrix[joints]
    return matrix


def _by_depth(bones: Armature) -> Sequence:
    from sketchtree.traverse import generations

    return generations(bones.parent)[1:]


def _around(keys: Keys, second: float):
    """(the key before the moment, the one after it, how far between) of each track."""
    place = np.repeat(np.arange(len(keys)), np.diff(keys.start)) * 1e6 + keys.time
    after = np.searchsorted(place, np.arange(len(keys)) * 1e6 + second, side="right")
    after = np.clip(after, keys.start[:-1], keys.start[1:] - 1)
    before = np.clip(after - 1, keys.start[:-1], None)
    span = keys.time[after] - keys.time[before]
    return before, after, np.clip((second - keys.time[before]) / np.where(span > 0, span, 1.0), 0.0, 1.0)[:, None]


def _linear(keys: Keys, second: float):
    before, after, share = _around(keys, second)
    return keys.value[before] + share * (keys.value[after] - keys.value[before])


def _turned(keys: Keys, second: float):
    """On the shorter arc, as glTF asks."""
    before, after, share = _around(keys, second)
    low, high = keys.value[before], keys.value[after]
    high = np.where(np.sum(low * high, axis=1, keepdims=True) < 0, -high, high)
    angle = np.arccos(np.clip(np.sum(low * high, axis=1, keepdims=True), -1.0, 1.0))
    near = angle < 1e-6
    whole = np.where(near, 1.0, np.sin(angle))
    mixed = np.where(near, low + share * (high - low), (np.sin((1 - share) * angle) * low + np.sin(share * angle) * high) / whole)
    return mixed / np.linalg.norm(mixed, axis=1, keepdims=True)


def _posed(mesh: Mesh, morph, frame, second: float) -> Mesh:
    if morph is not None:
        mesh = replace(mesh, position=mesh.position + np.interp(second, morph.time, morph.weight) * morph.offset)
    mesh = _skinned(mesh, frame) if "JOINTS_0" in mesh.extra else mesh
    corner = mesh.position[mesh.triangle]
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    return replace(mesh, triangle=mesh.triangle[area > 2.0 * _GONE])


def _skinned(mesh: Mesh, frame) -> Mesh:
    """Where the joints' frames, from rest to the moment, take it."""
    position, joint, weight = mesh.position, mesh.extra["JOINTS_0"].astype(np.int64), mesh.extra["WEIGHTS_0"]
    moved, normal = np.zeros_like(position), np.zeros_like(mesh.normal)
    turned = _normal_frames(frame)
    for k in range(joint.shape[1]):
        of = joint[:, k]
        share = weight[:, k, None]
        moved += share * (np.einsum("vij,vj->vi", frame[of, :3, :3], position) + frame[of, :3, 3])
        normal += share * np.einsum("vij,vj->vi", turned[of], mesh.normal)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = np.where(length > 1e-9, normal / np.maximum(length, 1e-9), mesh.normal)
    extra = {name: column for name, column in mesh.extra.items() if name not in ("JOINTS_0", "WEIGHTS_0")}
    return replace(mesh, position=moved, normal=normal, extra=extra)


def _normal_frames(frame):
    """What turns normals: the frames without their size, or as they are where that is 0."""
    size = np.linalg.norm(frame[:, :3, :3], axis=1)
    return frame[:, :3, :3] / np.maximum(size, 1e-9)[:, None] ** 2 * np.where(size > 1e-9, 1.0, 0.0)[:, None]
