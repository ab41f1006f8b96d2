"""Does what was marked stand out from what was marked as behind it? Where it doesn't, there may be no tree, or the lines lie beside it.

A mixture of colours is fitted to either side's pixels; of a pixel on the tree and one beside it, how often are the two told apart by the odds of their colours? Half the time by chance (Mann and Whitney's U, over all pairs).
And of the matte itself: how far apart, in standard deviations (Mahalanobis), are the colours of what is opaque and of what is clear right beside it?
"""

import numpy as np
from jaxtyping import Array, Bool, Float, Key
from scipy import ndimage

from sketchtree.keys import numpy_generator, stage_key
from sketchtree.matting.colours import fit_colours
from sketchtree.photo.photo import Photo

LEAST = 0.75  # of pairs: trees before foliage as dark as they are have 0.83 and more, lines on a mere sky or meadow 0.7 at most
SURE, LITTLE = 0.95, 3.0  # of pairs, where the matte is hardly more than the lines: so many times their pixels
LEAST_APART = 1.0  # standard deviations: trees have 1.8 and more, a matte of a mere sky 0.6
BESIDE = 4  # pixels
_SAMPLE = 5000  # pixels of either side
_COMPONENTS = 3, 5
_ENOUGH = 400_000  # pixels that are looked at
_NOISE = 0.004  # of 1: a level of 255

TOLD = "The foreground and background lines mark the same colours: no tree stands out there. Draw some along the tree and others beside it, or give its matte (--use-matte)."


def stands_out(photo: Photo, fore: Bool[np.ndarray, "row column"], back: Bool[np.ndarray, "row column"], alpha: Float[np.ndarray, "row column"], key: Key[Array, ""]) -> bool:
    """Whether a tree does."""
    step = int(np.ceil(np.sqrt(alpha.size / _ENOUGH)))
    told, found = told_apart(photo.rgb / 255.0, fore, back, key), (alpha >= 0.5).sum() > LITTLE * fore.sum()
    return told >= (LEAST if found else SURE) and apart(photo.rgb[::step, ::step] / 255.0, alpha[::step, ::step]) >= LEAST_APART


def apart(rgb: Float[np.ndarray, "row column 3"], alpha: Float[np.ndarray, "row column"]) -> float:
    """Standard deviations between the colours of a matte's opaque part and of what is clear beside it; without end where all is opaque or clear."""
    opaque = alpha >= 0.5
    beside = ndimage.binary_dilation(opaque, iterations=BESIDE) & ~ndimage.binary_dilation(opaque) & (alpha < 0.2)
    if not (opaque.any() and beside.any()):
        return float("inf")
    one, other = rgb[opaque & (alpha > 0.8)] if (alpha > 0.8).any() else rgb[opaque], rgb[beside]
    off = one.mean(axis=0) - other.mean(axis=0)
    spread = sum((part - part.mean(axis=0)).T @ (part - part.mean(axis=0)) / len(part) for part in (one, other)) / 2.0
    return float(np.sqrt(off @ np.linalg.solve(spread + np.eye(3) * _NOISE**2, off)))


def told_apart(rgb: Float[np.ndarray, "row column 3"], fore: Bool[np.ndarray, "row column"], back: Bool[np.ndarray, "row column"], key: Key[Array, ""]) -> float:
    """The share of pairs, one pixel of either side, whose colours say which is which."""
    draw = numpy_generator(stage_key(key, "standing out"))
    sides = [rgb[mask][draw.permutation(int(mask.sum()))[:_SAMPLE]] for mask in (fore, back)]
    tree, behind = (fit_colours(colour, np.ones(len(colour)), most, draw) for colour, most in zip(sides, _COMPONENTS, strict=True))
    on, beside = (tree.log_density(colour) - behind.log_density(colour) for colour in sides)
    lower, up_to = (np.searchsorted(np.sort(beside), on, side=side) for side in ("left", "right"))
    return float(np.mean(lower + up_to) / (2 * len(beside)))
