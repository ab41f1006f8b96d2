"""Are these pieces one stem, or several that come out of the ground close to one another?

Near the ground, where stems of a shrub don't cross yet, points are joined over shorter steps. What falls apart there is several stems, unless the parts lie round one circle: the bark of
a trunk that was scanned from two sides. What is higher goes with the stem from which it is reached most easily.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components

from sketchtree.clouds.standing.reached import reached
from sketchtree.clouds.standing.stems import OVER, breast_height, pieces
from sketchtree.clouds.tracing.circles import circles

_LOW = 0.4  # of the slab that stems are sought in
_STEP, _SPACINGS = 0.004, 2.5  # of the height, spacings
_SHARE, _FEWEST = 0.15, 20  # of the largest part, points: less is no stem
_MOST = 40  # parts
_POINTS = 120  # of a part, that a circle is laid through
_ROUND, _NEAR, _OFF = 0.6, 0.8, 0.12  # share of one circle that was seen, of the points near it, and how far off it in radii: then the parts are of one trunk


def parted(xyz: Float[np.ndarray, "point 3"], above: Float[np.ndarray, " point"], groups: list[Int[np.ndarray, "_"]]) -> list[Int[np.ndarray, "_"]]:
    """The stems that pieces of the slab, of one plant, are made of, the largest first: as many, or more, or fewer."""
    parts = [part for rows in groups for part in _parts(xyz, above, rows)]
    most = max(map(len, parts))
    parts = sorted((part for part in parts if len(part) >= min(_FEWEST, most) and len(part) >= _SHARE * most), key=len, reverse=True)[:_MOST]
    starts = trunks_of(xyz, parts)
    number = len(starts)
    rest = np.setdiff1d(np.concatenate(groups), np.concatenate(starts))
    ordered = np.concatenate([*starts, rest])
    ends = np.cumsum([len(some) for some in starts])
    whose = reached(xyz[ordered], [np.arange(end - len(some), end) for end, some in zip(ends, starts, strict=True)])
    return sorted((ordered[whose == k] for k in range(number)), key=len, reverse=True)


def trunks_of(xyz: Float[np.ndarray, "point 3"], parts: list[Int[np.ndarray, "_"]]) -> list[Int[np.ndarray, "_"]]:
    """The same parts, with those round one circle put together."""
    number, same = connected_components(csr_matrix([[one is other or _one_trunk(xyz, one, other) for other in parts] for one in parts]), directed=False)
    return [np.concatenate([part for part, name in zip(parts, same, strict=True) if name == k]) for k in range(number)]


def _parts(xyz, above, rows) -> list:
    """What a piece falls apart into near the ground; the piece's lowest points where that is nothing much."""
    low = rows[above[rows] <= max(_LOW * OVER * breast_height(float(np.ptp(above))), float(np.sort(above[rows])[min(2, len(rows) - 1)]))]
    if len(low) < 2 * _FEWEST:
        return [low]
    piece = pieces(xyz[low], _STEP * float(np.ptp(above)), _SPACINGS)
    return [low[piece == k] for k in np.argsort(-np.bincount(piece), kind="stable")[:_MOST]]


def _one_trunk(xyz, one, other) -> bool:
    """Whether two parts lie round one circle, as seen from above."""
    both = np.concatenate([some[:: max(1, len(some) // _POINTS)] for some in (one, other)])
    plan = xyz[both][:, [0, 2]]
    found = circles(plan[None], np.ones((1, len(plan)), bool))
    return bool(found.seen[0] >= _ROUND and found.near[0] >= _NEAR and found.off[0] <= _OFF * found.radius[0])
