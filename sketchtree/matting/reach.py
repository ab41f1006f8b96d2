"""How far does what a person marked as tree reach? As far as nothing in the picture stands against it.

A trunk before dark bushes has their colours, and no colour tells the two apart; but it was marked along its middle, and it ends where an edge does. So, ours: the geodesic distance of every pixel from the
foreground's and from the background's scribbles (after Bai & Sapiro 2007, whose colours' likelihood is left to `layered`),

    d(p) = min over ways from a scribble to p of ∫ (`STEP` + |∇I|) ds        held(p) = exp(−d_F(p) / `FAR`) · [d_F < d_B]

∇I of the picture, smoothed by a pixel, root mean square over its channels of 0 to 1. `held` is 1 under a foreground scribble, falls slowly along a limb of even colour, and at once beyond its edge. Beside a line
the two edges of its limb (`flanks`) say more: what lies between them is held, and what lies beyond one is not.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float
from scipy.ndimage import gaussian_gradient_magnitude, uniform_filter
from skimage.graph import MCP_Geometric

from sketchtree.matting.flanks import between, flanks

STEP = 0.01  # cost of a pixel where all is even
FAR = 0.25
UNLIKE = 0.05  # probability of wood, by colour, below which what lies between two edges shows through


def held(rgb: Float[np.ndarray, "row column 3"], fore: Bool[np.ndarray, "row column"], back: Bool[np.ndarray, "row column"]) -> Float[np.ndarray, "row column"]:
    """How surely a pixel belongs to the same limb as a foreground scribble."""
    edges = np.sqrt(np.mean([gaussian_gradient_magnitude(rgb[..., k], 1.0) ** 2 for k in range(3)], axis=0))
    to_fore, to_back = (MCP_Geometric(STEP + edges).find_costs(np.argwhere(mask))[0] for mask in (fore, back))
    return np.exp(-to_fore / FAR) * (to_fore < to_back)


def marked(
    rgb: Float[np.ndarray, "row column 3"], wood: Float[np.ndarray, "row column"], lines: Sequence[Float[np.ndarray, "point 2"]]
) -> tuple[Float[np.ndarray, "row column"], Float[np.ndarray, "row column"]]:
    """(how surely each pixel lies between the edges of a limb that a foreground line was drawn along; how surely it lies beside such a line and beyond them). `wood`: how likely each pixel is wood by its colour alone."""
    inside, beyond = np.zeros(wood.shape), np.zeros(wood.shape)
    for line in lines:
        found = flanks(rgb, wood, line)
        if found is not None:
            window, own, other = between(found, wood.shape)
            np.maximum(inside[window], own, out=inside[window])
            np.maximum(beyond[window], other, out=beyond[window])
    return inside * np.clip(uniform_filter(wood, 3) / UNLIKE, 0.0, 1.0), beyond
