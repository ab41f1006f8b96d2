"""Where does every joint stand at the times that a USD file holds?

UsdSkel samples all joints together. The times are those of the keys; where these are more than `_MOST` and than `PER_SECOND` a second, a grid takes their place.
A scale is kept there in half precision, 1 part in 2000, which of a joint that bears others would move these by millimetres. So the uniform scale of a
joint that bears others, and moves no vertex itself, is handed down to them and multiplied in there: with s' what comes down to a joint, t and s its own,

    translation = s' t        scale = s' s; of a joint that hands it down, 1

No scale is less than `_LEAST`: readers take a frame apart into turn and scale, and pass over one that they can't (Blender leaves out its key).
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from scipy.spatial.transform import Rotation, Slerp

from sketchtree.asset import Animation, Armature, Keys
from sketchtree.axes import NULL
from sketchtree.export.pose import local_pose

PER_SECOND = 24.0
_MOST = 256
_LEAST = 1e-3
_EVEN = 1e-6  # how far the three channels of a uniform scale may differ, as a share


@dataclass(frozen=True, eq=False)
class Sampled:
    """The joints relative to what they hang on, at each time."""

    time: Float[np.ndarray, " time"]  # seconds
    translation: Float[np.ndarray, "time joint 3"]
    rotation: Float[np.ndarray, "time joint 4"]
    scale: Float[np.ndarray, "time joint 3"]

    def frames(self, bones: Armature, k: int) -> Float[np.ndarray, "joint 4 4"]:
        """In the world, at the k-th time."""
        matrix = np.tile(np.eye(4), (len(bones), 1, 1))
        matrix[:, :3, :3] = Rotation.from_quat(self.rotation[k]).as_matrix() * self.scale[k][:, None]
        matrix[:, :3, 3] = self.translation[k]
        for joints in _downwards(bones):
            matrix[joints] = matrix[bones.parent[joints]] @ matrix[joints]
        return matrix


def sampled(bones: Armature, animation: Animation, moves: Bool[np.ndarray, " joint"]) -> Sampled:
    """All joints at all times that the file holds. `moves`: those that move vertices."""
    rotation, translation = local_pose(bones)
    time = sample_times(animation.seconds, [keys.time for keys in (animation.translation, animation.rotation, animation.scale)])
    moved = _columns(animation.translation, translation, time)
    scale = _columns(animation.scale, np.ones_like(translation), time)
    moved, scale = _handed_down(bones, moved, scale, moves)
    return Sampled(time, moved, _turns(animation.rotation, rotation, time), scale)


def sample_times(seconds: float, times: list) -> Float[np.ndarray, " time"]:
    """The times of all keys, or a grid where these are too many; the first and the last moment are always there."""
    union = np.unique(np.round(np.concatenate([*times, [0.0, seconds]]), 9))
    most = max(int(np.ceil(seconds * PER_SECOND)) + 1, _MOST)
    return union if len(union) <= most else np.linspace(0.0, seconds, most)


def _columns(keys: Keys, rest, time) -> Float[np.ndarray, "time joint channel"]:
    out = np.repeat(rest[None], len(time), axis=0)
    for joint, low, high in zip(keys.joint.tolist(), keys.start[:-1].tolist(), keys.start[1:].tolist(), strict=True):
        for channel in range(rest.shape[1]):
            out[:, joint, channel] = np.interp(time, keys.time[low:high], keys.value[low:high, channel])
    return out


def _turns(keys: Keys, rest, time) -> Float[np.ndarray, "time joint 4"]:
    """On the shorter arc."""
    out = np.repeat(rest[None], len(time), axis=0)
    for joint, low, high in zip(keys.joint.tolist(), keys.start[:-1].tolist(), keys.start[1:].tolist(), strict=True):
        own = keys.time[low:high]
        out[:, joint] = keys.value[low] if high - low == 1 else Slerp(own, Rotation.from_quat(keys.value[low:high]))(np.clip(time, own[0], own[-1])).as_quat()
    flip = np.sum(out[1:] * out[:-1], axis=2) < 0  # one sign from time to time, so that readers that mix the numbers go the same way
    out[1:] *= np.where(np.cumsum(flip, axis=0) % 2, -1.0, 1.0)[..., None]
    return out


def _handed_down(bones: Armature, moved, scale, moves):
    """Translations and scales, with what comes down from the joints that hand their scale on."""
    bears = np.zeros(len(bones), bool)
    bears[bones.parent[bones.parent != NULL]] = True
    even = (np.ptp(scale, axis=2) <= _EVEN * np.abs(scale).max(axis=2)).all(axis=0)  # another would shear what hangs on it
    hands = bears & even & ~moves
    moved, scale = moved.copy(), scale.copy()
    for joints in [np.flatnonzero(bones.parent == NULL), *_downwards(bones)]:
        parent = bones.parent[joints]
        down = np.where((parent != NULL) & hands[parent], scale[:, parent, 0], 1.0)[..., None]
        moved[:, joints] *= down
        scale[:, joints] *= down
    scale[:, hands] = 1.0
    return moved, np.where(np.abs(scale) < _LEAST, np.copysign(_LEAST, scale), scale)


def _downwards(bones: Armature):
    """The joints that hang on others, those nearer to the root first, a generation at a time."""
    depth = np.zeros(len(bones), int)
    for joint in np.flatnonzero(bones.parent != NULL).tolist():
        depth[joint] = depth[bones.parent[joint]] + 1
    return [np.flatnonzero(depth == level) for level in range(1, depth.max(initial=0) + 1)]
