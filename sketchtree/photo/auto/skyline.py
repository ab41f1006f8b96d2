"""What stands before the sky? Everything whose colour is not that of the photo's upper border, nor smooth as a sky is.

    stands(x) = −log G(I_x, sky) above what all but BORDER of the border's pixels have,   or the lightness varies by more than ROUGH within a few pixels
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key, UInt8
from scipy import ndimage

from sketchtree.photo.appearance import fit_mixture
from sketchtree.photo.pixels import Pixels

BORDER = 0.04
ROUGH = 14.0  # standard deviation of the lightness, of 255
_UPPER = 0.45  # the sides count as border down to this part of the height
_DEEP = 0.03  # depth of the border, of the photo's size
_FRAME = 0.025  # a scan's dark frame: left out
_SIDE = 0.1  # of the width: where the ground is looked for, at either side
_FULL = 0.8  # share of a row there that stands before the sky, where the ground is
_HIGHEST = 0.55  # of the height: what begins above is a neighbour, no ground
_LIKELY = 0.85  # where the ground is if neither side tells


class Skyline(NamedTuple):
    """The photo parted into sky and what stands before it."""

    stands: Bool[np.ndarray, "row column"]
    ground: Int[np.ndarray, " column"]  # row below which the ground is
    sky: float  # share of the upper border that looks like one sky: smooth


def find_skyline(rgb: UInt8[np.ndarray, "row column 3"], *, key: Key[Array, ""]) -> Skyline:
    """Sky and the rest."""
    height, width = rgb.shape[:2]
    border = _border(height, width)
    rough = roughness(rgb) > ROUGH
    smooth = border & ~rough
    sample = smooth if smooth.sum() > 0.2 * border.sum() else border
    pixels = Pixels.of(rgb, np.ones((height, width), bool))
    sky = fit_mixture(rgb[sample], 4, key=key)
    likely = sky.log_density(pixels.colour)[pixels.which].reshape(height, width)
    stands = (likely < np.quantile(likely[sample], BORDER) - 1.0) | rough
    stands = ndimage.binary_opening(stands, iterations=1) | (ndimage.uniform_filter(stands.astype(np.float32), 5) > 0.5)
    frame = max(2, int(_FRAME * max(height, width)))
    for edge in (np.s_[:frame], np.s_[:, :frame], np.s_[:, -frame:]):
        stands[edge] = False
    return Skyline(stands, _ground(stands, frame), float(smooth.sum() / border.sum()))


def _ground(stands: Bool[np.ndarray, "row column"], frame: int) -> Int[np.ndarray, " column"]:
    """For every column the row where the ground begins: along a line from its height at the left border to that at the right."""
    height, width = stands.shape
    side, heights = max(2, int(_SIDE * width)), []
    for strip in (stands[:, frame : frame + side], stands[:, width - frame - side : width - frame]):
        full = ndimage.uniform_filter1d(strip.mean(axis=1), 5) > _FULL
        row = height
        while row > 0 and (full[row - 1] or row > height - frame):
            row -= 1
        heights.append(row)
    believed = [row for row in heights if row > _HIGHEST * height] or [int(_LIKELY * height)]
    left, right = (row if row > _HIGHEST * height else int(np.mean(believed)) for row in heights)
    return np.rint(np.interp(np.arange(width), [frame, width - frame], [left, right])).astype(np.int64)


def roughness(rgb: UInt8[np.ndarray, "row column 3"]) -> Float[np.ndarray, "row column"]:
    """How much the lightness varies near by."""
    light = rgb.astype(np.float32) @ np.array([0.299, 0.587, 0.114], np.float32)
    mean = ndimage.gaussian_filter(light, 1.5)
    return np.sqrt(np.maximum(ndimage.gaussian_filter(light * light, 1.5) - mean * mean, 0.0))


def _border(height: int, width: int) -> Bool[np.ndarray, "row column"]:
    frame, deep = int(_FRAME * max(height, width)), max(2, int(_DEEP * max(height, width)))
    border = np.zeros((height, width), bool)
    upper = int(_UPPER * height)
    border[frame : frame + deep, frame : width - frame] = True
    border[frame:upper, frame : frame + deep] = True
    border[frame:upper, width - frame - deep : width - frame] = True
    return border
