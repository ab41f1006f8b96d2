"""Which peaks of density are separate? Those that a valley parts from every higher one, deeper than chance would make it.

Cells are taken from the densest down. One beside none that was taken is a peak; where two peaks' cells meet is the saddle between them, and the lower peak stays one of its own if

    peak − saddle > a quarter of the peak,  and > 3 standard deviations of what the peak's points would scatter by, had they fallen by chance

The density is spread over 4π σ² cells, so a peak of p points a cell has 4π σ² p points, and scatters by √(p / 4π σ²).
"""

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.clouds.standing.density import SPREAD, Density

_DEEP, _SURE = 0.25, 3.0
_LEAST, _LOOKED_AT = 0.15, 0.1  # of the highest peak: lower ones are none, lower cells aren't looked at
_CLUSTER = 0.5  # of a peak
_AREA = 4 * np.pi * SPREAD**2  # cells


def peaks(found: Density) -> Float[np.ndarray, "peak 2"]:
    """(x, z) of the separate peaks, metres, the highest first: of each the centroid of its cells that are half as dense as its densest."""
    value, wide = found.value.ravel(), found.value.shape[1]
    order = np.argsort(-value, kind="stable")
    order = order[value[order] > _LOOKED_AT * value.max()]
    whose, top = _peak_of(value, order, wide)
    place = (np.stack(np.divmod(order, wide), axis=1) + 0.5) * found.size + found.corner
    high = value[order] > _CLUSTER * value[top][whose]
    own = [k for k in np.unique(whose).tolist() if value[top[k]] >= max(_LEAST * value.max(), _SURE**2 / _AREA)]
    clusters = [high & (whose == k) for k in own]
    return np.array([np.average(place[some], axis=0, weights=value[order[some]]) for some in clusters]).reshape(-1, 2)


def _peak_of(value, order, wide: int):
    """(the separate peak that each cell of `order` belongs to, the densest cell of every peak)."""
    beside = np.array([-1, 1, -wide, wide, -wide - 1, -wide + 1, wide - 1, wide + 1])  # the plan's margin is empty: no cell that is looked at lies on its edge
    name, top, under = np.full(len(value), NULL), [], []  # `under`: the higher peak that a peak is part of, or itself
    for cell in order.tolist():
        near = {_whole(under, k) for k in name[cell + beside].tolist() if k != NULL}
        if not near:
            name[cell] = len(top)
            under.append(len(top))
            top.append(cell)
            continue
        highest = min(near)  # peaks are numbered from the highest
        name[cell] = highest
        for k in near - {highest}:
            peak = value[top[k]]
            if peak - value[cell] <= max(_DEEP * peak, _SURE * np.sqrt(peak / _AREA)):
                under[k] = highest
    return np.array([_whole(under, k) for k in name[order].tolist()], int), np.array(top, int)


def _whole(under: list[int], k: int) -> int:
    while under[k] != k:
        k = under[k]
    return k
