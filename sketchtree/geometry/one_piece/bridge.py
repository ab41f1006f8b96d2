"""Which triangles join a hole in a parent's grid to the outlines of the limbs that grow out of it?

The hole, less the outlines, is laid flat and triangulated with its edges kept and no corner added (the constrained Delaunay
triangulation of GEOS, by shapely ≥ 2.1). Flat means

    x = r θ              y = s                 where the hole is a patch, r the parent's radius
    ρ = e^(s / r)        at the angle −θ       where it goes all round: the same chart, bent to an annulus without distorting angles

A hole of V corners with h loops inside its outer one has V + 2h − 2 triangles; what has not, or is no polygon, is not bridged.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.geometry.one_piece.flips import flipped
from sketchtree.geometry.one_piece.grid import Grid
from sketchtree.geometry.one_piece.holes import Holes
from sketchtree.geometry.one_piece.outlines import Outlines

_BULGE = 3e-3  # share of its distance by which the farthest corner is drawn in
_ASIDE = np.array([0.0137, 0.0071])


@dataclass(frozen=True, eq=False)
class Bridges:
    """Triangles between corners: those of the holes' loops first, then those of the outlines."""

    triangle: Int[np.ndarray, "triangle 3"]
    hole: Int[np.ndarray, " triangle"]
    bridged: Bool[np.ndarray, " hole"]


@dataclass(frozen=True, eq=False)
class Regions:
    """The holes less their outlines, laid flat."""

    region: np.ndarray  # shapely polygons
    flat: Float[np.ndarray, "corner 2"]
    of_corner: Int[np.ndarray, " corner"]  # hole
    inner: Int[np.ndarray, " hole"]  # loops inside the outer one
    sound: Bool[np.ndarray, " hole"]  # it can be triangulated


def regions(grid: Grid, o: Outlines, h: Holes) -> Regions:
    """The regions that the bridges fill."""
    import shapely

    loops, outlines = len(h.start) - 1, len(o.limb)
    ring_hole = np.r_[h.of_loop, h.of_fork]
    start = np.r_[h.start, h.start[-1] + o.start[1:]]
    flat, of_corner = _flat(grid, o, h)
    ring = shapely.linearrings(flat, indices=np.repeat(np.arange(loops + outlines), np.diff(start)))
    is_inner = np.ones(loops + outlines, bool)
    is_inner[_shells(flat, start, h)] = False
    order = np.lexsort((is_inner, ring_hole))
    region = shapely.polygons(ring[order], indices=ring_hole[order])
    sound = shapely.is_valid(region)
    sound[h.of_fork[~_turns_left(flat, start[loops:])]] = False
    return Regions(region, flat, of_corner, np.bincount(ring_hole, minlength=len(region)) - 1, sound)


def bridges(grid: Grid, o: Outlines, h: Holes) -> Bridges:
    """The triangles of every hole, counter-clockwise seen from outside."""
    if len(o.limb) == 0:
        return Bridges(np.zeros((0, 3), np.int64), np.zeros(0, np.int64), np.zeros(0, bool))
    r = regions(grid, o, h)
    triangle, hole = _triangles(r.region, r.flat, r.of_corner, r.sound)
    corners = np.bincount(r.of_corner, minlength=len(r.region))
    whole = r.sound & (np.bincount(hole, minlength=len(r.region)) == corners + 2 * r.inner - 2)
    triangle, left = flipped(grid, h, len(o.theta), triangle)
    whole[hole[left]] = False
    kept = whole[hole]
    return Bridges(triangle[kept], hole[kept], whole)


