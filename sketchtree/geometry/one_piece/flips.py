"""Does a triangle of a hole use an edge that the wood has already?

A hole that takes all columns of a limb but one, or touches another hole, can be triangulated with a chord between two corners that
are joined elsewhere too: behind the limb, or on the other side of its boundary. The surface would meet itself there. Such a chord
is flipped, and so is, where it can be, one between corners that have others between them on one ring or column: the two triangles on it,
p q r and q p t, become r t q and t r p.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int

from sketchtree.geometry.one_piece.grid import Grid
from sketchtree.geometry.one_piece.holes import Holes, cell_start

_PASSES = 6


@dataclass(frozen=True, eq=False)
class _Corners:
    """Where the corners are on the grid; ring −1 for those of outlines."""

    ring: Int[np.ndarray, " corner"]
    column: Int[np.ndarray, " corner"]  # unwrapped
    columns: Int[np.ndarray, " corner"]
    vertex: Int[np.ndarray, " corner"]  # the same for corners that are one vertex
    start: Int[np.ndarray, " ring+1"]  # first cell above each ring
    covered: Bool[np.ndarray, " cell"]
    boundary: Int[np.ndarray, " edge"]  # keys of the loops' edges

    def key(self, p, q):
        """One number an edge, whichever way."""
        a, b = self.vertex[p], self.vertex[q]
        return np.minimum(a, b) * (1 << 31) + np.maximum(a, b)

    def crooked(self, p, q):
        """Others lie between the ends on their ring or column."""
        over, up = np.abs(self.column[p] - self.column[q]), np.abs(self.ring[p] - self.ring[q])
        return ((up == 0) & (over > 1)) | ((over == 0) & (up > 1))

    def taken(self, p, q):
        """Whether the grid or a boundary has the edge."""
        swap = self.ring[p] > self.ring[q]
        p, q = np.where(swap, q, p), np.where(swap, p, q)
        n, j = self.columns[p], self.ring[p]
        a, b = self.column[p] % n, self.column[q] % n
        level, one_up = self.ring[q] == j, self.ring[q] == j + 1
        west = np.where((a + 1) % n == b, a, b)
        beside = level & (((a + 1) % n == b) | ((b + 1) % n == a)) & ~(self._covers(j, west) & self._covers(j - 1, west))
        upright = one_up & (a == b) & ~(self._covers(j, a) & self._covers(j, (a - 1) % n))
        slanting = one_up & ((a + 1) % n == b) & ~self._covers(j, a)
        return (self.vertex[p] == self.vertex[q]) | beside | upright | slanting | np.isin(self.key(p, q), self.boundary)

    def _covers(self, ring, column):
        cell = np.clip(self.start[np.maximum(ring, 0)] + column, 0, len(self.covered) - 1)
        return self.covered[cell]


def flipped(
    grid: Grid, h: Holes, outline_corners: int, triangle: Int[np.ndarray, "triangle 3"]
) -> tuple[Int[np.ndarray, "triangle 3"], Bool[np.ndarray, " triangle"]]:
    """The triangles of all holes without such chords, and those that have one left."""
    corners = _corners(grid, h, outline_corners)
    triangle = triangle.copy()
    for _ in range(_PASSES):
        wrong, crooked = _chords(corners, triangle)
        near = triangle[np.isin(triangle, triangle[[k for *_, one, other in wrong + crooked for k in (one, other)]].ravel()).sum(axis=1) >= 2]
        edges = {tuple(edge) for k in range(3) for edge in near[:, [k, (k + 1) % 3]].tolist()}
        if not _flip(corners, triangle, wrong + crooked, edges):
            break
    left = np.zeros(len(triangle), bool)
    for _, _, one, other in _chords(corners, triangle)[0]:
        left[[one, other]] = True
    return triangle, left


def _corners(grid: Grid, h: Holes, outline_corners: int) -> _Corners:
    nowhere = np.full(outline_corners, -1)
    n = grid.columns[h.ring]
    start, covered = cell_start(grid), np.zeros(cell_start(grid)[-1], bool)
    covered[h.cell] = True
    vertex = grid.first[h.ring] + ((h.column % n) << grid.level[h.ring])
    own = len(grid.of_vertex) + np.arange(outline_corners)
    after = np.arange(1, len(n) + 1)
    after[h.start[1:] - 1] = h.start[:-1]
    c = _Corners(np.r_[h.ring, nowhere], np.r_[h.column, nowhere], np.r_[n, nowhere], np.r_[vertex, own], start, covered, np.zeros(0, np.int64))
    return _Corners(c.ring, c.column, c.columns, c.vertex, start, covered, np.unique(c.key(np.arange(len(n)), after)))


def _chords(c: _Corners, triangle):
    """Edges p → q that are taken, and crooked ones: with the triangle that has each and the one that has q → p."""
    edge = np.concatenate([triangle[:, [0, 1]], triangle[:, [1, 2]], triangle[:, [2, 0]]])
    of = np.tile(np.arange(len(triangle)), 3)
    some = (c.ring[edge[:, 0]] >= 0) | (c.ring[edge[:, 1]] >= 0)
    (p, q), of = edge[some].T, of[some]
    way, back = p * len(c.ring) + q, q * len(c.ring) + p
    order = np.argsort(way)
    at = order[np.minimum(np.searchsorted(way[order], back), max(len(way) - 1, 0))] if len(way) else order
    chord = np.flatnonzero((p < q) & (way[at] == back))
    p, q, one, other = p[chord], q[chord], of[chord], of[at[chord]]
    _, copy, times = np.unique(c.key(p, q), return_inverse=True, return_counts=True)
    on_grid = (c.ring[p] >= 0) & (c.ring[q] >= 0)
    taken = times[copy.reshape(-1)] > 1
    taken[on_grid] |= c.taken(p[on_grid], q[on_grid])
    crooked = on_grid & ~taken
    crooked[on_grid] &= c.crooked(p[on_grid], q[on_grid])
    found = np.stack([p, q, one, other], axis=1)
    return found[taken].tolist(), found[crooked].tolist()


def _flip(c: _Corners, triangle, chords, edges: set) -> bool:
    """Flips the chords that can be, in place; whether there was one."""
    touched: set = set()
    for p, q, one, other in chords:
        if one in touched or other in touched:
            continue
        r, t = (int(next(corner for corner in triangle[k] if corner not in (p, q))) for k in (one, other))
        pair = np.array([r]), np.array([t])
        on_grid = c.ring[r] >= 0 and c.ring[t] >= 0
        if {(r, t), (t, r)} & edges or on_grid and (c.crooked(*pair)[0] or c.taken(*pair)[0]):
            continue
        edges |= {(r, t), (t, r)}
        triangle[one], triangle[other] = (r, t, q), (t, r, p)
        touched |= {one, other}
    return bool(touched)
