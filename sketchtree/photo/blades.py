"""Are the leaves long and narrow? Asked of the picture, where it is sharp enough to show single blades.

A blade is a patch brighter than what is round it, within the foliage: pixels more than BRIGHTER standard deviations above the smoothed picture, in one piece, convex, neither a dot nor a
bough. How long it is for its width is told by its second moments; the mean over all patches, by area, is `elongation`. Leaves of no direction and mere grain come out at 1.8-2.25 (apples,
cherry, oak, painted trees, smoothed noise), a peach, a nectarine and pinnate leaflets at 2.65-3.3. All that at crowns some TALL pixels high: a larger photo is looked at from farther away.
A grey picture is not asked: in half-tones twigs and strips of sky are as bright.
"""

import numpy as np
from jaxtyping import Bool
from scipy import ndimage

from sketchtree.photo.photo import Photo

TALL = 480  # pixels
NARROW = 2.45  # elongation from which blades are lanceolate: half way between both kinds
_BRIGHTER = 1.0  # standard deviations
_FINE, _ROUND = 0.5, 4.0  # pixels: what is grain, and what is round a blade
_LEAST, _MOST = 12, 400  # pixels of a patch
_SOLID = 0.8  # of the ellipse with its moments: less is several that cross
_FEW = 40  # patches that say something


def blades_are_narrow(photo: Photo, leafy: Bool[np.ndarray, "row column"]) -> bool:
    """Whether the photo shows leaves like a willow's or a peach's."""
    found = None if photo.is_grey else elongation(photo, leafy)
    return found is not None and found >= NARROW


def elongation(photo: Photo, leafy: Bool[np.ndarray, "row column"]) -> float | None:
    """Length / width of the bright patches in the foliage; None where too few are seen."""
    light, inner = _farther(photo, leafy)
    inner = ndimage.binary_erosion(inner, iterations=2)
    if not inner.any():
        return None
    above = ndimage.gaussian_filter(light, _FINE) - ndimage.gaussian_filter(light, _ROUND)
    patch, count = ndimage.label(inner & (above > _BRIGHTER * above[inner].std()))
    row, column = np.nonzero(patch)
    number = patch[row, column]
    area = np.bincount(number, minlength=count + 1)[1:].astype(float)

    def mean(value):
        return np.bincount(number, weights=value, minlength=count + 1)[1:] / np.maximum(area, 1.0)

    x, y = mean(column), mean(row)
    across, down, mixed = mean(column**2.0) - x**2 + 1 / 12, mean(row**2.0) - y**2 + 1 / 12, mean(column * row.astype(float)) - x * y
    middle, apart = (across + down) / 2, np.hypot((across - down) / 2, mixed)
    long, short = middle + apart, np.maximum(middle - apart, 1 / 12)
    blade = (area >= _LEAST) & (area <= _MOST) & (area >= _SOLID * 4 * np.pi * np.sqrt(long * short))
    return float(np.average(np.sqrt(long / short)[blade], weights=area[blade])) if blade.sum() >= _FEW else None


def _farther(photo: Photo, leafy: Bool[np.ndarray, "row column"]):
    """(lightness, foliage) of the photo, in squares of as many pixels as make its foliage about TALL of them high."""
    light = photo.rgb.astype(np.float32) @ np.array([0.299, 0.587, 0.114], np.float32)
    tall = np.flatnonzero(leafy.any(axis=1))
    times = max(int(np.ptp(tall)) // TALL, 1) if len(tall) else 1
    rows, columns = photo.height // times, photo.width // times
    light, leafy = (whole[: rows * times, : columns * times].reshape(rows, times, columns, times).mean(axis=(1, 3)) for whole in (light, leafy))
    return light, leafy > 0.5
