"""On which of a told number of stems does each low point lie? Ours: stems that touch at the ground have parted a bit higher up, and are followed down from there.

    1. points in the upper half of the slab that stems are sought in (`stems`) are projected on the ground, as in Guo et al. 2018, §5.3, and their density has peaks (`peaks`)
    2. the density is spread less and less, until there are as many peaks as were told: what is spread wider than stems stand apart has too few
    3. layer by layer from there down, every point goes with the stem whose middle in the layer above is nearest; its middle in this layer is that of its points

Peaks round one circle are of one trunk. Where no spread shows so many, there are fewer.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.clouds.standing.density import CELL, density
from sketchtree.clouds.standing.parted import trunks_of
from sketchtree.clouds.standing.peaks import peaks
from sketchtree.clouds.standing.stems import OVER, breast_height

_FINER = (1.0, 0.7, 0.5, 0.35, 0.25)  # of the cell of `density`
_UPPER = 0.5  # of the slab
_LAYERS = 10
_ROUNDS = 3  # of a layer's middles
_FEWEST = 3  # points of a stem


def told(xyz: Float[np.ndarray, "point 3"], above: Float[np.ndarray, " point"], count: int, among: Int[np.ndarray, "_"] | None = None) -> list[Int[np.ndarray, "_"]]:
    """The low points of so many stems, the largest first; of fewer where the points show fewer. `among`: points that may be low; without it all."""
    height = float(np.ptp(above))
    among = np.arange(len(above)) if among is None else among
    top = max(OVER * breast_height(height), float(np.sort(above[among])[min(len(among) - 1, 3 * count)]))
    low = among[above[among] <= top]
    upper = low[above[low] >= _UPPER * top]
    best: list = []
    for finer in _FINER:
        place = peaks(density(xyz[upper], height, finer * CELL))[:count] if len(upper) else []
        best = max(best, _stems(xyz, above, low, place, top), key=len) if len(place) > len(best) else best
        if len(best) >= count:
            break
    return sorted(best, key=len, reverse=True)


def _stems(xyz, above, low, place, top: float) -> list:
    """The points of each stem, followed down from its peak; those round one circle are one."""
    layer = np.clip((top - above[low]) / (_UPPER * top) - 1, 0, 1 - 1e-9)
    layer = np.where(above[low] >= _UPPER * top, 0, 1 + (layer * _LAYERS).astype(int))
    whose = np.empty(len(low), int)
    for k in range(_LAYERS + 1):
        here = np.flatnonzero(layer == k)
        plan = xyz[low[here]][:, [0, 2]]
        for _ in range(_ROUNDS if len(here) else 0):
            whose[here] = cKDTree(place).query(plan)[1]
            count = np.bincount(whose[here], minlength=len(place))[:, None]
            sums = np.stack([np.bincount(whose[here], plan[:, axis], len(place)) for axis in (0, 1)], axis=1)
            place = np.where(count > 0, sums / np.maximum(count, 1), place)
    found = [rows for rows in (low[whose == k] for k in range(len(place))) if len(rows) >= _FEWEST]
    return trunks_of(xyz, found) if found else []
