"""How large must leaves be, so that the tree covers what the photo shows as foliage, and no more?

Ours: §4 leaves size and density to the user. A blade is a few points spread evenly over its drawing. A leaf is kept where INSIDE of them are seen in the foliage (the paper asks for its
middle alone, and leaves blur the outline), a smaller one of SMALLER its length where that is not so. Of every size in SIZES, kept leaves' points are put on a grid of cells, c_i whether
cell i holds one, m_i ∈ [0, 1] how much of it is foliage, and the size with the greatest overlap is taken, or a smaller one that is hardly worse:

    Σ_i c_i m_i / Σ_i (c_i + m_i − c_i m_i)

No leaf becomes longer than LONGEST of the tree's height (a narrow one as much longer as gives it the area of a broad one, BROAD of its length squared), lest it look like a tree of
paper: what that leaves open is for more leaves to close.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from jaxtyping import Float

from sketchtree.foliage.card_shape import foot_of
from sketchtree.foliage.leaves import Leaves, select
from sketchtree.foliage.models import leaf_model, leaf_painting
from sketchtree.foliage.triangles import drawn_area
from sketchtree.photo.photo import at_pixels
from sketchtree.photo.photo_leaves import SeenFoliage

SIZES = tuple(float(size) for size in 1.2 ** np.arange(-3, 7))  # times the species', 0.58-2.99
INSIDE = 0.6  # of a blade
SMALLER = 0.6
LONGEST = 0.016
BROAD = 0.35
_CELLS = 5  # a leaf's length
_POINTS = 24  # a blade
_HARDLY = 0.004  # of overlap, that a fifth of length must bring


@dataclass(frozen=True, eq=False)
class Blades:
    """Points of every leaf as the photo sees them; pixels, y down."""

    foot: Float[np.ndarray, "leaf 2"]
    reach: Float[np.ndarray, "leaf point 2"]  # from the foot

    @classmethod
    def of(cls, leaves: Leaves, seen: SeenFoliage) -> "Blades":
        """Of all leaves."""
        flat, model = points_of(leaves.model), leaf_model(leaves.model)
        across = np.cross(leaves.direction, leaves.normal)
        turn = np.pi * (np.arange(len(flat)) % max(model.planes, 1)) / max(model.planes, 1)  # the planes of a tuft share its points
        side = np.cos(turn)[None, :, None] * across[:, None, :2] + np.sin(turn)[None, :, None] * leaves.normal[:, None, :2]
        reach = (flat[None, :, :1] * side + flat[None, :, 1:] * leaves.direction[:, None, :2]) * leaves.size[:, None, None]
        return cls(seen.pixels(leaves.position), (reach * [1.0, -1.0] / seen.similarity.scale).astype(np.float32))

    def at(self, size: float) -> Float[np.ndarray, "leaf point 2"]:
        """Where the points are when leaves are so many times as large."""
        return self.foot[:, None] + size * self.reach


def best_size(leaves: Leaves, seen: SeenFoliage, height: float = np.inf) -> tuple[float, float, float]:
    """(how many times as large the leaves should be, the overlap with the foliage then, how many times it would be if they might be as large as they like). `height`: the tree's, metres."""
    if len(leaves) == 0:
        return 1.0, 0.0, 1.0
    blades = Blades.of(leaves, seen)
    cell = max(float(np.median(leaves.size)) / seen.similarity.scale / _CELLS, 1.0)
    share, known = _shares(seen.mask, cell), {}

    def overlap(k: int) -> float:
        if k not in known:
            point = blades.at(SIZES[k])
            known[k] = _overlap(point[_inside(point, seen.mask) >= INSIDE], share, cell)
        return known[k]

    low, high = 0, len(SIZES) - 1  # the overlap rises to its best size, and falls from there
    while low < high:
        middle = (low + high) // 2
        low, high = (middle + 1, high) if overlap(middle + 1) > overlap(middle) + _HARDLY else (low, middle)
    longest = LONGEST * height / float(np.median(leaves.size)) * max(np.sqrt(BROAD / drawn_area(leaf_painting(leaves.model))), 1.0)
    allowed = max(int(np.searchsorted(SIZES, max(longest, 1.0), side="right")) - 1, 0)
    return SIZES[min(low, allowed)], overlap(min(low, allowed)), SIZES[low]


def mostly_inside(leaves: Leaves, seen: SeenFoliage) -> Leaves:
    """The leaves that are seen in the foliage for the most part, or are when they are smaller."""
    if len(leaves) == 0:
        return leaves
    blades = Blades.of(leaves, seen)
    fits, smaller = (_inside(blades.at(size), seen.mask) >= INSIDE for size in (1.0, SMALLER))
    return select(replace(leaves, size=np.where(fits, 1.0, SMALLER) * leaves.size), fits | smaller)


def _inside(point: Float[np.ndarray, "leaf point 2"], mask) -> Float[np.ndarray, " leaf"]:
    """How much of every blade is seen in the foliage, 0-1."""
    return at_pixels(mask, point.reshape(-1, 2)).reshape(point.shape[:2]).mean(axis=1)


@lru_cache(maxsize=None)
def points_of(name: str) -> Float[np.ndarray, "point 2"]:
    """Places spread over a leaf's drawing: across and along, leaf lengths from its foot."""
    painting = leaf_painting(name)
    row, column = np.nonzero(painting.coverage > 0.5)
    some = ((np.arange(_POINTS) * 0.6180339887 % 1.0) * len(row)).astype(np.int64)
    rows, columns = painting.coverage.shape
    x = painting.left + (column[some] + 0.5) / columns * (painting.right - painting.left)
    y = painting.top + (row[some] + 0.5) / rows * (painting.bottom - painting.top)
    return np.column_stack([x, y - foot_of(painting)])


def _shares(mask, cell: float) -> Float[np.ndarray, "row column"]:
    """How much of each cell is foliage."""
    rows, columns = (int(np.ceil(side / cell)) for side in mask.shape)
    row, column = np.nonzero(mask)
    count = np.bincount(((row + 0.5) / cell).astype(np.int64) * columns + ((column + 0.5) / cell).astype(np.int64), minlength=rows * columns)
    return np.minimum(count / cell**2, 1.0).reshape(rows, columns)


def _overlap(point, share, cell: float) -> float:
    """Intersection over union of the cells with a point, and the foliage. Cells off the picture are not foliage."""
    place = np.floor(point.reshape(-1, 2) / cell).astype(np.int64)
    held = np.zeros((share.shape[0] + 2, share.shape[1] + 2), bool)
    held[np.clip(place[:, 1] + 1, 0, share.shape[0] + 1), np.clip(place[:, 0] + 1, 0, share.shape[1] + 1)] = True
    both = float(share[held[1:-1, 1:-1]].sum())
    return both / (float(held.sum() + share.sum()) - both)
