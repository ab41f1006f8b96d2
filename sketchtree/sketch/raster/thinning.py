"""Where are the middles of the lines, and how wide are they there?

The mask is thinned to lines one pixel wide (Lee, Kashyap and Chu 1994, as scikit-image has it: Zhang and Suen's faster
way eats lines of even width at 45° from their ends), and every pixel of them knows its distance r to the nearest pixel
without ink: a line w pixels wide has r = (w + 1) / 2 in its middle.
"""

import numpy as np
from jaxtyping import Bool, Float
from scipy.ndimage import distance_transform_edt
from skimage.morphology import skeletonize


def thinned(mask: Bool[np.ndarray, "row col"]) -> tuple[Bool[np.ndarray, "row col"], Float[np.ndarray, "row col"]]:
    """(skeleton, half the width of the ink at every pixel, pixels). Beyond the picture there is no ink."""
    return skeletonize(np.pad(mask, 1), method="lee")[1:-1, 1:-1].astype(bool), half_widths(mask)


def half_widths(mask: Bool[np.ndarray, "row col"]) -> Float[np.ndarray, "row col"]:
    """Half the width of the ink at every pixel: its distance to the paper less half a pixel, 0 on paper."""
    half = distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1].astype(np.float32)
    half -= np.float32(0.5)
    return np.maximum(half, 0.0, out=half)
