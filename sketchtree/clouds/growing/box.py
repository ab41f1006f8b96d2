"""How large is a plant that thresholds in metres may be used on?

Guo et al. 2018, §6.1: every cloud is scaled into a box of 10 m × 10 m × 10 m. ε_D = 3 cm, and the internodes of Table 2 (0.038-0.052 m from a laurel of 0.97 m to a maple of
5.21 m), are meant there.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.errors import SketchError
from sketchtree.similarity import Similarity

SIDE = 10.0
"""Metres."""


def boxed(xyz: Float[np.ndarray, "point 3"]) -> Similarity:
    """From a box whose longest side is 10 m, the plant's lowest point on its floor, back to the cloud: `to_sketch` leads into the box, `to_world` out of it."""
    low, high = xyz.min(axis=0), xyz.max(axis=0)
    longest = float((high - low).max())
    if longest <= 0.0:
        raise SketchError("All points of the cloud lie at one place.", remedy="Give a cloud of a whole plant.")
    middle = (low + high) / 2
    return Similarity(longest / SIDE, (float(middle[0]), float(low[1]), float(middle[2])))
