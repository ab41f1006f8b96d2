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

_FEWEST_COLUMNS, _MOST_COLUMNS = 16, 256  # along a side
_PAIRS = 2_000_000  # of a point and a triangle, at once


@dataclass(frozen=True, eq=False)
class Solid:
    """The inside of closed triangles. Upright triangles count for nothing and are left out."""

    box: Float[np.ndarray, "2 3"]  # two corners that hold the triangles, metres
    edge: Float[np.ndarray, "4 triangle 3"]  # of each edge, seen from above: z from, z to, x at the first, dx/dz
    plane: Float[np.ndarray, "3 triangle"]  # y = plane[0] + plane[1] x + plane[2] z
    sign: Float[np.ndarray, " triangle"]  # 1 if it faces up, −1 if down
    start: Int[np.ndarray, " column+1"]  # column i holds triangle[start[i]:start[i + 1]]
    triangle: Int[np.ndarray, " entry"]

    @classmethod
    def from_triangles(cls, corner: Float[np.ndarray, "triangle 3 3"]) -> "Solid":
        """Sorted into columns, about as many as there are triangles."""
        corner = np.asarray(corner, float)
        box = np.stack([corner.min(axis=(0, 1)), corner.max(axis=(0, 1))])
        normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        flat = normal[:, 1] != 0
        corner, normal = corner[flat], normal[flat]
        slope = -normal[:, [0, 2]] / normal[:, 1:2]
        height = corner[:, 0, 1] - np.einsum("ti,ti->t", slope, corner[:, 0][:, [0, 2]])
        count = int(np.clip(np.sqrt(len(corner)), _FEWEST_COLUMNS, _MOST_COLUMNS))
        start, triangle = _columns(corner[:, :, [0, 2]], box[:, [0, 2]], count)
        return cls(box, _edges(corner), np.stack([height, *slope.T]), np.sign(normal[:, 1]), start, triangle)

    def inside(self, point: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
        """Which points lie inside."""
        rows = np.flatnonzero(((point >= self.box[0]) & (point <= self.box[1])).all(axis=1))
        count = int(round(np.sqrt(len(self.start) - 1)))
        column = _column(point[rows][:, [0, 2]], self.box[:, [0, 2]], count) @ np.array([count, 1])
        many = np.diff(self.start)[column]
        winding = np.zeros(len(point))
        for part in np.split(np.arange(len(rows)), np.flatnonzero(np.diff(np.cumsum(many) // _PAIRS)) + 1):
            owner = np.repeat(part, many[part])
            entry = np.arange(len(owner)) - np.repeat(np.cumsum(many[part]) - many[part], many[part]) + self.start[column[owner]]
            which, sign = self._above(point, rows[owner], self.triangle[entry])
            winding += np.bincount(which, sign, minlength=len(point))
        return winding != 0

    def _above(self, point, row, triangle):
        """(point, sign of the triangle) wherever the line up from a point meets its triangle."""
        x, z = point[row, 0], point[row, 2]
        within = np.zeros(len(row), bool)
        for first, last, at, slope in (self.edge[:, triangle, k] for k in range(3)):
            within ^= (first <= z) & (z < last) & (at + (z - first) * slope > x)
        row, triangle, x, z = row[within], triangle[within], x[within], z[within]
        a, b, c = self.plane[:, triangle]
        above = a + b * x + c * z > point[row, 1]
        return row[above], self.sign[triangle[above]]


def _edges(corner):
    """Each edge from its end of lesser z to the other: the same numbers for both triangles that share it."""
    a, b = corner, np.roll(corner, -1, axis=1)
    lower = (a[:, :, 2] < b[:, :, 2])[:, :, None]
    first, last = np.where(lower, a, b), np.where(lower, b, a)
    span = last[:, :, 2] - first[:, :, 2]
    slope = (last[:, :, 0] - first[:, :, 0]) / np.where(span > 0, span, 1.0)
    return np.stack([first[:, :, 2], last[:, :, 2], first[:, :, 0], slope])


def _columns(flat, box, count: int):
    """The triangles of every column, as a ragged table (start, triangle)."""
    first, last = (_column(edge, box, count) for edge in (flat.min(axis=1), flat.max(axis=1)))
    wide = last - first + 1
    cells = wide.prod(axis=1)
    owner = np.repeat(np.arange(len(flat)), cells)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(cells) - cells, cells)
    column = (first[owner, 0] + place // wide[owner, 1]) * count + first[owner, 1] + place % wide[owner, 1]
    start = np.r_[0, np.cumsum(np.bincount(column, minlength=count**2))]
    return start, owner[np.argsort(column, kind="stable")]


def _column(at, box, count: int):
    size = np.maximum((box[1] - box[0]) / count, 1e-12)
    return np.clip(((at - box[0]) / size).astype(np.int64), 0, count - 1)
