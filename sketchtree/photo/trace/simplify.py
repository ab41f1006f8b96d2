"""Which joints of a traced branch say something? Not those where it neither forks nor turns by 30° or more (§2, Figure 3c)."""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL

TURN = np.radians(30.0)


def telling(parent: Int[np.ndarray, " joint"], xy: Float[np.ndarray, "joint 2"], turn: float = TURN) -> Bool[np.ndarray, " joint"]:
    """Which joints stay: roots, tips, forks, and where the direction since the last one that stays has changed by `turn` or more (radians)."""
    count = len(parent)
    children = np.bincount(parent[parent != NULL], minlength=count)
    keep = (children != 1) | (parent == NULL)
    begin = np.zeros((count, 2))  # direction in which the present piece set out
    child = np.full(count, NULL)
    child[parent[parent != NULL]] = np.flatnonzero(parent != NULL)  # of a joint with one child: that one
    for row in range(count):
        if parent[row] == NULL:
            continue
        up = parent[row]
        step = unit(xy[row] - xy[up])
        begin[row] = step if keep[up] else begin[up]
        if not keep[row]:
            onward = unit(xy[child[row]] - xy[row])
            keep[row] = float(begin[row] @ onward) <= np.cos(turn)
    return keep


def unit(vector: Float[np.ndarray, " 2"]) -> Float[np.ndarray, " 2"]:
    """The same direction at length 1; a vector of no length stays."""
    size = float(np.hypot(*vector))
    return vector / size if size > 0 else vector
