"""Does the colour of points tell leaves from wood?

    g = (2G − R − B) / (R + G + B)        excess of green, of sRGB

Only where what bears much and what bears nothing differ in it: the stems of a herb are as green as its leaves, and a tree in autumn or in blossom is no greener than its bark.
"""

import numpy as np
from jaxtyping import Bool, Float

GREEN, APART = 0.06, 0.06  # what leaves have at least, and how far wood is from that


def excess(colour: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, " point"]:
    """g of every point, −1 to 2."""
    total = colour.sum(axis=1)
    return (3.0 * colour[:, 1] - total) / np.maximum(total, 1e-6)


def green_odds(
    colour: Float[np.ndarray, "point 3"] | None, bears: Bool[np.ndarray, " point"], ends: Bool[np.ndarray, " point"]
) -> Float[np.ndarray, " point"] | None:
    """−1 where a point has the colour of what bears much, 1 where it has that of what bears nothing; None where they don't tell one from the other."""
    if colour is None or not bears.any() or not ends.any():
        return None
    green = excess(colour)
    wood, leaf = float(np.median(green[bears])), float(np.median(green[ends]))
    if leaf < GREEN or leaf - wood < APART:
        return None
    return np.clip((green - (wood + leaf) / 2) / ((leaf - wood) / 2), -1.0, 1.0)
