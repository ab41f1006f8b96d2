"""How thick is a limb in the photo?"""

import numpy as np
from jaxtyping import Bool, Float
from scipy import ndimage

from sketchtree.photo.trace.wood_likeness import WoodLikeness

TAPER = 0.75  # radius of a branch / radius of its parent (§2)
BLUR = 1.0  # pixels by which a half width of wood is too great: colours of three pixels a side vote, smoothed over three
_STEPS = 64


def largest_circle(likeness: WoodLikeness, place: Float[np.ndarray, " 2"], most: float, enough: float = np.inf) -> float:
    """Radius of the largest circle of nothing but wood about a place, pixels; its centre may lie a few pixels off the stroke (§2: "at the tree root"). At most `most`,
    at least half a pixel. One of `enough` is told without looking for a larger one."""
    near = int(np.ceil(most))
    grid = np.arange(-near, near + 1)
    centres = np.hypot(grid[:, None], grid) <= most
    for reach in (near // 4, near):  # a circle that is smaller than the first is found without looking farther
        room = ndimage.distance_transform_edt(_around(likeness.mask, place, near + reach))[1 + reach : -1 - reach, 1 + reach : -1 - reach]
        largest = float(room[centres].max())
        if largest < reach or largest - 0.5 >= enough:
            break
    return float(np.clip(largest - 0.5, 0.5, most))


def _around(wood: Bool[np.ndarray, "row column"], place: Float[np.ndarray, " 2"], reach: int) -> Bool[np.ndarray, "side side"]:
    """The pixels within so many rows and columns of a place, and a rim of none; off the picture there is no wood."""
    column, row = (int(value) for value in np.floor(place))
    top, left = max(row - reach, 0), max(column - reach, 0)
    seen = wood[top : max(row + reach + 1, 0), left : max(column + reach + 1, 0)]
    found = np.zeros((2 * reach + 3, 2 * reach + 3), bool)
    first, start = top - row + reach + 1, left - column + reach + 1
    found[first : first + seen.shape[0], start : start + seen.shape[1]] = seen
    return found


def half_widths(likeness: WoodLikeness, place: Float[np.ndarray, "place 2"], along: Float[np.ndarray, "place 2"], most: float) -> Float[np.ndarray, " place"]:
    """Half the run of wood across a limb at places on it, pixels; NaN where a place is not on wood or the run goes on past `most` on a side."""
    off = np.linspace(-most, most, 2 * _STEPS + 1)
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    points = place[:, None] + off[None, :, None] * across[:, None]
    wood = likeness.is_wood(points.reshape(-1, 2)).reshape(len(place), len(off))
    left = np.argmin(np.pad(wood[:, _STEPS::-1], ((0, 0), (0, 1))), axis=1)
    right = np.argmin(np.pad(wood[:, _STEPS:], ((0, 0), (0, 1))), axis=1)
    known = (left > 0) & (right > 0) & (left <= _STEPS) & (right <= _STEPS)
    return np.where(known, 0.5 * (left + right - 1) * most / _STEPS, np.nan)
