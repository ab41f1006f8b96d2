"""How thick is the wood where it was seen, and where is its axis?

The points of a node and of its neighbours on the limb, as seen along the limb, lie round a circle (`circles`). Where enough of it was seen, and most points lie on it, the node
moves to its middle: a trunk that was scanned from one side has its axis inside, not on its bark.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.clouds.tracing.circles import circles
from sketchtree.traverse import limb_chains

_POINTS = 64  # the most that one circle is laid through
_REACH = 1.5  # half that length, in radii or layers, whichever is more
_SEEN, _NEAR, _OFF = 0.4, 0.6, 0.35  # least of the circle, least of the points, most off it in radii
_LEAST = 8  # points
_MOVED = 1.5  # radii that an axis may move


@dataclass(frozen=True, eq=False)
class Measured:
    """Thickness as it was seen."""

    centre: Float[np.ndarray, "node 3"]  # on the axis where that was found
    radius: Float[np.ndarray, " node"]  # metres; NaN where it wasn't
    off: Float[np.ndarray, " node"]  # metres that points typically lie off the bark; NaN where unknown
    seen: Float[np.ndarray, " node"]  # share of the circle

    @property
    def known(self) -> Bool[np.ndarray, " node"]:
        """Nodes whose thickness was found."""
        return np.isfinite(self.radius)


def measured(
    xyz: Float[np.ndarray, "point 3"],
    of_point: Int[np.ndarray, " point"],
    parent: Int[np.ndarray, " node"],
    centre: Float[np.ndarray, "node 3"],
    limb: Int[np.ndarray, " node"],
    width: Float[np.ndarray, " node"],
    thick: Float[np.ndarray, " node"] | None = None,
) -> Measured:
    """Thickness and axes of nodes whose layers are so wide, metres. `of_point`: the node of each point; NULL for none. `thick`: about how thick the wood is, metres, which says how
    long a piece of limb is looked at; without it that is found first."""
    chain = np.concatenate(limb_chains(parent, limb))  # limb after limb, each from its foot on
    place = np.empty(len(chain), np.int64)
    place[chain] = np.arange(len(chain))
    held = np.flatnonzero(of_point != NULL)
    held = held[np.argsort(place[of_point[held]], kind="stable")]
    start = np.searchsorted(place[of_point[held]], np.arange(len(chain) + 1))
    if thick is None:
        thick = np.nan_to_num(_measured(xyz[held], start, chain, parent, limb, centre, width).radius)
    return _measured(xyz[held], start, chain, parent, limb, centre, np.maximum(thick, width))


def _measured(xyz, start, chain, parent, limb, centre, thick) -> Measured:
    points, there, axes = _seen_along(xyz, start, chain, parent, limb, centre, thick)
    rows = np.flatnonzero(there.sum(axis=1) >= _LEAST)
    found = circles(points[rows], there[rows])
    moved = np.linalg.norm(found.centre, axis=1)
    good = (found.seen >= _SEEN) & (found.near >= _NEAR) & (found.off < _OFF * found.radius) & (moved < _MOVED * found.radius)
    sure = rows[good]
    centre = centre.copy()
    centre[sure] += np.einsum("nk,nki->ni", found.centre[good], axes[sure])
    radius, off, seen = np.full((3, len(parent)), np.nan)
    radius[sure], off[sure], seen[rows] = found.radius[good], found.off[good], found.seen
    return Measured(centre, radius, off, seen)


def _seen_along(xyz, start, chain, parent, limb, centre, thick):
    """(points round each node's axis as seen along it, which entries are points, the two axes that they are seen on). `start`: where the points of each place in `chain` begin."""
    here, above, named = centre[chain], parent[chain], limb[chain]
    first = np.r_[True, named[1:] != named[:-1]]
    before = np.where((above == NULL)[:, None], here, centre[above])
    # distances along limbs, one limb far beyond the other so that a window never reaches into the next
    length = np.linalg.norm(here - np.where(first[:, None], here, np.roll(here, 1, axis=0)), axis=1)
    reach = _REACH * thick[chain]
    along = np.cumsum(length + first * (4 * reach.max() + 1.0))
    low, high = np.searchsorted(along, along - reach), np.searchsorted(along, along + reach, side="right")
    last, k = np.r_[first[1:], True], np.arange(len(chain))
    low, high = np.minimum(low, np.where(first, k, k - 1)), np.maximum(high, np.where(last, k + 1, k + 2))
    way = here[high - 1] - np.where(first[low][:, None], before[low], here[low])
    size = np.linalg.norm(way, axis=1, keepdims=True)
    way = np.where(size > 1e-12, way / np.maximum(size, 1e-12), [0.0, 1.0, 0.0])
    side = np.cross(way, [0.31, 0.2, 0.93])
    side /= np.maximum(np.linalg.norm(side, axis=1, keepdims=True), 1e-12)
    count = start[high] - start[low]
    taken = np.minimum(count, _POINTS)
    index = start[low][:, None] + (np.arange(_POINTS) * np.maximum(count, _POINTS)[:, None]) // _POINTS
    there = np.arange(_POINTS) < taken[:, None]
    away = xyz[np.where(there, index, 0)] - here[:, None]
    near = there & (np.abs(np.einsum("nki,ni->nk", away, way)) <= 1.2 * reach[:, None])
    there = np.where((near.sum(axis=1) >= 3)[:, None], near, there)
    axes = np.stack([side, np.cross(way, side)], axis=1)
    points = np.where(there[..., None], np.einsum("nki,nji->nkj", away, axes), 0.0)
    back = np.argsort(chain)
    return points[back], there[back], axes[back]
