"""How thick is a limb in the photo?"""

import numpy as np
from jaxtyping import Float
from scipy import ndimage

from sketchtree.photo.trace.wood_likeness import WoodLikeness

TAPER = 0.75  # radius of a branch / radius of its parent (§2)
_STEPS = 64


def largest_circle(likeness: WoodLikeness, place: Float[np.ndarray, " 2"], most: float) -> float:
    """Radius of the largest circle of nothing but wood about a place, pixels; its centre may lie a few pixels off the stroke (§2: "at the tree root"). At most `most`,
    at least half a pixel."""
    reach = int(np.ceil(2 * most))
    grid = np.arange(-reach, reach + 1)
    x, y = np.meshgrid(place[0] + grid, place[1] + grid)
    wood = likeness.is_wood(np.stack([x, y], axis=-1).reshape(-1, 2)).reshape(x.shape)
    room = ndimage.distance_transform_edt(np.pad(wood, 1))[1:-1, 1:-1]
    near = np.hypot(x - place[0], y - place[1]) <= most
    return float(np.clip(room[near].max() - 0.5, 0.5, most))


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
