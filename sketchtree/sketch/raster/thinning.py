"""Where are the middles of the lines, and how wide are they there?

The mask is thinned to lines one pixel wide (Zhang and Suen 1984, as scikit-image has it), and every pixel of them
knows its distance r to the nearest pixel without ink: a line w pixels wide has r = (w + 1) / 2 in its middle.
"""

import numpy as np
from jaxtyping import Bool, Float
from scipy.ndimage import distance_transform_edt
from skimage.morphology import skeletonize


def thinned(mask: Bool[np.ndarray, "row col"]) -> tuple[Bool[np.ndarray, "row col"], Float[np.ndarray, "row col"]]:
    """(skeleton, half the width of the ink at every pixel, pixels). Beyond the picture there is no ink."""
    padded = np.pad(mask, 1)
    half = distance_transform_edt(padded)[1:-1, 1:-1].astype(np.float32)
    half -= np.float32(0.5)
    return skeletonize(padded)[1:-1, 1:-1], np.maximum(half, 0.0, out=half)
