"""Which stems come out of the ground? Ours: those that can be followed from the lowest points up to breast height.

    1. points from the ground to a bit above breast height (1.3 m, or an eighth of a small plant's height) are joined where they are close
    2. a *stem* is a piece that reaches from the lowest part of that slab to the highest; twigs that hang into it begin at its top and end in the air
    3. stems that meet below breast height have one foot; stems of one plant stand closer than a seventh of its height (1 m at the most), one after another

A piece with fewer points than a share of the largest is no stem. The end of a branch that hangs to the ground may be taken for one here; `prepared.several` finds where it belongs.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from sketchtree.clouds.voxels import voxel_rows

_BREAST, _PART = 1.3, 0.12  # metres, of the height: whichever is less
OVER = 1.25  # the slab ends so many breast heights up
_LOW, _HIGH = 0.35, 0.85  # a stem begins below, and reaches above, these parts of the slab
_LINK, _SPACINGS = 0.012, 4.0  # points are close within so much of the height, and within so many spacings
_SHARE = 0.03  # of the largest stem's points
_LAYERS = 10
_LOOKED_AT = 5000  # points whose spacing is measured
_BESIDE = 0.05  # of the height: what is nearer to a stem may be of its foot
_TOGETHER, _APART = 1 / 7, 1.0  # of the height, metres


@dataclass(frozen=True, eq=False)
class Stems:
    """Stems, the largest first; and which of them are of one plant."""

    rows: list[Int[np.ndarray, "_"]]  # points of each, up to a bit above breast height
    place: Float[np.ndarray, "stem 2"]  # (x, z) where each stands, metres
    thick: Float[np.ndarray, " stem"]  # how far its points typically lie from its middle, metres
    plant: Int[np.ndarray, " stem"]  # numbered from the one with most points
    weeds: Int[np.ndarray, " weed"]  # points of what grows beside the stems, and not up to breast height


def breast_height(height: float) -> float:
    """1.3 m, or an eighth of the height of a small plant."""
    return min(_BREAST, _PART * height)


def stems(xyz: Float[np.ndarray, "point 3"], above: Float[np.ndarray, " point"]) -> Stems:
    """The stems among points so high above the ground. There is always one: where nothing reaches breast height, the piece that has most points."""
    height = float(np.percentile(above, 99.9))
    top = OVER * breast_height(height)
    slab = np.flatnonzero(above <= max(top, float(np.partition(above, min(3, len(above) - 1))[min(3, len(above) - 1)])))
    piece = pieces(xyz[slab], _LINK * height, _SPACINGS)
    number = piece.max() + 1
    count = np.bincount(piece, minlength=number)
    low, high = np.full(number, np.inf), np.full(number, -np.inf)
    np.minimum.at(low, piece, above[slab])
    np.maximum.at(high, piece, above[slab])
    whole = (low <= _LOW * top) & (high >= _HIGH * top)
    if not whole.any():
        whole = np.arange(number) == count.argmax()
    whole &= count >= _SHARE * count[whole].max()
    chosen = np.flatnonzero(whole)
    chosen = chosen[np.argsort(-count[chosen], kind="stable")]
    rows = [slab[piece == name] for name in chosen]
    place = np.array([_foot(xyz[some], above[some], top) for some in rows])
    weeds = slab[((low <= _LOW * top) & (high < _HIGH * top) & ~whole)[piece]]
    beside = np.linalg.norm(xyz[weeds][:, None, [0, 2]] - place[None], axis=2).min(axis=1) > _BESIDE * height
    thick = np.array([_thick(xyz[some], above[some]) for some in rows])
    return Stems(rows, place, thick, _plants(place, count[chosen], min(_TOGETHER * height, _APART)), weeds[beside])


def pieces(xyz: Float[np.ndarray, "point 3"], link: float, spacings: float) -> Int[np.ndarray, " point"]:
    """The pieces that hang together over steps of `link` metres, or of so many spacings where that is more: 0, 1, ...; of many points in a small place one stands for the rest."""
    tree = cKDTree(xyz)
    some = xyz[:: max(1, len(xyz) // _LOOKED_AT)]
    link = max(link, spacings * float(np.median(tree.query(some, k=min(7, len(xyz)))[0].reshape(len(some), -1)[:, -1])), 1e-9)
    rows = voxel_rows(xyz, link / 4)
    few = cKDTree(xyz[rows])
    pairs = few.query_pairs(link, output_type="ndarray")
    piece = connected_components(csr_matrix((np.ones(len(pairs), np.int8), pairs.T), shape=(len(rows), len(rows))), directed=False)[1]
    return piece[few.query(xyz)[1]]


def _foot(xyz, above, top: float):
    """Where a stem stands: the middle of its lowest points."""
    lowest = above <= above.min() + 0.2 * top
    return np.median(xyz[lowest][:, [0, 2]], axis=0)


def _thick(xyz, above) -> float:
    """How far points typically lie from the middle of their layer."""
    layer = np.minimum((above - above.min()) / (np.ptp(above) + 1e-12) * _LAYERS, _LAYERS - 1).astype(int)
    far = [np.linalg.norm(some - np.median(some, axis=0), axis=1) for some in (xyz[layer == k][:, [0, 2]] for k in range(_LAYERS)) if len(some)]
    return float(np.median(np.concatenate(far)))


def _plants(place, count, together: float):
    """Stems of one plant, numbered from the plant with most points."""
    gap = np.linalg.norm(place[:, None] - place[None], axis=2)
    number, plant = connected_components(csr_matrix(gap <= together), directed=False)
    order = np.argsort(-np.bincount(plant, count, number), kind="stable")
    return np.argsort(order)[plant]
