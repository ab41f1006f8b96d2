"""Does the tree stand in blossom? Then what looks like its leaves is white or pink.

Asked of the brighter half of the pixels that show a leaf, since what is in the shade has the sky's colour: they are LIT at least, their saturation (max − min) / max is at most PALE, and
their excess of green (2G − R − B) / (R + G + B) at most GREENISH, medians all. A wild cherry in blossom has 155, .12, .02; ten other colour pictures up to 160, .27 at least and .02 to .46,
the nearest of them an apple against the sky with 95, .27 and .08. A grey photo says nothing.
"""

import numpy as np
from jaxtyping import Bool

from sketchtree.photo.photo import Photo

LIT = 120  # of 255, lightness
PALE = 0.3  # pink blossoms: .15-.3
GREENISH = 0.05
_FEW = 200  # pixels that say something
_LIGHTNESS = np.array([0.2126, 0.7152, 0.0722])


def is_in_blossom(photo: Photo, leafy: Bool[np.ndarray, "row column"]) -> bool:
    """Whether it is flowers that the photo shows at `leafy`."""
    if photo.is_grey or leafy.sum() < _FEW:
        return False
    colour = photo.rgb[leafy].astype(np.float32)
    light = colour @ _LIGHTNESS
    colour = colour[light >= np.median(light)]
    most, sum_ = np.maximum(colour.max(axis=1), 1.0), np.maximum(colour.sum(axis=1), 1.0)
    saturation = 1.0 - colour.min(axis=1) / most
    green = (3.0 * colour[:, 1] - sum_) / sum_
    return bool(np.median(colour @ _LIGHTNESS) >= LIT and np.median(saturation) <= PALE and np.median(green) <= GREENISH)
