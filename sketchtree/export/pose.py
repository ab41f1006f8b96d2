"""How do bones stand relative to each other, and to the world?

With world rest pose p, r of a joint (and those of its parent, p', r')

    rotation = r'⁻¹ r        translation = r'⁻¹ (p − p')        inverse bind matrix = [r⁻¹ | −r⁻¹ p]
"""

import numpy as np
from scipy.spatial.transform import Rotation

from sketchtree.asset import Armature
from sketchtree.axes import NULL


def local_pose(bones: Armature) -> tuple[np.ndarray, np.ndarray]:
    """(rotation [joint 4] x y z w, translation [joint 3] in metres), each relative to the parent's."""
    world = Rotation.from_quat(bones.rotation)
    has, above = bones.parent != NULL, np.maximum(bones.parent, 0)
    undo = world[above].inv()
    rotation = np.where(has[:, None], (undo * world).as_quat(), bones.rotation)
    return rotation, np.where(has[:, None], undo.apply(bones.position - bones.position[above]), bones.position)


def inverse_bind(bones: Armature) -> np.ndarray:
    """[joint 4 4]: from the world at rest to each joint's own frame."""
    matrix = np.tile(np.eye(4), (len(bones), 1, 1))
    undo = Rotation.from_quat(bones.rotation).inv()
    matrix[:, :3, :3] = undo.as_matrix()
    matrix[:, :3, 3] = -undo.apply(bones.position)
    return matrix
