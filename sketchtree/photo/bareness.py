"""Does a tree stand bare? Twigs are lines with sky between them, leaves an area.

What was found of the crown spans an area: itself, closed over gaps up to GAP of the crown's size. At each place of that area the cover is the share of it that was found, within WINDOW of
the crown's size about it. The tree is bare where the median of the cover is under BARE. A median: neither the trunk nor a hedge behind a part of the tree counts for more than where it stands,
and a stroke drawn loosely round the crown changes nothing. A few limbs too far apart to span anything are bare as well: less than HALF of what the stroke surrounds, and less than half of that
is as broad as LIMB of the crown's size on every side.
"""

import numpy as np
from jaxtyping import Bool, Float
from scipy import ndimage

GAP = 0.06  # of the crown's size (√area): gaps between a bare tree's twigs
WINDOW = 0.04  # of it, a side: several twigs wide, and narrower than a bough with its leaves
BARE = 0.65  # six photos of bare trees have .24-.55 (any of three seeds), eleven of trees in leaf .76-1
HALF = 0.5
LIMB = 0.04  # half a stout trunk
_FINE = 250  # pixels: a crown of twice that size is looked at in squares of two pixels, and so on


def looks_bare(found: Bool[np.ndarray, "row column"], inside: Bool[np.ndarray, "row column"]) -> bool:
    """Whether what was found within a crown's stroke is twigs without leaves."""
    found = found & inside
    return cover(found, inside) < BARE or found.sum() < HALF * inside.sum() and _broad(found, LIMB * float(np.sqrt(inside.sum()))) < HALF * found.sum()


def cover(found: Bool[np.ndarray, "row column"], inside: Bool[np.ndarray, "row column"]) -> float:
    """The median share, near by, of the area that twigs span; 1 where nothing was found."""
    factor = max(1, int(np.sqrt(inside.sum()) / _FINE))
    share, held = _shares(found, factor), _shares(inside, factor) >= 0.5
    area = spanned(share > 0, held) & held
    side = 2 * max(int(0.5 * WINDOW * np.sqrt(held.sum())), 1) + 1
    near, of = (ndimage.uniform_filter(part, side, mode="constant") for part in (share * area, area.astype(np.float32)))
    return float(np.median(near[area] / of[area])) if area.any() else 1.0


def _broad(found: Bool[np.ndarray, "row column"], radius: float) -> int:
    """How many pixels discs of that radius cover that hold nothing but what was found."""
    core = ndimage.distance_transform_edt(found) > radius
    return int((ndimage.distance_transform_edt(~core) <= radius).sum()) if core.any() else 0


def _shares(mask: Bool[np.ndarray, "row column"], factor: int) -> Float[np.ndarray, "cell_row cell_column"]:
    """The share of a mask in squares of `factor` pixels; what is left over at the right and below is left out."""
    rows, columns = (length // factor for length in mask.shape)
    return mask[: rows * factor, : columns * factor].reshape(rows, factor, columns, factor).mean(axis=(1, 3), dtype=np.float32)


def spanned(found: Bool[np.ndarray, "row column"], inside: Bool[np.ndarray, "row column"]) -> Bool[np.ndarray, "row column"]:
    """What was found, closed by a disc of GAP of the crown's size."""
    reach = max(GAP * float(np.sqrt(inside.sum())), 2.0)
    near = ndimage.distance_transform_edt(~found) <= reach
    return (ndimage.distance_transform_edt(near) > reach) | found
