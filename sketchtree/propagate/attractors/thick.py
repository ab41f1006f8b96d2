"""Does a new branch run through a thick limb?

What was drawn has its thickness, and no branch can go through it; what tries would be cut there in the end (`after.untangle`), with all that has grown on it by then. A thick limb is a row of balls:

    |piece − p_j| < r_j + ½ |p_j+1 − p_j|        but not on the limb that bears the branch, within `_CROTCH` of its radii from the branch's foot, where it leaves it

Thin wood is let through here: there is room to turn it aside later.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.spatial import cKDTree

from sketchtree.propagate.attractors.attractors import squared_each
from sketchtree.propagate.attractors.wood import Wood

_THICK = 0.2  # leaf lengths: a limb of less radius is thin
_APART = 0.5  # leaf lengths from ball to ball, or half the radius, whichever is more
_CROTCH = 3.0  # radii of the bearer, that a branch may take to leave it
_MARGIN = 0.1  # leaf lengths, that a branch stays off: it has a radius too


@dataclass(frozen=True, eq=False)
class Thick:
    """The thick limbs of the tree given, as balls."""

    place: Float[np.ndarray, "ball 3"]
    radius: Float[np.ndarray, " ball"]  # metres, and half of what lies between
    limb: Int[np.ndarray, " ball"]
    arc: Float[np.ndarray, " ball"]  # metres along it
    tree: cKDTree | None

    @classmethod
    def of(cls, wood: Wood, leaf: float) -> "Thick":
        """Of the limbs given; no ball where none is thick."""
        place, radius, limb, arc = [np.zeros((0, 3))], [np.zeros(0)], [np.zeros(0, np.int64)], [np.zeros(0)]
        for number, one in enumerate(wood.limbs[: wood.given]):
            apart = max(_APART * leaf, 0.5 * one.radius)
            at = np.linspace(0.0, one.length, max(int(np.ceil(one.length / apart)), 1) + 1)
            thick = one.radius_at(at)
            at, thick = at[thick > _THICK * leaf], thick[thick > _THICK * leaf]
            place.append(one.place(at)), radius.append(thick + _MARGIN * leaf), limb.append(np.full(len(at), number)), arc.append(at)
        place = np.concatenate(place)
        return cls(place, np.concatenate(radius), np.concatenate(limb), np.concatenate(arc), cKDTree(place) if len(place) else None)

    def struck(self, start: Float[np.ndarray, "piece 3"], end: Float[np.ndarray, "piece 3"], limb: Int[np.ndarray, " piece"], at: Float[np.ndarray, " piece"]) -> Bool[np.ndarray, " piece"]:
        """Which straight pieces run through a thick limb; each is of a branch that leaves `limb` so many metres along it."""
        struck = np.zeros(len(start), bool)
        if self.tree is None or len(start) == 0:
            return struck
        middle, half = 0.5 * (start + end), 0.5 * np.linalg.norm(end - start, axis=1)
        near = self.tree.query_ball_point(middle, half + self.radius.max())
        piece = np.repeat(np.arange(len(start)), [len(balls) for balls in near])
        ball = np.concatenate([np.zeros(0), *near]).astype(np.int64)
        leaves = (self.limb[ball] == limb[piece]) & (np.abs(self.arc[ball] - at[piece]) < _CROTCH * self.radius[ball])
        piece, ball = piece[~leaves], ball[~leaves]
        hit = squared_each(self.place[ball], start[piece], end[piece]) < self.radius[ball] ** 2
        struck[piece[hit]] = True
        return struck
