"""The leaves of a photo's tree (§4): where its twigs bear them, kept where the photo confirms them, of the size and as many as its foliage asks for, in its colours.

The paper's own, flat rectangles of a tenth of the trunk's radius, are the leaf model `rectangle` (`paper_leaves`). Any other is worn as its species does, larger or smaller (`leaf_cover`),
and up to DENSEST times as dense where they would have to be larger than they may.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Key

from sketchtree.dressing import Dress
from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.populate import populate
from sketchtree.keys import stage_key
from sketchtree.photo.leaf_cover import best_size, mostly_inside
from sketchtree.photo.leaf_print import leaf_print
from sketchtree.photo.paper_leaves import RECTANGLE, paper_leaves
from sketchtree.photo.photo_leaves import SeenFoliage, without_shadows
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.skeleton import TreeSkeleton

DENSEST = 4.0
MOST = 80_000  # leaves


@dataclass(frozen=True)
class PhotoLeafing:
    """Makes the leaves of one tree."""

    seen: SeenFoliage
    wanted: PhotoOptions = PhotoOptions()

    def __call__(self, tree: TreeSkeleton, dress: Dress, key: Key[Array, ""]) -> tuple[Leaves, Leaves | None]:
        """(leaves, blossoms of a spring)."""
        key = stage_key(key, "foliage")
        if dress.leaf is None:
            return Leaves.none(dress.habit.leaf), None
        if dress.leaf == RECTANGLE:
            found = paper_leaves(tree, key=key, scale=self.wanted.leaf_size, density=self.wanted.leaf_density, most=MOST)
            return self._printed(self._coloured(self.seen.confirmed(found))), None
        flowers = blossom(tree, dress.habit, key=key, model=dress.leaf, season=dress.season)
        return self._coloured(self._fitted(tree, dress, key)), None if flowers is None else self._coloured(self.seen.confirmed(flowers))

    def _fitted(self, tree: TreeSkeleton, dress: Dress, key) -> Leaves:
        """The leaves in their size."""
        density = self.wanted.leaf_density
        leaves = self._worn(tree, dress, key, density)
        if not self.wanted.fit_leaves:
            return replace(leaves, size=self.wanted.leaf_size * leaves.size)
        size, _, open_size = best_size(leaves, self.seen, tree.height)
        more = min((open_size / size) ** 2, DENSEST, MOST / max(len(leaves), 1))
        if more > 1.1:
            leaves = self._worn(tree, dress, key, more * density)
            size, _, _ = best_size(leaves, self.seen, tree.height)
        return mostly_inside(replace(leaves, size=size * self.wanted.leaf_size * leaves.size), self.seen)

    def _worn(self, tree: TreeSkeleton, dress: Dress, key, density: float) -> Leaves:
        """The leaves that the twigs bear, where their middles are seen in the foliage."""
        how = {"model": dress.leaf, "season": dress.season, "arrangement": self.wanted.leaf_arrangement}
        return self.seen.confirmed(populate(tree, dress.habit, key=key, density=density, max_leaves=2 * MOST, **how))

    def _printed(self, leaves: Leaves) -> Leaves:
        """With the photo on them, where they are in its colours."""
        return leaves if leaves.seen is None else replace(leaves, printed=leaf_print(self.seen))

    def _coloured(self, leaves: Leaves) -> Leaves:
        """In the colours of the photo, if they are asked for. A grey photo has none to give."""
        if self.wanted.colours != "photo" or self.seen.photo.is_grey or len(leaves) == 0:
            return leaves
        coloured = self.seen.coloured(leaves)
        return replace(coloured, seen=without_shadows(coloured.seen))
