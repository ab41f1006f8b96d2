"""Where would a new branch run through thick wood, into the ground, or hang far below the crown?"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from scipy.spatial import cKDTree

from sketchtree.growth.crown_base import crown_base
from sketchtree.growth.straight import radius_at_start
from sketchtree.skeleton import TreeSkeleton

THICK = 0.2  # of the radius at the ground: wood that nothing may run through
_ABOVE = 0.02  # of the tree's height: as near as new wood comes to the ground
_HANGS = 0.2  # of the height at which the crown begins: so far below may new wood hang
_NEAREST = 6  # samples asked


@dataclass(frozen=True, eq=False)
class Clearance:
    """Points along the thick wood of a tree, each with the radius there."""

    tree: cKDTree | None
    radius: Float[np.ndarray, " sample"]
    lowest: float  # metres: height below which no new wood goes down

    @classmethod
    def of(cls, tree: TreeSkeleton) -> "Clearance":
        """That of a tree without curve points."""
        low, thickest = (float(tree.tip[tree.is_base, 1].min()), float(tree.radius.max())) if len(tree) else (0.0, 0.0)
        thick = np.flatnonzero(~tree.is_base & (tree.radius > THICK * thickest))
        count = np.ceil(tree.length[thick] / tree.radius[thick]).astype(int) + 1
        row = np.repeat(thick, count)
        share = (np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count)) / np.repeat(np.maximum(count - 1, 1), count)
        radius = (1 - share) * radius_at_start(tree)[row] + share * tree.radius[row]
        points = tree.start[row] + share[:, None] * tree.vector[row]
        base = crown_base(tree) if len(tree) else None
        lowest = _ABOVE * tree.height if base is None else max(_ABOVE * tree.height, (1 - _HANGS) * (base - low))
        return cls(cKDTree(points) if len(points) else None, radius, low + lowest)

    def blocked(
        self, start: Float[np.ndarray, "piece 3"], end: Float[np.ndarray, "piece 3"], foot: Float[np.ndarray, "piece 3"], near: Float[np.ndarray, " piece"]
    ) -> Bool[np.ndarray, " piece"]:
        """Pieces that go down below the lowest height, or whose middle or end lies in thick wood farther than `near` metres from their foot."""
        bad = (end[:, 1] < self.lowest) & (end[:, 1] < start[:, 1])
        if self.tree is None or len(start) == 0:
            return bad
        for point in (0.5 * (start + end), end):
            away, sample = self.tree.query(point, k=min(_NEAREST, len(self.radius)))
            away, sample = away.reshape(len(point), -1), sample.reshape(len(point), -1)
            bad |= (away < self.radius[sample]).any(axis=1) & (np.linalg.norm(point - foot, axis=1) > near)
        return bad
