"""Which part of what stands before the sky is the main tree's crown? The largest lump about the middle of the photo, above the ground.

Twigs and gaps are closed, posts, wires and trunks opened away; the lump of the greatest area, each pixel weighted by its nearness to the photo's upright middle, is the crown.
"""

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy import ndimage
from skimage.measure import approximate_polygon, find_contours

CLOSED = 0.025  # of the photo's size: gaps that are closed
OPENED = 0.035  # what is narrower is no crown
STEM = 0.1  # of the tree's height: bare trunk below the crown
_UPPER = 0.5  # of its height, from the top: where it may widen as it likes
_SPREAD = 0.25  # pixels a row that it widens on either side, below that
_MIDDLE = 0.3  # σ of the weight across, of the width
_EXACT = 0.006  # of the photo's size, to which the outline is simplified


def find_crown(stands: Bool[np.ndarray, "row column"], ground: Int[np.ndarray, " column"]) -> Bool[np.ndarray, "row column"] | None:
    """The crown's area; None where nothing stands before the sky."""
    size = max(stands.shape)
    above = stands & (np.arange(len(stands))[:, None] < ground)
    lump = _opened(ndimage.binary_fill_holes(_closed(above, CLOSED * size)), OPENED * size)
    parts, count = ndimage.label(lump)
    if not count:
        return None
    across = np.exp(-0.5 * ((np.arange(stands.shape[1]) / stands.shape[1] - 0.5) / _MIDDLE) ** 2)
    weight = ndimage.sum_labels(np.broadcast_to(across, stands.shape), parts, np.arange(1, count + 1))
    return parts == 1 + int(np.argmax(weight))


def without_skirt(area: Bool[np.ndarray, "row column"], foot: float) -> Bool[np.ndarray, "row column"]:
    """The crown without what stands beside its trunk: a hedge, a horizon. In its lower part it widens no faster than a crown does, and ends STEM of its height above the foot."""
    rows = np.flatnonzero(area.any(axis=1))
    top, bottom = int(rows[0]), int(min(rows[-1], foot - STEM * (foot - rows[0])))
    kept = area.copy()
    kept[max(bottom + 1, top + 2) :] = False
    begin, columns = int(top + _UPPER * (foot - top)), np.arange(area.shape[1])
    left = right = None
    for row in range(begin, bottom + 1):
        found = np.flatnonzero(area[row])
        if not len(found):
            continue
        low, high = (found[0], found[-1]) if left is None else (max(found[0], left - _SPREAD), min(found[-1], right + _SPREAD))
        left, right = min(low, high), max(low, high)
        kept[row] &= (columns >= left) & (columns <= right)
    parts, count = ndimage.label(kept)
    return parts == 1 + int(np.argmax(ndimage.sum_labels(kept, parts, np.arange(1, count + 1)))) if count else area


def outline_of(area: Bool[np.ndarray, "row column"]) -> Float[np.ndarray, "point 2"]:
    """The longest outline of an area: pixels, y down, first point not repeated."""
    around = find_contours(np.pad(area, 1).astype(np.float64), 0.5)
    longest = max(around, key=len)
    simple = approximate_polygon(longest, _EXACT * max(area.shape))[:-1]
    return np.clip(simple[:, ::-1] - 0.5, 0, [area.shape[1], area.shape[0]])


def _opened(area: Bool[np.ndarray, "row column"], radius: float) -> Bool[np.ndarray, "row column"]:
    """What a disc that stays within the area covers."""
    core = ndimage.distance_transform_edt(area) > radius
    return ndimage.distance_transform_edt(~core) <= radius if core.any() else np.zeros_like(area)


def _closed(area: Bool[np.ndarray, "row column"], radius: float) -> Bool[np.ndarray, "row column"]:
    """An area and the gaps that a disc does not fit into."""
    near = ndimage.distance_transform_edt(~area) <= radius if area.any() else area
    return ndimage.distance_transform_edt(np.pad(near, 1, mode="edge"))[1:-1, 1:-1] > radius
