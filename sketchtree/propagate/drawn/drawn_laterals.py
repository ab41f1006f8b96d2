"""Where are the laterals that were drawn, and what do they say about new ones beside them?"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.propagate.blocks.open_branch import OpenBranches, limb_arcs
from sketchtree.skeleton import TreeSkeleton

_LIKE_BLOCK = 1.5  # times the length its block says, a new limb on the trunk is no longer than that
_LIKE_DRAWN = 1.1  # times the drawn laterals around it, a new one on a drawn limb is no longer
_SHORTER = (0.8, 1.05)  # times the drawn limbs around it, a new one on the trunk is between these
_APART = np.cos(np.radians(25.0))  # a new lateral this close to a drawn one's direction is not grown


@dataclass(frozen=True, eq=False)
class DrawnLaterals:
    """The drawn laterals, sorted along one axis on which every limb has a stretch of its own."""

    place: Float[np.ndarray, " lateral"]  # limb · stretch + arc of the node, rising
    limb: Int[np.ndarray, " lateral"]  # dense number of the parent limb
    node: Int[np.ndarray, " lateral"]  # row it grows from
    heading: Float[np.ndarray, "lateral 3"]  # unit
    end: Float[np.ndarray, "lateral 3"]  # tip of the whole lateral, metres
    length: Float[np.ndarray, " lateral"]  # of the whole lateral, metres
    at: Float[np.ndarray, " segment"]  # the same axis for the tip of every row of the tree
    of_row: Int[np.ndarray, " segment"]

    @classmethod
    def of(cls, tree: TreeSkeleton) -> "DrawnLaterals":
        """All laterals of a drawn tree."""
        arc, whole = limb_arcs(tree)
        _, of_row = np.unique(tree.limb, return_inverse=True)
        at = of_row * (2.0 * arc.max(initial=0.0) + 1.0) + arc
        above = np.where(tree.parent == NULL, 0, tree.parent)
        rows = np.flatnonzero((tree.parent != NULL) & (tree.limb != tree.limb[above]) & (tree.length > 0))
        rows = rows[np.argsort(at[tree.parent[rows]], kind="stable")]
        node = tree.parent[rows]
        tip = np.zeros(of_row.max(initial=-1) + 1, np.int64)
        tip[of_row] = np.arange(len(tree))
        heading = tree.vector[rows] / tree.length[rows][:, None]
        return cls(at[node], of_row[node], node, heading, tree.tip[tip[of_row[rows]]], whole[rows], at, of_row)

    def beside(
        self, new: OpenBranches, spacing: Float[np.ndarray, " segment"]
    ) -> Bool[np.ndarray, " branch"]:
        """Which new branches start near a drawn lateral of the same limb and point its way."""
        clash = np.zeros(len(new), bool)
        if not len(self.place):
            return clash
        at = self.at[new.row]
        following = np.searchsorted(self.place, at)
        for offset in (-2, -1, 0, 1):
            other = np.clip(following + offset, 0, len(self.place) - 1)
            near = np.abs(self.place[other] - at) < 1.2 * spacing[new.row]
            clash |= near & (np.einsum("bi,bi->b", self.heading[other], new.frame[:, :, 1]) > _APART)
        return clash

    def fitted(self, new: OpenBranches, key: Key[Array, ""] | np.uint64) -> OpenBranches:
        """The new branches, about as long as the drawn ones where each starts: on a trunk `_SHORTER` of them, but no longer than
        `_LIKE_BLOCK` of what their blocks say; elsewhere as their blocks say, but no longer than `_LIKE_DRAWN` of them."""
        usual = self.usual_length(new)
        at_most = np.minimum(new.length, _LIKE_DRAWN * usual)
        like = usual * (_SHORTER[0] + (_SHORTER[1] - _SHORTER[0]) * keys.uniform(key, new.limb, 12))
        like = np.where(new.order == 1, np.minimum(like, _LIKE_BLOCK * new.length), at_most)
        return replace(new, length=np.where(np.isnan(usual), new.length, like))

    def usual_length(self, new: OpenBranches) -> Float[np.ndarray, " branch"]:
        """How long the drawn laterals are where each new branch starts, interpolated along the limb; NaN
        on limbs with none. On the page a limb is as long as it was drawn or longer in depth, never shorter."""
        usual = np.full(len(new), np.nan)
        if not len(self.place):
            return usual
        at, limb = self.at[new.row], self.of_row[new.row]
        right = np.clip(np.searchsorted(self.place, at), 0, len(self.place) - 1)
        left = np.maximum(right - 1, 0)
        right_on, left_on = self.limb[right] == limb, self.limb[left] == limb
        span = self.place[right] - self.place[left]
        t = np.clip(np.where(span > 0, (at - self.place[left]) / np.where(span > 0, span, 1.0), 1.0), 0.0, 1.0)
        t = np.where(left_on & right_on, t, np.where(right_on, 1.0, 0.0))
        between = (1 - t) * self.length[left] + t * self.length[right]
        return np.where(left_on | right_on, between, np.nan)
