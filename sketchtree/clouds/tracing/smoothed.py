"""How do axes run between places that were seen, and where does a branch leave what bears it?

Centres of layers wander by what of the bark was seen. Along a limb each is drawn to the middle of its neighbours, the more, the less sure it is (a tip and a foot stay).

Where wood forks, a layer holds both branches for a while, so a branch seems to leave too far up and sideways. It is led back along its own first course to the axis of
what bears it, as far as it leaves that smoothly.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.traverse import limb_chains

_PASSES, _STIFF = 3, 8
_SLIM = 0.4  # radii over steps: thinner wood is left as it is
_LOST, _KNOWN = 0.3, 0.25  # how far a centre goes to the middle of its neighbours in each pass
_COURSE = 4  # nodes that a limb's first course is told by
_BACK = 6  # nodes that it may be led back


def smoothed(
    parent: Int[np.ndarray, " node"], centre: Float[np.ndarray, "node 3"], limb: Int[np.ndarray, " node"], known: Bool[np.ndarray, " node"]
) -> Float[np.ndarray, "node 3"]:
    """Centres, metres; `known`: those that lie on an axis that was seen."""
    return _drawn(parent, centre, limb, np.where(known, _KNOWN, _LOST), _PASSES)


def straightened(
    parent: Int[np.ndarray, " node"], centre: Float[np.ndarray, "node 3"], limb: Int[np.ndarray, " node"], radius: Float[np.ndarray, " node"]
) -> Float[np.ndarray, "node 3"]:
    """Centres, metres, of wood whose thickness is known: thick wood doesn't turn within a few of its radii, twigs stay as they are."""
    step = np.where(parent == NULL, np.inf, np.linalg.norm(centre - centre[parent], axis=1))
    return _drawn(parent, centre, limb, 0.5 * np.clip((radius / np.maximum(step, 1e-12) - _SLIM) / (1.0 - _SLIM), 0.0, 1.0), _STIFF)


def _drawn(parent, centre, limb, share, passes: int):
    """Each to the middle of its neighbours by such a share, so many times."""
    centre = centre.copy()
    for rows in limb_chains(parent, limb):
        whole = np.r_[parent[rows[0]], rows] if parent[rows[0]] != NULL else rows
        if len(whole) < 3:
            continue
        inner = whole[1:-1]
        for _ in range(passes):
            middle = (centre[whole[:-2]] + centre[whole[2:]]) / 2
            centre[inner] += share[inner, None] * (middle - centre[inner])
    return centre


def led_back(
    parent: Int[np.ndarray, " node"], centre: Float[np.ndarray, "node 3"], limb: Int[np.ndarray, " node"], radius: Float[np.ndarray, " node"]
) -> Int[np.ndarray, " node"]:
    """Parents, where first nodes of limbs hang farther back on what bears them. `radius`: metres."""
    parent = parent.copy()
    for rows in limb_chains(parent, limb):
        foot = parent[rows[0]]
        if foot == NULL:
            continue
        course = centre[rows[min(_COURSE, len(rows)) - 1]] - centre[rows[0]] if len(rows) > 1 else centre[rows[0]] - centre[foot]
        course = course / max(np.linalg.norm(course), 1e-12)
        best, least = foot, np.inf
        row, back = foot, 0
        while row != NULL and limb[row] == limb[foot] and back < _BACK:
            way = centre[rows[0]] - centre[row]
            length = max(np.linalg.norm(way), 1e-12)
            upward = centre[row] - centre[parent[row]] if parent[row] != NULL else np.array([0.0, 1.0, 0.0])
            upward = upward / max(np.linalg.norm(upward), 1e-12)
            bend = (1.0 - way @ course / length) + 0.5 * max(0.0, 0.3 - way @ upward / length) + 0.02 * back
            if length > 0.8 * radius[row] and bend < least:
                best, least = row, bend
            row, back = parent[row], back + 1
        parent[rows[0]] = best
    return parent
