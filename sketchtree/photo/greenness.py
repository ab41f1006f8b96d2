"""How green or red is a colour? The score by which leaves are told from what is between them (Tan et al. 2008, §2).

"Then we take the four most green or red Gaussian components as leaf clusters." The paper gives no measure; ours is the greater excess of green or of red, in parts of the
lightness, so that leaves in the shade count as those in the sun do (excess green after Woebbecke et al. 1995):

    score = max(2G − R − B, 2R − G − B) / (R + G + B)        −½ (blue or violet) … 0 (grey) … 2 (pure)

Cyan counts as blue: where blue is the greatest channel the excess of green is none. Of equal scores (a grey photo has no other) the darker colour is first: leaves are darker
than the sky.
"""

import numpy as np
from jaxtyping import Float, Int

LEAF_COMPONENTS = 4  # of ten
_LIFT = 3.0  # added to R + G + B: the hue of black is noise


def greenness(colour: Float[np.ndarray, "*colour 3"]) -> Float[np.ndarray, "*colour"]:
    """The score of colours (0-255)."""
    red, green, blue = np.moveaxis(np.asarray(colour, np.float64), -1, 0)
    excess = np.where(blue >= np.maximum(red, green), np.minimum(2 * green - red - blue, 0), 2 * green - red - blue)
    return np.maximum(excess, 2 * red - green - blue) / (red + green + blue + _LIFT)


def greenest(colour: Float[np.ndarray, "colour 3"], count: int = LEAF_COMPONENTS) -> Int[np.ndarray, " leaf"]:
    """The rows of the `count` most green or red colours, best first."""
    return np.lexsort((np.asarray(colour).sum(axis=1), -np.round(greenness(colour), 6)))[:count]
