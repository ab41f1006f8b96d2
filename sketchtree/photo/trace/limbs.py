"""Which joints make up one limb? A limb is a chain: where it forks, one child carries it on."""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.photo.trace.follow import angle


def carried_on(
    parent: Int[np.ndarray, " joint"], xy: Float[np.ndarray, "joint 2"], half: Float[np.ndarray, " joint"], stroke: Int[np.ndarray, " joint"], drawn: Bool[np.ndarray, " joint"]
) -> Int[np.ndarray, " joint"]:
    """Which child carries each joint's limb on: its own stroke's next place, else the one that bends least for its thickness; NULL at a tip."""
    carries = np.full(len(parent), NULL)
    children: dict[int, list[int]] = {}
    for row, up in enumerate(parent):
        if up != NULL:
            children.setdefault(int(up), []).append(row)
    for up, rows in children.items():
        own = [k for k in rows if drawn[k] and drawn[up] and stroke[k] == stroke[up]]
        if own:
            carries[up] = own[0]
            continue
        before = xy[up] - xy[parent[up]] if parent[up] != NULL else np.array([0.0, -1.0])
        bend = [angle(before, xy[k] - xy[up]) for k in rows]
        best = int(np.argmin([b - 0.5 * half[k] / half[up] for b, k in zip(bend, rows, strict=True)]))
        carries[up] = rows[best]
    return carries


def found_limbs(parent: Int[np.ndarray, " joint"], carries: Int[np.ndarray, " joint"], drawn: Bool[np.ndarray, " joint"]) -> list[list[int]]:
    """The rows of every limb, or end of one, that lies on no stroke; after the limbs that they grow from."""
    limbs = []
    for row in np.flatnonzero(~np.asarray(drawn)):
        if carries[parent[row]] != row or drawn[parent[row]]:
            rows = [int(row)]
            while carries[rows[-1]] != NULL:
                rows.append(int(carries[rows[-1]]))
            limbs.append(rows)
    return limbs
