"""Bones as a glTF skin: one node a joint, relative to its parent's, and the matrices that undo their rest."""

import numpy as np

from sketchtree.asset import Armature
from sketchtree.export.gltf.tables import Tables
from sketchtree.export.pose import inverse_bind, local_pose
from sketchtree.traverse import children


def joint_nodes(bones: Armature, first: int) -> list[dict]:
    """A node a joint, numbered from `first` in the document."""
    rotation, translation = local_pose(bones)
    child, start = children(bones.parent)
    nodes = []
    for i, name in enumerate(bones.name):
        below = (first + child[start[i] : start[i + 1]]).tolist()
        node = {"name": name, "translation": translation[i].tolist(), "rotation": rotation[i].tolist(), "extras": {"length": float(bones.length[i])}}
        nodes.append(node | ({"children": below} if below else {}))
    return nodes


def add_skin(tables: Tables, bones: Armature, first: int) -> int:
    """The number of the skin whose joints are the nodes from `first` on."""
    matrix = np.swapaxes(inverse_bind(bones), 1, 2).reshape(-1, 16).astype("<f4")  # by columns
    joints = list(range(first, first + len(bones)))
    tables.skins.append({"name": "bones", "inverseBindMatrices": tables.column(matrix, None), "joints": joints, "skeleton": first})
    return len(tables.skins) - 1
