"""How large must leaves be, so that the tree covers what the photo shows as foliage, and no more?

Ours: §4 leaves size and density to the user. A blade is a few points spread evenly over its drawing. A leaf is kept where INSIDE of them are seen in the foliage (the paper asks for its
middle alone, and leaves blur the outline), a smaller one of SMALLER its length where that is not so. Of every size in SIZES, kept leaves' points are put on a grid of cells, each point for
its part of the leaf's area as it is seen. Leaves that lie at random cover the part c_i of a cell (a_i the area of those in it, over the cell's), m_i ∈ [0, 1] of it is foliage, and the
size with the greatest overlap is taken, or a smaller one that is hardly worse:

    c_i = 1 − exp(−a_i)        Σ_i c_i m_i / Σ_i (c_i + m_i − c_i m_i)

No leaf becomes longer than LONGEST of the tree's height (a narrow one as much longer as gives it the area of a broad one, BROAD of its length squared), lest it look like a tree of
paper: what that leaves open is for more leaves to close.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.foliage.card_shape import foot_of
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.models import leaf_model, leaf_painting
from sketchtree.foliage.triangles import drawn_area
from sketchtree.photo.photo_leaves import SeenFoliage

SIZES = tuple(float(size) for size in 1.2 ** np.arange(-3, 7))  # times the species', 0.58-2.99
INSIDE = 0.6  # of a blade
SMALLER = 0.6
LONGEST = 0.016
BROAD = 0.35
_CELLS = 5  # a leaf's length
_POINTS = 18  # a blade
_HARDLY = 0.003  # of overlap, that a fifth of length must bring


@dataclass(frozen=True, eq=False)
class Blades:
    """Points of every leaf as the photo sees them; pixels, y down."""

    foot: Float[np.ndarray, "leaf 2"]
    reach: Float[np.ndarray, "leaf point 2"]  # from the foot

    @classmethod
    def of(cls, leaves: Leaves, seen: SeenFoliage) -> "Blades":
        """Of all leaves."""
        direction, normal = leaves.direction.astype(np.float32), leaves.normal.astype(np.float32)
        flat, model = points_of(leaves.model), leaf_model(leaves.model)
        across = np.cross(direction, normal)
        turn = (np.pi * (np.arange(len(flat)) % max(model.planes, 1)) / max(model.planes, 1)).astype(np.float32)  # the planes of a tuft share its points
        side = np.cos(turn)[None, :, None] * across[:, None, :2] + np.sin(turn)[None, :, None] * normal[:, None, :2]
        reach = (flat[None, :, :1] * side + flat[None, :, 1:] * direction[:, None, :2]) * leaves.size[:, None, None].astype(np.float32)
        return cls(seen.pixels(leaves.position).astype(np.float32), reach * np.array([1.0, -1.0], np.float32) / np.float32(seen.similarity.scale))

    def at(self, size: float) -> Float[np.ndarray, "leaf point 2"]:
        """Where the points are when leaves are so many times as large."""
        return self.foot[:, None] + np.float32(size) * self.reach


@dataclass(frozen=True, eq=False)
class _Page:
    """The foliage, and the cells that its pixels belong to; a rim of one pixel stands for all that is off the picture."""

    mask: Bool[np.ndarray, "pixel"]
    cell: Int[np.ndarray, "pixel"]  # 0 off the picture
    share: Float[np.ndarray, "cell"]  # how much of each is foliage
    shape: tuple[int, int]
    room: float  # of a cell, pixels²

    @classmethod
    def of(cls, mask: Bool[np.ndarray, "row column"], side: float) -> "_Page":
        """Cells `side` pixels wide."""
        row, column = (((np.arange(count) + 0.5) / side).astype(np.int32) for count in mask.shape)
        cell = np.pad(1 + row[:, None] * (column[-1] + 1) + column[None, :], 1)
        mask = np.pad(mask, 1)
        count = np.bincount(cell[mask], minlength=int(cell.max()) + 1)
        return cls(mask.reshape(-1), cell.reshape(-1), np.minimum(count / side**2, 1.0), mask.shape, side**2)

    def pixels(self, point: Float[np.ndarray, "leaf point 2"]) -> Int[np.ndarray, "leaf point"]:
        """The pixel that each point lies in."""
        column = np.clip(point[..., 0] + 1, 0, self.shape[1] - 1).astype(np.int32)
        row = np.clip(point[..., 1] + 1, 0, self.shape[0] - 1).astype(np.int32)
        return row * self.shape[1] + column

    def overlap(self, pixel: Int[np.ndarray, "leaf point"], area: Float[np.ndarray, " leaf"]) -> float:
        """Intersection over union of the leaves kept and the foliage. `area` of each leaf as it is seen, pixels²."""
        kept = self.mask[pixel].mean(axis=1) >= INSIDE
        weight = np.repeat(area[kept] / pixel.shape[1], pixel.shape[1])
        held = -np.expm1(-np.bincount(self.cell[pixel[kept]].reshape(-1), weight, minlength=len(self.share)) / self.room)
        both = float((self.share * held).sum())
        return both / (float(held.sum() + self.share.sum()) - both)


def best_size(leaves: Leaves, seen: SeenFoliage, height: float = np.inf) -> tuple[float, float, float]:
    """(how many times as large the leaves should be, the overlap with the foliage then, how many times it would be if they might be as large as they like). `height`: the tree's, metres."""
    if len(leaves) == 0:
        return 1.0, 0.0, 1.0
    blades = Blades.of(leaves, seen)
    page, known = _Page.of(seen.mask, max(float(np.median(leaves.size)) / seen.similarity.scale / _CELLS, 1.0)), {}

    drawn = drawn_area(leaf_painting(leaves.model))
    area = drawn * (leaves.size / seen.similarity.scale) ** 2 * (np.abs(leaves.normal[:, 2]) if leaf_model(leaves.model).is_blade else 1.0)

    def overlap(k: int) -> float:
        if k not in known:
            known[k] = page.overlap(page.pixels(blades.at(SIZES[k])), SIZES[k] ** 2 * area)
        return known[k]

    low, high = 0, len(SIZES) - 1  # the overlap rises to its best size, and falls from there
    while low < high:
        middle = (low + high) // 2
        low, high = (middle + 1, high) if overlap(middle + 1) > overlap(middle) + _HARDLY else (low, middle)
    longest = LONGEST * height / float(np.median(leaves.size)) * max(np.sqrt(BROAD / drawn), 1.0)
    allowed = max(int(np.searchsorted(SIZES, max(longest, 1.0), side="right")) - 1, 0)
    return SIZES[min(low, allowed)], overlap(min(low, allowed)), SIZES[low]


def mostly_inside(leaves: Leaves, seen: SeenFoliage) -> Leaves:
    """The leaves that are seen in the foliage for the most part, or are when they are smaller."""
    if len(leaves) == 0:
        return leaves
    blades, page = Blades.of(leaves, seen), _Page.of(seen.mask, 1.0)
    fits, smaller = (page.mask[page.pixels(blades.at(size))].mean(axis=1) >= INSIDE for size in (1.0, SMALLER))
    return select(replace(leaves, size=np.where(fits, 1.0, SMALLER) * leaves.size), fits | smaller)


@lru_cache(maxsize=None)
def points_of(name: str) -> Float[np.ndarray, "point 2"]:
    """Places spread over a leaf's drawing: across and along, leaf lengths from its foot."""
    painting = leaf_painting(name)
    row, column = np.nonzero(painting.coverage > 0.5)
    some = ((np.arange(_POINTS) * 0.6180339887 % 1.0) * len(row)).astype(np.int64)
    rows, columns = painting.coverage.shape
    x = painting.left + (column[some] + 0.5) / columns * (painting.right - painting.left)
    y = painting.top + (row[some] + 0.5) / rows * (painting.bottom - painting.top)
    return np.column_stack([x, y - foot_of(painting)]).astype(np.float32)
