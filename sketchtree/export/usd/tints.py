"""A few tints in place of many.

UsdPreviewSurface can't multiply a texture by a colour of the vertex, and readers take no connection into a texture's scale; a material a tint is what
all of them show. The tints t are cut at equal counts along their main axis (the first principal component of ln t); each piece's
tint is its mean.
"""

import numpy as np
from jaxtyping import Float, Int

MOST = 8


def few_tints(tint: Float[np.ndarray, "row 3"], most: int = MOST) -> tuple[Int[np.ndarray, " row"], Float[np.ndarray, "tint 3"]]:
    """(which tint each row has, the tints): at most `most`, exactly those given if they are no more."""
    given, which = np.unique(np.round(tint, 4), axis=0, return_inverse=True)
    which = which.reshape(-1)
    if len(given) <= most:
        return which, given
    log = np.log(np.maximum(tint, 1e-3))
    log = log - log.mean(axis=0)
    axis = np.linalg.eigh(log.T @ log)[1][:, -1]
    along = log @ (axis * np.sign(axis[np.argmax(np.abs(axis))]))
    piece = np.minimum(np.argsort(np.argsort(along, kind="stable"), kind="stable") * most // len(along), most - 1)
    count = np.bincount(piece, minlength=most)
    return piece, np.stack([np.bincount(piece, tint[:, c], minlength=most) / count for c in range(3)], axis=1)
