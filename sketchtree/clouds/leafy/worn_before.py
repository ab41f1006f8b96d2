"""Where did a tree wear leaves, as its file has them? A tree of a point cloud that is written, read again and grown keeps them where they were seen: the leaves of the file are what was seen.

    place' = foot + s (place − foot)        s  how many times as high it is to be
"""

from collections.abc import Sequence

import numpy as np

from sketchtree.clouds.leafy.covering import Covering
from sketchtree.geometry.instances import Instances
from sketchtree.geometry.mesh import Mesh
from sketchtree.skeleton import TreeSkeleton


def worn_before(parts: Sequence[Mesh | Instances], tree: TreeSkeleton, height: float | None = None) -> Covering | None:
    """Puts leaves where those of a file are; None where it has none. `height`: to which its tree is scaled, metres."""
    merged = [part.merged() for part in parts]
    place = np.concatenate([np.zeros((0, 3)), *(mesh.position for mesh in merged if _is_leaf(mesh.name))])
    if not len(place):
        return None
    scale, foot = 1.0 if height is None else height / tree.height, tree.tip[np.flatnonzero(tree.is_base)[0]]
    return Covering(foot + scale * (place - foot))


def _is_leaf(name: str) -> bool:
    """Neither wood, nor a blossom, nor a stem."""
    return name.startswith("leaf") and not name.startswith(("leaf_blossom", "leaf_stem"))
