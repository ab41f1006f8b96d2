"""Which points lie inside a closed mesh? Many points at once.

The winding number by crossings: going straight up from a point p, count the triangles above it,

    w(p) = Σ_t sign(n_t · ŷ)        over the triangles t that the upright line through p meets above p

w ≠ 0 is inside, also where closed parts of a mesh overlap. Seen from above, a point is in a triangle by the parity of its edges
to the right, each edge with one end only, so that a line through a shared edge or corner meets one triangle. Triangles are
sorted into upright columns first; a point looks into its own column.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

_MOST_COLUMNS = 256  # along a side
_PAIRS = 2_000_000  # of a point and a triangle, at once


@dataclass(frozen=True, eq=False)
class Solid:
    """The inside of closed triangles."""

    corner: Float[np.ndarray, "triangle 3 3"]  # metres
    low: Float[np.ndarray, " 2"]  # of the columns, x and z
    size: Float[np.ndarray, " 2"]  # of one column, metres
    start: Int[np.ndarray, " column+1"]  # column i holds triangle[start[i]:start[i + 1]]
    triangle: Int[np.ndarray, " entry"]

    @classmethod
    def from_triangles(cls, corner: Float[np.ndarray, "triangle 3 3"]) -> "Solid":
        """Sorted into columns: about one triangle to a column."""
        corner = np.asarray(corner, float)
        flat = corner[:, :, [0, 2]]
        count = int(np.clip(np.sqrt(len(corner)), 1, _MOST_COLUMNS))
        low = flat.min(axis=(0, 1))
        size = np.maximum((flat.max(axis=(0, 1)) - low) / count, 1e-9)
        first, last = (_column(edge, low, size, count) for edge in (flat.min(axis=1), flat.max(axis=1)))
        wide = last - first + 1
        owner = np.repeat(np.arange(len(corner)), wide.prod(axis=1))
        place = np.arange(len(owner)) - np.repeat(np.cumsum(wide.prod(axis=1)) - wide.prod(axis=1), wide.prod(axis=1))
        column = (first[owner, 0] + place // wide[owner, 1]) * count + first[owner, 1] + place % wide[owner, 1]
        start = np.r_[0, np.cumsum(np.bincount(column, minlength=count**2))]
        return cls(corner, low, size, start, owner[np.argsort(column, kind="stable")])

    def inside(self, point: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
        """Which points lie inside."""
        count = int(round(np.sqrt(len(self.start) - 1)))
        at = np.floor((point[:, [0, 2]] - self.low) / self.size)
        rows = np.flatnonzero(((at >= 0) & (at <= count)).all(axis=1))
        column = np.minimum(at[rows].astype(np.int64), count - 1) @ np.array([count, 1])
        many = np.diff(self.start)[column]
        winding = np.zeros(len(point), np.int64)
        for part in np.split(np.arange(len(rows)), np.flatnonzero(np.diff(np.cumsum(many) // _PAIRS)) + 1):
            owner = np.repeat(part, many[part])
            entry = np.arange(len(owner)) - np.repeat(np.cumsum(many[part]) - many[part], many[part]) + self.start[column[owner]]
            sign = _crossings(point[rows[owner]], self.corner[self.triangle[entry]])
            winding += np.bincount(rows[owner], sign, minlength=len(point)).astype(np.int64)
        return winding != 0


def _crossings(point, corner):
    """1 or −1 where the line up from a point meets a triangle that faces up or down, else 0."""
    x, z = point[:, 0], point[:, 2]
    within = np.zeros(len(point), bool)
    for k in range(3):
        within ^= _edge_to_the_right(x, z, corner[:, k], corner[:, (k + 1) % 3])
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    upright = normal[:, 1]
    within &= upright != 0
    aside = normal[:, 0] * (x - corner[:, 0, 0]) + normal[:, 2] * (z - corner[:, 0, 2])
    height = corner[:, 0, 1] - aside / np.where(upright == 0, 1.0, upright)
    return np.where(within & (height > point[:, 1]), np.sign(upright), 0.0)


def _edge_to_the_right(x, z, a, b):
    """Whether an edge crosses the line from (x, z) towards +x; the same for the edge from b to a, to the last bit."""
    lower = (a[:, 2] < b[:, 2]) | ((a[:, 2] == b[:, 2]) & (a[:, 0] < b[:, 0]))
    first, last = np.where(lower[:, None], a, b), np.where(lower[:, None], b, a)
    spans = (first[:, 2] <= z) & (z < last[:, 2])
    along = (z - first[:, 2]) / np.where(spans, last[:, 2] - first[:, 2], 1.0)
    return spans & (first[:, 0] + along * (last[:, 0] - first[:, 0]) > x)


def _column(edge, low, size, count: int):
    return np.clip(((edge - low) / size).astype(np.int64), 0, count - 1)
