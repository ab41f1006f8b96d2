"""Which pixels are ink? A mask at the resolution at which the pen's line is about FINE pixels wide.

    ink = { d ≥ low, linked to some d ≥ high }  ∩  { d ≥ EDGE · the darkest d within a pen's width }
    high = max(6 σ, D / 2)     low = max(3.5 σ, D / 4)     D darkness of well drawn lines, σ grain of the paper

Two thresholds follow a pencil line where it pales; the third keeps a blurred line as wide as it was drawn. The width of
the pen is twice the ink's area over its border, 2A/P. A first look at COARSE megapixels measures it; lines too thin
there are looked at again, finer than the file where need be: between its pixels the tones carry the line's true place.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from PIL import Image
from scipy.ndimage import gaussian_filter, maximum_filter
from skimage.filters import apply_hysteresis_threshold

from sketchtree.sketch.raster.paper import Darkness

COARSE = 1.2  # megapixels of the first look at a large picture …
SMALL = 0.5  # … and of the look at a small one, enlarged
MOST = 6.0  # megapixels looked at, at most
FINE = 5.0  # pixels that a pen's line is wide at least, where the limits allow
ENLARGED = 4.0  # times the picture is enlarged at most, and to ROOMY megapixels
ROOMY = 2.5
HIGH, LOW = 6.0, 3.5  # thresholds, in σ …
HIGH_PART, LOW_PART = 0.5, 0.25  # … and of D
EDGE = 0.45  # of the darkest d nearby
BROADEST = 0.012  # of the drawing's larger side: what is wider than that on average are limbs, and no pen's lines
FAINTEST = 0.04  # of the paper's lightness: nothing paler is a line


@dataclass(frozen=True, eq=False)
class Ink:
    """The ink of a drawing. Pixel (row, col) covers [col, col + 1] × [row, row + 1], times `scale` file pixels."""

    mask: Bool[np.ndarray, "row col"]
    d: Float[np.ndarray, "row col"]  # darkness at the same resolution
    scale: float  # pixels of the working picture in one of these
    pen: float  # width of a pen's line, pixels of the mask
    contrast: float  # D
    grain: float  # σ at this resolution


def find_ink(dark: Darkness) -> Ink | None:
    """The ink at a resolution that suits the pen; None when nothing stands out of the paper."""
    pixels = dark.d.size / 1e6
    scale = max(1.0, float(np.sqrt(pixels / COARSE))) * float(np.clip(np.sqrt(pixels / SMALL), 1 / ENLARGED, 1.0))
    ink = _at(dark, scale)
    if ink is None:
        return None
    wanted = ink.scale * min(1.0, ink.pen / FINE)
    finest = max(float(np.sqrt(pixels / MOST)), min(1.0, float(np.sqrt(pixels / ROOMY))), 1.0 / ENLARGED)
    finer = max(wanted, finest)
    return _at(dark, finer) or ink if finer < 0.8 * ink.scale else ink


def pen_width(mask: Bool[np.ndarray, "row col"]) -> float:
    """2A/P of a mask, pixels: the width of its lines. The border of a slanting line is its steps times π/4."""
    steps = np.count_nonzero(mask[:, 1:] != mask[:, :-1]) + np.count_nonzero(mask[1:] != mask[:-1])
    return 2.0 * np.count_nonzero(mask) / max(steps * np.pi / 4, 1.0)


def _at(dark: Darkness, scale: float) -> Ink | None:
    d = _resized(dark.d, scale)
    still = dark.grain / max(1.0, scale)
    d = _stilled(d, still)
    contrast = _contrast(d, still)
    if contrast < FAINTEST:
        return None
    high, low = max(HIGH * still, HIGH_PART * contrast), max(LOW * still, LOW_PART * contrast)
    rough = d >= min(high, 0.8 * contrast)
    reach = int(np.clip(round(pen_width(rough)), 2, 24))
    strong = d >= np.float32(EDGE) * maximum_filter(d, size=2 * (reach // 2) + 3)
    mask = apply_hysteresis_threshold(np.where(strong, d, 0), min(low, high), high)
    if not mask.any():
        return None
    return Ink(mask, d, scale, min(pen_width(mask), BROADEST * extent(mask)), contrast, still)


def extent(mask: Bool[np.ndarray, "row col"]) -> float:
    """The larger side of what is drawn, pixels; 0 for an empty mask."""
    return float(max(np.ptp(np.flatnonzero(mask.any(axis))) + 1 for axis in (0, 1))) if mask.any() else 0.0


def _resized(d: Float[np.ndarray, "row col"], scale: float) -> Float[np.ndarray, "row col"]:
    """The picture with pixels `scale` times as large, its tones averaged (larger) or drawn between (smaller)."""
    if scale == 1.0:
        return d
    image = Image.fromarray(d)
    size = (max(1, round(d.shape[1] / scale)), max(1, round(d.shape[0] / scale)))
    how = Image.Resampling.BOX if scale > 1 else Image.Resampling.BICUBIC
    box = (0, 0, size[0] * scale, size[1] * scale)
    box = (0, 0, min(box[2], d.shape[1]), min(box[3], d.shape[0]))
    return np.asarray(image.resize(size, how, box=box))


def _stilled(d: Float[np.ndarray, "row col"], grain: float) -> Float[np.ndarray, "row col"]:
    """A little smoothing: more where the paper is grainy."""
    return gaussian_filter(d, 0.6 if grain < 0.01 else 1.0)


def _contrast(d: Float[np.ndarray, "row col"], grain: float) -> float:
    """D: darkness of well drawn lines: the median of what is more than half as dark as the darkest parts."""
    standing = d[d > max(HIGH * grain, 0.5 * FAINTEST)]
    if standing.size < 4:
        return 0.0
    darkest = np.quantile(standing, 0.98)
    return float(np.median(standing[standing >= 0.5 * darkest]))
