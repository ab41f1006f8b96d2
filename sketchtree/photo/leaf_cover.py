"""What do leaves cover of the photo's foliage, how large should they be, and which of them are worth having?

Ours: §4 leaves size and density to the user. Every spot of a leaf (`leaf_spots`) covers its part of a pixel, and chances multiply; wood covers too:

    e = Π (1 − a)        how open a pixel is    a   of each spot in it, pixels², at most FULL
    O = Σ_m (1 − e) / (|m| + Σ_¬m (e_wood − e))        overlap of the tree with the foliage m

A leaf is kept where INSIDE of its spots are seen in the foliage (the paper asks for its middle alone, and leaves blur the outline), and where it covers more of the foliage than of what
is round it that no other covers. Of all lengths that a tree bears, from SHORTEST pixels to LONGEST of its height, the smallest is taken that is hardly worse than the best, when what it
leaves open has been filled (`leaf_filling`): small leaves look like a crown, large ones like a tree of paper.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.models import leaf_painting
from sketchtree.foliage.triangles import drawn_area
from sketchtree.foliage.twigs import Twigs
from sketchtree.photo.leaf_spots import COUNTS, LeafSpots, planes_of, seen_area, spot_count
from sketchtree.photo.photo_leaves import SeenFoliage

INSIDE = 0.6  # of a blade
FULL = 0.95  # of a pixel
SHORTEST = 2.5  # pixels: smaller leaves are smaller than what a photo shows
LONGEST = 0.016  # of the tree's height; of a narrow leaf as much more as gives it the area of a broad one, BROAD of its length squared
BROAD = 0.35
STEP = 1.15  # between two lengths that are tried
_HARDLY = 0.01  # of overlap
_FILLED, _AIMED = 0.65, 0.3  # of what is open can be filled, if there are leaves enough; of a leaf that fills, lies where it is open


@dataclass(frozen=True, eq=False)
class Page:
    """The foliage and the wood of a tree, in the pixels of its photo; a rim of one pixel stands for all that is off the picture."""

    mask: Bool[np.ndarray, "pixel"]
    shape: tuple[int, int]
    beside_wood: Float[np.ndarray, "pixel"]  # how much of each no wood covers

    @classmethod
    def of(cls, seen: SeenFoliage, wood: Twigs) -> "Page":
        """`wood`: all of the tree's."""
        mask = np.pad(seen.mask, 1)
        bare = cls(mask.reshape(-1), mask.shape, np.ones(mask.size, np.float32))
        place, area = _wood_spots(wood, seen)
        return replace(bare, beside_wood=np.exp(-bare.depth(bare.pixels(*place.T), area)))

    @property
    def room(self) -> int:
        """Pixels of the foliage."""
        return int(np.count_nonzero(self.mask))

    def pixels(self, column: Float[np.ndarray, "*spot"], row: Float[np.ndarray, "*spot"]) -> Int[np.ndarray, "*spot"]:
        """The pixel that each place lies in."""
        column = np.clip(column + 1, 0, self.shape[1] - 1).astype(np.int32)
        row = np.clip(row + 1, 0, self.shape[0] - 1).astype(np.int32)
        return row * self.shape[1] + column

    def places(self, pixel: Int[np.ndarray, " spot"], within: Float[np.ndarray, "spot 2"]) -> Float[np.ndarray, "spot 2"]:
        """Where in the photo; `within`: from the pixel's upper left corner, 0-1."""
        return np.stack([pixel % self.shape[1] - 1, pixel // self.shape[1] - 1], axis=1) + within

    def depth(self, pixel: Int[np.ndarray, "*spot"], area: Float[np.ndarray, "*spot"]) -> Float[np.ndarray, " pixel"]:
        """−log of what spots leave open of each pixel."""
        return np.bincount(pixel.reshape(-1), hiding(area).reshape(-1), minlength=len(self.mask)).astype(np.float32)

    def open(self, depth: Float[np.ndarray, " pixel"]) -> Float[np.ndarray, " pixel"]:
        """How much of each pixel neither leaves nor wood cover."""
        return np.exp(-depth) * self.beside_wood

    def covered(self, depth: Float[np.ndarray, " pixel"]) -> tuple[float, float]:
        """(what the tree covers of the foliage, what its leaves cover of the rest), pixels."""
        left = self.open(depth)
        return self.room - float(left[self.mask].sum(dtype=float)), float((self.beside_wood - left)[~self.mask].sum(dtype=float))


def grain_of(model: str, seen: SeenFoliage, height: float) -> int:
    """How many times as large pixels may be, so that the spots of the longest leaf still fill it; for `SeenFoliage.coarser`."""
    return max(int(np.sqrt(seen_area(model, longest_of(model, height) / seen.similarity.scale) / (COUNTS[-1] * planes_of(model)))), 1)


def longest_of(model: str, height: float) -> float:
    """The length of the longest leaf that a tree of a height bears, metres."""
    return LONGEST * height * max(np.sqrt(BROAD / drawn_area(leaf_painting(model))), 1.0)


def hiding(area: Float[np.ndarray, "*spot"]) -> Float[np.ndarray, "*spot"]:
    """−log of what a spot leaves open of its pixel."""
    return -np.log1p(-np.minimum(area, FULL))


def best_size(leaves: Leaves, page: Page, seen: SeenFoliage, *, height: float, most: int) -> float:
    """How many times as large the leaves should be, if there may be `most` in the end. `height`: the tree's, metres."""
    if len(leaves) == 0:
        return 1.0
    own, tried, spots = float(np.median(leaves.size)), {}, {}

    def overlap(k: int) -> float:
        if k not in tried:
            count = spot_count(leaves.model, STEP**k * own / seen.similarity.scale)
            if count not in spots:
                spots[count] = LeafSpots.of(leaves, seen, count)
            tried[k] = _filled_overlap(page, spots[count], STEP**k, most, seen_area(leaves.model, STEP**k * own / seen.similarity.scale))
        return tried[k]

    longest, shortest = longest_of(leaves.model, height), SHORTEST * seen.similarity.scale
    first = low = int(np.ceil(np.log(shortest / own) / np.log(STEP)))
    high = max(int(np.floor(np.log(longest / own) / np.log(STEP))), low)
    while low < high:  # the overlap rises to its best size, and falls from there
        middle = (low + high) // 2
        low, high = (middle + 1, high) if overlap(middle + 1) > overlap(middle) else (low, middle)
    best = overlap(low)
    while low > first and overlap(low - 1) > best - _HARDLY:
        low -= 1
    return STEP**low


def _filled_overlap(page: Page, spots: LeafSpots, size: float, most: int, of_leaf: float) -> float:
    """The overlap of leaves so many times as large with the foliage, when as many more as may be have been put where it is open. `of_leaf`: pixels² that each covers."""
    pixel = page.pixels(*spots.at(size))
    kept = page.mask[pixel].mean(axis=1) >= INSIDE
    inside, outside = page.covered(page.depth(pixel[kept], np.float32(size**2) * spots.area[kept]))
    gain = min(_FILLED * (page.room - inside), _AIMED * max(most - int(kept.sum()), 0) * of_leaf)
    return (inside + gain) / max(page.room + outside * (1.0 + gain / max(inside, 1.0)), 1.0)


def worthwhile(leaves: Leaves, page: Page, seen: SeenFoliage) -> Leaves:
    """The leaves that lie in the foliage for the most part, without those that cover more beside it than in it."""
    if len(leaves) == 0:
        return leaves
    spots = LeafSpots.of(leaves, seen, spot_count(leaves.model, float(np.median(leaves.size)) / seen.similarity.scale))
    pixel = page.pixels(*spots.at(1.0))
    kept = np.flatnonzero(page.mask[pixel].mean(axis=1) >= INSIDE)
    pixel, area = pixel[kept], spots.area[kept]
    depth = page.depth(pixel, area)
    partly = np.flatnonzero(~page.mask[pixel].all(axis=1))
    stays = np.ones(len(kept), bool)
    for some in (partly[::2], partly[1::2]):  # so that of two leaves that cover the same not both go
        gone = some[_own_gain(page, depth, pixel[some], area[some]) < 0]
        stays[gone] = False
        depth = np.maximum(depth - page.depth(pixel[gone], area[gone]), 0.0)
    return select(leaves, kept[stays])


def _own_gain(page: Page, depth, pixel, area) -> Float[np.ndarray, " leaf"]:
    """What would be open without each leaf: of the foliage, less what is beside it."""
    alone = (page.open(depth)[pixel] * np.exp(hiding(area))) * np.minimum(area, FULL)
    return np.where(page.mask[pixel], alone, -alone).sum(axis=1)


def _wood_spots(wood: Twigs, seen: SeenFoliage):
    """(places on the page that stand for parts of the wood, the area of each), about a pixel large."""
    start, end = seen.pixels(wood.start), seen.pixels(wood.end)
    along = end - start
    length, wide = np.linalg.norm(along, axis=1), (wood.start_radius + wood.end_radius) / seen.similarity.scale
    rows, columns = (np.maximum(np.ceil(size), 1).astype(np.int64) for size in (length, wide))
    piece = np.repeat(np.arange(len(wood)), rows * columns)
    number = np.arange(len(piece)) - np.repeat(np.cumsum(rows * columns) - rows * columns, rows * columns)
    down, aside = (number // columns[piece] + 0.5) / rows[piece], (number % columns[piece] + 0.5) / columns[piece] - 0.5
    across = np.stack([-along[:, 1], along[:, 0]], axis=1) * (wide / np.maximum(length, 1e-9))[:, None]
    return start[piece] + down[:, None] * along[piece] + aside[:, None] * across[piece], (length * wide / (rows * columns))[piece]
