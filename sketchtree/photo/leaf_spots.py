"""Where on the page does a leaf lie? A few spots on every blade, each of which stands for an equal part of what is drawn of it.

The spots of a leaf model are the middles of as many equal parts of its drawing (Lloyd's algorithm). A small leaf has few of them and a large one more, so that a spot is about a pixel
large. A tuft has spots on each of its crossed planes. A plane that looks away from the page has as much less area there:

    a = A l² |n_z| / count        A: area drawn, squares of the length    l: length, pixels    n_z: of the plane's normal, towards the page
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from jaxtyping import Float

from sketchtree.foliage.card_shape import foot_of
from sketchtree.foliage.leaves import Leaves
from sketchtree.foliage.models import leaf_model, leaf_painting
from sketchtree.foliage.triangles import drawn_area
from sketchtree.photo.photo_leaves import SeenFoliage

COUNTS = np.array([4, 6, 9, 13, 18])  # spots of a plane
MOST_CROSSED = 9  # of each of several planes
FACING = {True: 0.45, False: 0.64}  # |n_z| of blades that look to the light, and of planes that are turned all ways (2 / π), on the mean
_SAMPLES, _ROUNDS = 1500, 12  # of a drawing
_GOLDEN = 0.6180339887


@dataclass(frozen=True, eq=False)
class LeafSpots:
    """The spots of every leaf, pixels, y down."""

    foot: Float[np.ndarray, "leaf 2"]  # of the leaf
    right: Float[np.ndarray, "leaf spot"]  # of its foot
    down: Float[np.ndarray, "leaf spot"]
    area: Float[np.ndarray, "leaf spot"]  # pixels²

    @classmethod
    def of(cls, leaves: Leaves, seen: SeenFoliage, count: int) -> "LeafSpots":
        """So many spots a plane."""
        length = (leaves.size / seen.similarity.scale).astype(np.float32)[:, None]
        direction, normal = leaves.direction.astype(np.float32), leaves.normal.astype(np.float32)
        across, (aside, along), planes = np.cross(direction, normal), spots_of(leaves.model, count).T, planes_of(leaves.model)
        share = length**2 * np.float32(drawn_area(leaf_painting(leaves.model)) / count)
        right, down, area = [], [], []
        for plane in range(planes):
            cosine, sine = np.float32(np.cos(np.pi * plane / planes)), np.float32(np.sin(np.pi * plane / planes))
            side = cosine * across + sine * normal
            right.append((length * side[:, :1]) * aside + (length * direction[:, :1]) * along)
            down.append((-length * side[:, 1:2]) * aside - (length * direction[:, 1:2]) * along)
            area.append(np.repeat(share * np.abs(cosine * normal[:, 2:] - sine * across[:, 2:]), count, axis=1))
        return cls(seen.pixels(leaves.position).astype(np.float32), *(part[0] if planes == 1 else np.concatenate(part, axis=1) for part in (right, down, area)))

    def at(self, size: float) -> tuple[Float[np.ndarray, "leaf spot"], Float[np.ndarray, "leaf spot"]]:
        """(column, row) of each, when leaves are so many times as large."""
        return self.foot[:, :1] + np.float32(size) * self.right, self.foot[:, 1:] + np.float32(size) * self.down


def seen_area(model: str, length: float) -> float:
    """What a leaf of a length in pixels covers of the page, on the mean; pixels²."""
    return drawn_area(leaf_painting(model)) * length**2 * planes_of(model) * FACING[leaf_model(model).is_blade]


def spot_count(model: str, length: float) -> int:
    """How many spots a plane of a leaf needs, of a length in pixels."""
    planes = planes_of(model)
    enough = COUNTS[COUNTS >= seen_area(model, length) / planes]
    return min(int(enough[0] if len(enough) else COUNTS[-1]), int(COUNTS[-1]) if planes == 1 else MOST_CROSSED)


def planes_of(model: str) -> int:
    """1 of a blade."""
    return max(leaf_model(model).planes, 1)


@lru_cache(maxsize=None)
def spots_of(model: str, count: int) -> Float[np.ndarray, "spot 2"]:
    """Middles of equal parts of a leaf's drawing: across and along, leaf lengths from its foot."""
    painting = leaf_painting(model)
    row, column = np.nonzero(painting.coverage > 0.5)
    rows, columns = painting.coverage.shape
    x = painting.left + (column + 0.5) / columns * (painting.right - painting.left)
    y = painting.top + (row + 0.5) / rows * (painting.bottom - painting.top) - foot_of(painting)
    sample = np.column_stack([x, y])[(np.arange(_SAMPLES) * _GOLDEN % 1.0 * len(x)).astype(np.int64)]
    middle = sample[(np.arange(count) * _GOLDEN % 1.0 * _SAMPLES).astype(np.int64)]
    for _ in range(_ROUNDS):
        nearest = ((sample[:, None] - middle) ** 2).sum(axis=2).argmin(axis=1)
        held = np.bincount(nearest, minlength=count)
        sums = np.column_stack([np.bincount(nearest, sample[:, axis], minlength=count) for axis in (0, 1)])
        middle = np.where(held[:, None] > 0, sums / np.maximum(held, 1)[:, None], middle)
    return middle.astype(np.float32)
