"""Which spots are no line, and which holes no paper? Specks of dust and of the paper's grain, the dark edge that a scan leaves,
and the pinholes that the paper's tooth leaves in a pencil's line.

A spot is a speck if it is no longer than SPECK times the pen's width and round, or smaller than TINY of the pen's width
squared. A hole is a pinhole if it is smaller than PINHOLE of the pen's width squared: it would split the line round it. An edge is ink that touches the picture's border over most of one side and reaches at most RIM of it inward.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool
from scipy.ndimage import find_objects, label

SPECK = 2.2  # pens: a round spot no longer is a speck
TINY = 1.2  # pens squared: a spot of less ink is a speck, whatever its shape
PINHOLE = 1.0  # pens squared
LONG = 2.5  # longer side of a spot's box over its shorter one: a dash
RIM = 0.06  # of the picture's side
ALONG = 0.5  # of the picture's side


@dataclass(frozen=True, eq=False)
class Swept:
    """The ink without what is no line."""

    mask: Bool[np.ndarray, "row col"]
    specks: int
    edges: int


def swept(mask: Bool[np.ndarray, "row col"], pen: float) -> Swept:
    """Take specks and the scan's edge out of the ink, and fill its pinholes."""
    mask = _without_pinholes(mask, PINHOLE * pen**2)
    labels, count = label(mask, np.ones((3, 3)))
    if count == 0:
        return Swept(mask, 0, 0)
    area = np.bincount(labels.ravel(), minlength=count + 1)[1:]
    boxes = find_objects(labels)
    low = np.array([(box[0].start, box[1].start) for box in boxes])
    high = np.array([(box[0].stop, box[1].stop) for box in boxes])
    side = (high - low).astype(float)
    long, short = side.max(1), side.min(1)
    speck = (long <= SPECK * pen) & (long <= LONG * short) | (area < TINY * pen**2)
    edge = _edges(low, high, np.array(mask.shape)) & (area < area.max())
    keep = np.r_[False, ~(speck | edge)]
    return Swept(keep[labels], int(speck.sum()), int((edge & ~speck).sum()))


def _without_pinholes(mask: Bool[np.ndarray, "row col"], largest: float) -> Bool[np.ndarray, "row col"]:
    labels, count = label(~mask)
    small = np.bincount(labels.ravel(), minlength=count + 1) < largest
    small[0] = True  # the ink itself
    return small[labels]


def _edges(low, high, shape) -> Bool[np.ndarray, " spot"]:
    """Spots that run along one side of the picture."""
    found = np.zeros(len(low), bool)
    for across in (0, 1):
        along = 1 - across
        thin = (high - low)[:, across] <= RIM * shape[across]
        runs = (high - low)[:, along] >= ALONG * shape[along]
        at = (low[:, across] == 0) | (high[:, across] == shape[across])
        found |= thin & runs & at
    return found
