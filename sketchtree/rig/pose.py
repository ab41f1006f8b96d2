"""Where does the surface go when joints turn?

Linear blend skinning, as engines do it: x' = Σ_j w_j (R_j (x − p_j) + p'_j), with the turns of a joint's ancestors added to its own,

    R_j = R_parent T_j        p'_j = R_parent (p_j − p_parent) + p'_parent

    T_j   turn of joint j, in the world's axes      p_j   where it stands at rest
"""

import numpy as np
from jaxtyping import Float
from scipy.spatial.transform import Rotation

from sketchtree.asset import Armature
from sketchtree.axes import NULL
from sketchtree.rig.weights import Weights


def posed(
    armature: Armature, turn: Float[np.ndarray, "joint 3"], weights: Weights, position: Float[np.ndarray, "vertex 3"]
) -> Float[np.ndarray, "vertex 3"]:
    """The vertices when every joint is turned by its rotation vector (radians, world axes at rest)."""
    rotation, moved = pose(armature, turn)
    out = np.zeros_like(position)
    for k in range(weights.joint.shape[1]):
        joint = weights.joint[:, k]
        out += weights.weight[:, k, None] * (np.einsum("vij,vj->vi", rotation[joint], position - armature.position[joint]) + moved[joint])
    return out


def pose(armature: Armature, turn: Float[np.ndarray, "joint 3"]) -> tuple[Float[np.ndarray, "joint 3 3"], Float[np.ndarray, "joint 3"]]:
    """Turn (against rest) and place of every joint."""
    rotation, moved = Rotation.from_rotvec(turn).as_matrix(), armature.position.copy()
    for joint in np.flatnonzero(armature.parent != NULL).tolist():  # at most some dozens
        above = armature.parent[joint]
        moved[joint] = moved[above] + rotation[above] @ (armature.position[joint] - armature.position[above])
        rotation[joint] = rotation[above] @ rotation[joint]
    return rotation, moved
