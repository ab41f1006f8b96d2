"""The leaves of a photo's tree (§4): where its twigs bear them, kept where the photo confirms them, of the size and as many as its foliage asks for, in its colours.

The paper's own, flat rectangles of a tenth of the trunk's radius, are the leaf model `rectangle` (`paper_leaves`); any other is worn as its species does. Then, unless the species' own
size and density are asked for: about WORN leaves, larger or smaller (`leaf_cover`), and more where twigs are near but the foliage is open (`leaf_filling`), MOST in all. A tree in
blossom wears umbels in clusters instead (`umbels`), in the colours of its petals (`petals`).
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.dressing import Dress
from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.models import leaf_model
from sketchtree.foliage.populate import populate
from sketchtree.foliage.twigs import wood_pieces
from sketchtree.foliage.wear import wear_of
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.photo.leaf_cover import SHORTEST, Page, best_size, grain_of, worthwhile
from sketchtree.photo.leaf_filling import filled
from sketchtree.photo.leaf_print import leaf_print
from sketchtree.photo.leaf_spots import seen_area
from sketchtree.photo.paper_leaves import RECTANGLE, paper_leaves
from sketchtree.photo.petals import flower_colours
from sketchtree.photo.photo_leaves import SeenFoliage, on_shoots, without_shadows
from sketchtree.photo.umbels import Flowering
from sketchtree.photo.wanted import PhotoOptions
from sketchtree.roots import without_roots
from sketchtree.skeleton import TreeSkeleton

MOST = 80_000  # leaves
WORN = 40_000  # leaves, before more are put where it is open
FEW = 0.5  # of that many: where a species bears fewer, they stand closer,
CLOSEST = 10.0  # times as close at most
UMBEL = 0.009  # of the tree's height, length of an umbel: half of LONGEST, so that twigs and gaps show between them; a hand's width where it is 10 m high
LAYERS = 2.4  # times what is to be covered, flowers cover in all before more are put where it is open
DENSEST = 2.0  # times as many, at most, if more are asked for


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
        leaves, size = self._fitted(tree, dress, key)
        if dress.leaf == RECTANGLE:
            return self._printed(self._coloured(leaves)), None
        flowers = blossom(tree, dress.habit, key=key, model=dress.leaf, season=dress.season)
        return self._coloured(leaves), None if flowers is None else self._coloured(self.seen.confirmed(_larger(flowers, size)))

    def _fitted(self, tree: TreeSkeleton, dress: Dress, key) -> tuple[Leaves, float]:
        """(the leaves in their size, how many times the species' that is)."""
        scale, density = self.wanted.leaf_size, self.wanted.leaf_density
        if not self.wanted.fit_leaves:
            worn = self._worn(tree, dress, key, density)
            return _larger(worn, scale), scale
        draw = numpy_generator(stage_key(key, "fitted"))
        if leaf_model(dress.leaf).flower:
            return on_shoots(_larger(_some(self._in_blossom(tree, dress, key), density, draw), scale)), scale
        worn = self._enough(tree, dress, key, int(WORN * np.clip(density, 1.0, DENSEST)), draw)
        if len(worn) == 0:
            return worn, scale
        rootless, _ = without_roots(tree)
        wood = wood_pieces(rootless)
        seen = self.seen.coarser(grain_of(dress.leaf, self.seen, tree.height))
        page = Page.of(seen, wood)
        fit = best_size(worn if density <= 1 else _some(worn, 1 / density, draw), page, seen, height=tree.height, most=MOST)
        leaves = worthwhile(_larger(worn, fit), page, seen)
        if wear_of(dress.habit, dress.leaf).arrangement != "frond":
            leaves = filled(leaves, page, seen, wood.select(rootless.order[wood.row] > 0), _axis(rootless), most=int(MOST * np.clip(density, 1.0, DENSEST)), key=key)
            leaves = worthwhile(leaves, page, seen)
        return on_shoots(_larger(_some(leaves, density, draw), scale)), fit * scale

    def _in_blossom(self, tree: TreeSkeleton, dress: Dress, key) -> Leaves:
        """The flowers of a tree that bears nothing else, LAYERS of them and more where it is open."""
        rootless, _ = without_roots(tree)
        wood, density = wood_pieces(rootless), float(np.clip(self.wanted.leaf_density, 1.0, DENSEST))
        size = max(UMBEL * tree.height, SHORTEST * self.seen.similarity.scale)
        count = min(LAYERS * np.count_nonzero(self.seen.mask) / seen_area(dress.leaf, size / self.seen.similarity.scale), WORN)
        flowering = Flowering.of(rootless, dress.habit, dress.leaf, size=size, key=key)
        seen = self.seen.coarser(grain_of(dress.leaf, self.seen, tree.height))
        page = Page.of(seen, wood)
        flowers = worthwhile(self.seen.confirmed(flowering.umbels(wood, int(density * count))), page, seen)
        flowers = filled(flowers, page, seen, wood.select(rootless.order[wood.row] > 0), _axis(rootless), most=int(MOST * density), key=key, bears=flowering)
        return worthwhile(flowers, page, seen)

    def _enough(self, tree: TreeSkeleton, dress: Dress, key, count: int, draw: np.random.Generator) -> Leaves:
        """About `count` leaves of the twigs."""
        worn = self._worn(tree, dress, key, 1.0)
        if 0 < len(worn) < FEW * count:
            worn = self._worn(tree, dress, key, min(count / len(worn), CLOSEST))
        return _some(worn, count / max(len(worn), 1), draw)

    def _worn(self, tree: TreeSkeleton, dress: Dress, key, density: float) -> Leaves:
        """The leaves that the twigs bear, where their middles are seen in the foliage."""
        if dress.leaf == RECTANGLE:
            return self.seen.confirmed(paper_leaves(tree, key=key, density=density, most=MOST))
        how = {"model": dress.leaf, "season": dress.season, "arrangement": self.wanted.leaf_arrangement}
        return self.seen.confirmed(populate(tree, dress.habit, key=key, density=density, max_leaves=2 * MOST, **how))

    def _printed(self, leaves: Leaves) -> Leaves:
        """With the photo on them, where they are in its colours."""
        return leaves if leaves.seen is None else replace(leaves, printed=leaf_print(self.seen))

    def _coloured(self, leaves: Leaves) -> Leaves:
        """In the colours of the photo, if they are asked for. A grey photo has none to give."""
        if self.wanted.colours != "photo" or self.seen.photo.is_grey or len(leaves) == 0:
            return leaves
        if leaf_model(leaves.model).flower:
            return replace(leaves, seen=flower_colours(self.seen, leaves))
        coloured = self.seen.coloured(leaves)
        return replace(coloured, seen=without_shadows(coloured.seen))


def _axis(tree: TreeSkeleton) -> Float[np.ndarray, " 3"]:
    """The middle of its trunks' feet, metres: out of the crown is away from there."""
    return tree.tip[tree.is_base].mean(axis=0)


def _some(leaves: Leaves, share: float, draw: np.random.Generator) -> Leaves:
    """A share of the leaves, by chance."""
    return leaves if share >= 1 else select(leaves, draw.random(len(leaves)) < share)


def _larger(leaves: Leaves, times: float) -> Leaves:
    """The leaves so many times as large."""
    return replace(leaves, size=times * leaves.size)
