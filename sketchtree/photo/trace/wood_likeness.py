"""Is a pixel wood? Two mixtures of colours vote (§2, after Lazy Snapping).

    α_x = 0 (branch) where log G(I_x, θ^T) > log G(I_x, θ^N), else 1

θ^T is learnt from the pixels under the strokes along the limbs, θ^N from all others; five components each. A stroke may run over leaves: what of θ^T is too
close to a colour of the foliage is dropped, but never what the foot of the trunk is made of. Asked of each colour of the palette once.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key

from sketchtree.keys import numpy_generator, stage_key
from sketchtree.photo.appearance import Mixture, fit_mixture
from sketchtree.photo.foliage import Foliage
from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import at_pixels
from sketchtree.photo.trace.lines import evenly
from sketchtree.photo.trace.palette import Palette

COMPONENTS = 5
_CLOSE = 0.4  # Bhattacharyya distance below which a component of wood counts as one of the foliage
_FOOT = 0.25  # of the trunk's stroke, from its root: wood for certain
_SURE = 0.3  # share of the foot's pixels that a component must explain to be the trunk's own
_LOUDEST = 4.0  # a pixel's log ratio counts for no more than that
_VOTES = 800  # votes in one unit of the log ratio: nine of the loudest are a number of two bytes
_OTHERS = 2_000  # pixels that stand for all that is no wood, and for all that is under strokes


@dataclass(frozen=True, eq=False)
class WoodLikeness:
    """What tells wood from all else in one photo."""

    wood: Mixture  # θ^T
    other: Mixture  # θ^N
    votes: Int[np.ndarray, "row column"]  # log G(I, θ^T) − log G(I, θ^N) in 1/_VOTES, summed over nine pixels
    mask: Bool[np.ndarray, "row column"]  # α = 0: wood is the likelier

    def is_wood(self, points: Float[np.ndarray, "point 2"]) -> Bool[np.ndarray, " point"]:
        """What the mask says at points (pixels, y down); off the picture there is none."""
        return at_pixels(self.mask, points)


def learn_wood(palette: Palette, marked: Marked, foliage: Foliage | None, *, width: float, key: Key[Array, ""]) -> WoodLikeness:
    """The two mixtures from the strokes of one tree; `width` of a stroke, pixels. Needs a branch stroke at least."""
    under = [palette.colour[_under(palette.number, stroke, width)] for stroke in marked.branches]
    every = np.concatenate(under)
    wood = fit_mixture(every[:: max(len(every) // _OTHERS, 1)], COMPONENTS, key=stage_key(key, "wood"))
    if foliage is not None and not foliage.bare:  # the twigs of a bare tree are wood
        wood = apart_from_leaves(wood, foliage.leaf, under[0][: max(int(_FOOT * len(under[0])), 8)])
    other = fit_mixture(palette.colour[_others(palette.number, marked, width, key)], COMPONENTS, key=stage_key(key, "other"))
    ratio = (wood.log_density(palette.colour) - other.log_density(palette.colour)).astype(np.float32)
    votes = together(np.rint(_VOTES * np.clip(ratio, -_LOUDEST, _LOUDEST)).astype(np.int16)[palette.number])
    return WoodLikeness(wood, other, votes, votes > 0)


def together(votes: Int[np.ndarray, "row column"]) -> Int[np.ndarray, "row column"]:
    """The sum of the votes of every pixel and its eight neighbours; beyond the picture it goes on as at its border. In place of a filter: whole numbers of two bytes, a fifth of the time."""
    for axis in (0, 1):
        wide = np.pad(votes, [(1, 1) if k == axis else (0, 0) for k in (0, 1)], mode="edge")
        before, here, after = (wide[k : k + len(votes)] if axis == 0 else wide[:, k : k + votes.shape[1]] for k in (0, 1, 2))
        votes = before + here
        votes += after
    return votes


def apart_from_leaves(wood: Mixture, leaf: Mixture, foot: Float[np.ndarray, "pixel 3"]) -> Mixture:
    """θ^T without what is too close to some component of the foliage; what most pixels of the trunk's foot are of stays."""
    parts = wood.log_parts(foot)
    share = np.bincount(np.argmax(parts, axis=1), minlength=len(wood)) / len(foot)
    close = np.array([min(bhattacharyya(wood.mean[k], wood.covariance[k], m, c) for m, c in zip(leaf.mean, leaf.covariance, strict=True)) < _CLOSE for k in range(len(wood))])
    keep = ~close | (share >= _SURE)
    keep[np.argmax(share)] = True
    return wood.only(keep)


def bhattacharyya(mean_a, covariance_a, mean_b, covariance_b) -> float:
    """Distance of two Gaussians: ⅛ Δᵀ S⁻¹ Δ + ½ log(|S| / √(|A| |B|)), S their mean covariance; 0 where they are the same."""
    middle, off = 0.5 * (covariance_a + covariance_b), mean_a - mean_b
    volumes = [np.linalg.slogdet(m)[1] for m in (middle, covariance_a, covariance_b)]
    return float(0.125 * off @ np.linalg.solve(middle, off) + 0.5 * (volumes[0] - 0.5 * (volumes[1] + volumes[2])))


def _under(number, stroke, width: float) -> Int[np.ndarray, " pixel"]:
    """The colours under a stroke, from its start to its end."""
    spine, along = evenly(stroke, 1.0)
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    off = np.arange(-(width // 2), width // 2 + 1)
    points = spine[:, None] + off[None, :, None] * across[:, None]
    column, row = np.floor(points.reshape(-1, 2)).astype(np.int64).T
    inside = (row >= 0) & (row < number.shape[0]) & (column >= 0) & (column < number.shape[1])
    return number[row[inside], column[inside]]


def _others(number, marked: Marked, width: float, key) -> Int[np.ndarray, " pixel"]:
    """An even sample of the pixels that no stroke along a limb covers."""
    rows, columns = number.shape[:2]
    free, reach = np.ones((rows, columns), bool), max(int(width), 1)
    near = np.stack(np.mgrid[-reach : reach + 1, -reach : reach + 1], axis=-1).reshape(-1, 2)
    near = near[np.abs(near).sum(axis=1) <= reach]
    for stroke in marked.branches:
        spine, _ = evenly(stroke, 1.0)
        column, row = np.floor(spine).astype(np.int64).T
        inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        row, column = (np.stack([row, column], axis=1)[inside][:, None] + near).reshape(-1, 2).T
        inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        free[row[inside], column[inside]] = False
    drawn = numpy_generator(stage_key(key, "others")).integers(free.size, size=2 * _OTHERS)
    drawn = drawn[free.reshape(-1)[drawn]][:_OTHERS]
    where = drawn if len(drawn) else np.flatnonzero(free.reshape(-1))  # strokes over nearly all of a tiny picture
    return number.reshape(-1)[where]
