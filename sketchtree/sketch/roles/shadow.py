"""Which shapes are shadows on the ground? Flat closed shapes at the foot of a stem.

A shadow is broader than high, lies low, and the foot of a stem is in it or at its edge (a cast shadow lies to
one side). A painted shape much wider than all the rest is ground.
"""

import numpy as np
from jaxtyping import Bool

from sketchtree.sketch.roles.found import Found
from sketchtree.sketch.roles.ground import BROAD, Stems, stems
from sketchtree.sketch.roles.measures import Measures

FLAT = 1.4  # least width over height
LOW = 0.35  # of the drawing's height: its top lies below
WIDE = 0.1  # of the drawing's height: a narrower shape is no shadow
TALL = 0.2  # of the drawing's height: the stem rises at least so far over it
OPEN = 0.25  # widest opening, of its larger side
BESIDE = 0.15  # of its own size: a foot this near is at its edge


def shadows(m: Measures, free: Bool[np.ndarray, " stroke"], wood: Bool[np.ndarray, " stroke"]) -> list[Found]:
    """The flat closed shapes at the foot of the stems."""
    side = m.high - m.low
    bottom, height = _foot_and_height(m, wood)
    flat = free & (side[:, 0] >= FLAT * side[:, 1]) & (side[:, 0] >= WIDE * height) & (m.opening <= OPEN * m.size)
    flat &= (m.high[:, 1] <= bottom + LOW * height) & (m.area >= 0.3 * side.prod(1)) & (m.area > 0)
    found = []
    for row in np.flatnonzero(flat):
        standing = stems(m, np.flatnonzero(wood & ~flat))
        if not _at_a_foot(m, row, standing, height):
            continue
        rest = np.flatnonzero(wood & ~flat)
        wide = m.filled[row] and side[row, 0] >= BROAD * float(np.ptp(np.r_[m.low[rest, 0], m.high[rest, 0]]))
        if wide:
            found.append(Found(int(row), "ground", "a painted area under the tree, wider than it"))
        else:
            found.append(Found(int(row), "shadow", "a flat closed shape around the foot of a stem"))
    return found


def _foot_and_height(m: Measures, wood) -> tuple[float, float]:
    rows = np.flatnonzero(wood) if wood.any() else np.arange(len(m))
    bottom = float(m.low[rows, 1].min())
    return bottom, float(m.high[rows, 1].max()) - bottom


def _at_a_foot(m: Measures, row: int, standing: Stems, height: float) -> bool:
    reach = BESIDE * m.size[row]
    near = (standing.foot >= m.low[row] - reach).all(1) & (standing.foot <= m.high[row] + reach).all(1)
    return bool((near & (standing.top - m.high[row, 1] >= TALL * height)).any())