def _flat(grid: Grid, o: Outlines, h: Holes):
    """The corners of loops and outlines in their charts, holes side by side; and the hole of each corner."""
    loop_hole = np.repeat(h.of_loop, np.diff(h.start))
    f = o.of_corner
    corner_hole = np.r_[loop_hole, h.of_fork[f]]
    thick = np.zeros(len(h.limb))
    thick[h.of_fork] = o.thick
    theta = np.r_[2.0 * np.pi * h.column / grid.columns[h.ring], o.theta + 2.0 * np.pi * h.turns[f]]
    s = np.r_[grid.ring.s[h.ring], o.s]
    middle = np.bincount(corner_hole, s, minlength=len(thick)) / np.maximum(np.bincount(corner_hole, minlength=len(thick)), 1)
    x, y = theta, (s - middle[corner_hole]) / thick[corner_hole]
    bent = h.around[corner_hole]
    rho = np.exp(np.where(bent, y, 0.0))
    x, y = np.where(bent, rho * np.cos(theta), x), np.where(bent, -rho * np.sin(theta), y)
    return _bulged(np.stack([x, y], axis=1), corner_hole, len(thick)), corner_hole


def _bulged(flat, corner_hole, count: int):
    """Drawn in a little towards a point near the middle, the farther the more, so that no three corners of an edge of the grid lie on a line,
    where a triangle would have no side to face."""
    middle = np.stack([np.bincount(corner_hole, column, minlength=count) for column in flat.T], axis=1)
    away = flat - (middle / np.maximum(np.bincount(corner_hole, minlength=count), 1)[:, None])[corner_hole] + _ASIDE
    squared = np.sum(away**2, axis=1)
    reach = np.zeros(count)
    np.maximum.at(reach, corner_hole, squared)
    return away * (1.0 - _BULGE * squared / np.maximum(reach[corner_hole], 1e-300))[:, None]


def _shells(flat, start, h: Holes):
    """The outer loop of each hole: the one of the largest box."""
    first = h.start[:-1]
    if len(first) == 0:
        return first
    loops = flat[: h.start[-1]]
    size = np.prod(np.maximum.reduceat(loops, first) - np.minimum.reduceat(loops, first), axis=1)
    rank = np.lexsort((-size, h.of_loop))
    return rank[np.r_[True, np.diff(h.of_loop[rank]) != 0]]


def _turns_left(flat, start):
    """Which polygons are counter-clockwise: bent, a wide one can turn inside out."""
    x, y = flat[start[0] :].T
    after = np.arange(1, len(x) + 1)
    after[start[1:] - start[0] - 1] = start[:-1] - start[0]
    return np.add.reduceat(x * y[after] - y * x[after], start[:-1] - start[0]) > 0


def _triangles(region, flat, corner_hole, able):
    """Triangulates the regions that are `able`: triangles of corners, and their holes."""
    import shapely

    which = np.flatnonzero(able)
    part, at = shapely.get_parts(shapely.constrained_delaunay_triangles(region[which]), return_index=True)
    point, of_part = shapely.get_coordinates(part, return_index=True)
    four = np.bincount(of_part, minlength=len(part)) == 4
    point = point.reshape(-1, 4, 2)[:, :3] if four.all() else np.zeros((0, 3, 2))
    hole = which[at] if four.all() else at[:0]
    e, d = point[:, 1] - point[:, 0], point[:, 2] - point[:, 0]
    clockwise = e[:, 0] * d[:, 1] - e[:, 1] * d[:, 0] < 0
    point[clockwise] = point[clockwise][:, [0, 2, 1]]
    return _corners(point, hole, flat, corner_hole), hole


def _corners(point, hole, flat, corner_hole):
    """The corner at each point of a triangle: coordinates come back as they went in."""
    known = np.column_stack([corner_hole.astype(float), flat])
    asked = np.column_stack([np.repeat(hole, 3).astype(float), point.reshape(-1, 2)])
    rows = np.concatenate([known, asked]) + 0.0
    order = np.lexsort(rows.T[::-1])  # known corners come first among equals: the sort is stable
    new = np.r_[True, (np.diff(rows[order], axis=0) != 0).any(axis=1)]
    first = order[np.flatnonzero(new)][np.cumsum(new) - 1]
    corner = np.empty(len(rows), np.int64)
    corner[order] = first
    return corner[len(known) :].reshape(-1, 3)


