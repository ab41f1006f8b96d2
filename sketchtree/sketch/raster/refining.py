"""Where exactly does a line run? Its middle by the ink's darkness, to a small part of a pixel.

Across every point of a thin line the darkness d is sampled along the normal, a half width and a pixel to either side:

    shift = Σ t d(t) / Σ d(t)        t offset along the normal

Thinning's own middle lines step from pixel to pixel, which a nearly level line shows as long waves. Wide lines, whose
outline's two sides are far apart, keep the middle they have.
"""

import numpy as np
from jaxtyping import Float
from scipy.ndimage import gaussian_filter1d, map_coordinates

from sketchtree.sketch.raster.ink import Ink

WIDEST = 16.0  # pixels: wider lines are left as they are
STEP = 0.5  # pixels between samples along the normal
MARGIN = 1.5  # pixels sampled beyond the edge of the line
SHIFT = 1.2  # pixels by which a point is moved at most
ENDS = 1.0  # widths: nearer to its ends and joints a line is left as it is
STILL = 0.8  # pixels: smoothing of the line whose normals are taken


def centred(points: Float[np.ndarray, "point 2"], width: float, closed: bool, ink: Ink) -> Float[np.ndarray, "point 2"]:
    """A line's points, about a pixel apart, moved on to the middle of its ink. `width`: the line's, pixels."""
    if width > WIDEST or len(points) < 5:
        return points
    smooth = gaussian_filter1d(points, STILL, axis=0, mode="nearest")
    along = np.gradient(smooth, axis=0)
    along /= np.maximum(np.hypot(*along.T), 1e-9)[:, None]
    normal = np.stack([-along[:, 1], along[:, 0]], 1)
    reach = 0.5 * width + MARGIN
    t = np.arange(-np.ceil(reach / STEP), np.ceil(reach / STEP) + 1) * STEP
    at = points[:, None] + t[:, None] * normal[:, None]
    d = map_coordinates(ink.d, [at[..., 1] - 0.5, at[..., 0] - 0.5], order=1, mode="constant")
    d = np.where(d >= 0.25 * ink.contrast, d, 0.0) * _own(d, 0.25 * ink.contrast)
    total = np.maximum(d.sum(1), 1e-6)
    shift = np.clip((d * t).sum(1) / total, -SHIFT, SHIFT)
    shift[total < ink.contrast] = 0.0
    if not closed:
        s = np.arange(len(shift), dtype=float)
        shift *= np.clip(np.minimum(s, s[::-1]) / max(ENDS * width, 1.0) - 0.5, 0.0, 1.0)
    return points + shift[:, None] * normal


def _own(d: Float[np.ndarray, "point sample"], least: float) -> np.ndarray:
    """Mask of the samples that belong to the ink around the middle one, not to a line beside it."""
    ink = d >= least
    half = d.shape[1] // 2
    up = np.cumprod(ink[:, half:], axis=1)
    down = np.cumprod(ink[:, half::-1], axis=1)[:, ::-1]
    return np.concatenate([down[:, :-1], up], axis=1)
