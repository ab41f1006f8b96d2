"""Where on a limb's surface is a point, and what is there?

The surface of limb i is a grid of rings j and columns c; on it a place has an azimuth θ (radians from the seam,
counter-clockwise seen from the tip, unwrapped where it helps) and a length s (metres along the limb):

    column  c = n θ / 2π        ring  j + (s − s_j) / (s_j+1 − s_j)

    n   columns in use there, n₀ / 2^level        x(θ, s)   bilinear between the four vertices round the place

Seen from outside, θ and s are a right-handed pair of axes.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.rings import Rings
from sketchtree.geometry.rootflare import flare


@dataclass(frozen=True, eq=False)
class Grid:
    """All rings with all their vertices, ragged: ring j owns `first[j]:first[j + 1]`."""

    ring: Rings
    of_ring: Int[np.ndarray, " ring"]  # limb
    side: Int[np.ndarray, " ring"]  # n₀
    level: Int[np.ndarray, " ring"]  # every 2^level-th vertex is used
    first: Int[np.ndarray, " ring+1"]
    of_vertex: Int[np.ndarray, " vertex"]  # ring
    column: Int[np.ndarray, " vertex"]

    @classmethod
    def of(cls, ring: Rings, side: Int[np.ndarray, " limb"], level: Int[np.ndarray, " ring"]) -> "Grid":
        """The grid of rings whose limbs have `side` columns at their feet."""
        of_ring = ring.limb
        count = side[of_ring]
        first = np.r_[0, np.cumsum(count)].astype(np.int64)
        of_vertex = np.repeat(np.arange(len(count)), count)
        return cls(ring, of_ring, count, level, first, of_vertex, np.arange(first[-1]) - first[of_vertex])

    @property
    def columns(self) -> Int[np.ndarray, " ring"]:
        """n of every ring."""
        return self.side >> self.level

    def row(self, limb, s) -> tuple[Int[np.ndarray, " place"], Float[np.ndarray, " place"]]:
        """The ring below each place and the share of the way to the next."""
        stride = 2.0 * float(self.ring.s.max(initial=0.0)) + 1.0
        j = np.searchsorted(self.of_ring * stride + self.ring.s, limb * stride + s, side="right") - 1
        j = np.clip(j, self.ring.start[limb], self.ring.start[limb + 1] - 2)
        return j, np.clip((s - self.ring.s[j]) / (self.ring.s[j + 1] - self.ring.s[j]), 0.0, 1.0)

    def at(self, limb, theta, s, *columns: Float[np.ndarray, "vertex 3"]) -> tuple[Float[np.ndarray, "place 3"], ...]:
        """Values of columns a vertex at places on the surface."""
        j, up = self.row(limb, s)
        n, level = self.columns[j], self.level[j]
        c = theta / (2.0 * np.pi) * n
        left = np.floor(c).astype(np.int64)
        across = (c - left)[:, None]
        up = up[:, None]
        near, far = (left % n) << level, ((left + 1) % n) << level
        low, high = self.first[j], self.first[j + 1]
        return tuple(
            (1 - up) * ((1 - across) * x[low + near] + across * x[low + far]) + up * ((1 - across) * x[high + near] + across * x[high + far])
            for x in columns
        )

    def place(self, limb, s, point) -> Float[np.ndarray, " place"]:
        """θ of points near the surface `s` metres along these limbs."""
        j, up = self.row(limb, s)
        up = up[:, None]
        blend = lambda x: (1 - up) * x[j] + up * x[j + 1]  # noqa: E731
        along, seam = blend(self.ring.tangent), blend(self.ring.reference)
        away = point - blend(self.ring.point)
        across = np.cross(along, seam)
        return np.arctan2(np.sum(away * across, axis=1), np.sum(away * seam, axis=1))


def circles(grid: Grid, lines: CentreLines, amount: float) -> Float[np.ndarray, "vertex 3"]:
    """The vertices of all rings as round rings, wider where stems flare by `amount` at the ground."""
    ring, at = grid.ring, grid.of_vertex
    theta = 2.0 * np.pi * grid.column / grid.side[at]
    across = np.cross(ring.tangent, ring.reference)
    out = np.cos(theta)[:, None] * ring.reference[at] + np.sin(theta)[:, None] * across[at]
    wide = ring.radius[at].copy()
    stem = lines.is_stem[grid.of_ring]
    for n in np.unique(grid.side[stem]).tolist():
        rows = np.flatnonzero(stem & (grid.side == n))
        wide[(grid.first[rows][:, None] + np.arange(n)).ravel()] *= flare(lines, ring, rows, 2.0 * np.pi * np.arange(n) / n, amount).ravel()
    return ring.point[at] + wide[:, None] * out


def normals(grid: Grid, x: Float[np.ndarray, "vertex 3"]) -> Float[np.ndarray, "vertex 3"]:
    """Unit normals of the grid: the cross product of the differences round and along."""
    at, n = grid.of_vertex, grid.side[grid.of_vertex]
    first = grid.first[at]
    around = x[first + (grid.column + 1) % n] - x[first + (grid.column - 1) % n]
    up, down = np.arange(1, len(grid.side) + 1), np.arange(-1, len(grid.side) - 1)
    up[grid.ring.start[1:] - 1] -= 1
    down[grid.ring.start[:-1]] += 1
    normal = np.cross(around, x[grid.first[up[at]] + grid.column] - x[grid.first[down[at]] + grid.column])
    return normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
