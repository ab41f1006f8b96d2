"""Which vertices of a limb stand so close to its parent that they move with it?

Round a fork the parent's wood gives way differently above and below, while a limb has one value at each place along it. So what is
known along limbs is blended over the collar, from the parent's value beside the vertex to the limb's own:

    value = (1 − f) value(limb, s) + f value(parent, nearest place),   f = 1 − smoothstep((s − b) / 2 r)

    b   what of the limb is buried     r   its radius at the foot
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines
from sketchtree.rig.boughs import Boughs
from sketchtree.rig.place import Places, places_on

_HIGH = 2.0  # radii


class Collar(NamedTuple):
    """One row a vertex of a collar."""

    vertex: Int[np.ndarray, " row"]
    place: Places  # on the parent
    share: Float[np.ndarray, " row"]  # f, of the parent's value


def collar(lines: CentreLines, limbs: Boughs, place: Places, position: Float[np.ndarray, "vertex 3"]) -> Collar:
    """The vertices of all collars; roots and stems have none."""
    foot = lines.radius[lines.start[:-1]]
    up = (place.s - limbs.buried[place.limb]) / (_HIGH * foot[place.limb])
    vertex = np.flatnonzero((lines.parent[place.limb] != NULL) & (up < 1.0))
    beside = places_on(lines, lines.parent[place.limb[vertex]], position[vertex])
    return Collar(vertex, beside, 1.0 - smoothstep(up[vertex]))


def blended(column: Float[np.ndarray, "vertex *channel"], beside: Float[np.ndarray, "row *channel"], over: Collar) -> Float[np.ndarray, "vertex *channel"]:
    """The column with the parents' values `beside` mixed in."""
    share = over.share.reshape(-1, *[1] * (column.ndim - 1))
    mixed = column.copy()
    mixed[over.vertex] += share * (beside - column[over.vertex])
    return mixed


def smoothstep(u: Float[np.ndarray, "*place"]) -> Float[np.ndarray, "*place"]:
    """From 0 to 1, level at both ends; clipped outside."""
    u = np.clip(u, 0.0, 1.0)
    return u * u * (3.0 - 2.0 * u)
