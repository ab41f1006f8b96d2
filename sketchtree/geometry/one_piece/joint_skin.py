"""Which bark lies on a joint?

The parent's goes on from the hole's edge to the outlines and up the first half of each collar's bow, where the surface still
runs along the parent; there the limb's own begins. On the chart of the parent the bow's rings stand at

    (1 − t)² A + 2 t (1 − t) F + t² C          A, F, C as places (θ, s), see `outlines`; t as on the bow

Loops share the vertices of the grid. Past the seam, and where a triangle of a hole that goes all round reaches over it, the
vertices stand again with u shifted by the bark's repeats.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.geometry.one_piece.bows import bow_rings
from sketchtree.geometry.one_piece.bridge import Bridges
from sketchtree.geometry.one_piece.grid import Grid
from sketchtree.geometry.one_piece.holes import Holes, cell_start
from sketchtree.geometry.one_piece.outlines import Collars, Outlines
from sketchtree.geometry.stitch import StoredRings


class Vertices(NamedTuple):
    """Columns of some vertices."""

    position: Float[np.ndarray, "vertex 3"]
    normal: Float[np.ndarray, "vertex 3"]
    uv: Float[np.ndarray, "vertex 2"]
    limb: Int[np.ndarray, " vertex"]  # whose bark


@dataclass(frozen=True, eq=False)
class Barks:
    """Where the bark lies on every limb and ring, see `unwrap`."""

    offset: Float[np.ndarray, "limb 2"]  # tiles
    repeat: Float[np.ndarray, " ring"]
    pace: Float[np.ndarray, " ring"]  # tiles a metre
    along: Float[np.ndarray, " ring"]  # tiles


def skirt_rings(collars: Collars) -> Int[np.ndarray, " fork"]:
    """Cells up each collar that have the parent's bark."""
    return np.where(collars.size > 2, bow_rings(collars.size) // 2, 0)


def skirt_cells(grid: Grid, collars: Collars, joined: Bool[np.ndarray, " fork"]) -> Int[np.ndarray, " cell"]:
    """The cells of the limbs' own grids that are made with the parents' bark."""
    start, first = cell_start(grid), grid.ring.start[collars.limb]
    low, high = start[first], start[first + skirt_rings(collars)]
    count = np.where(joined, high - low, 0)
    return np.repeat(low - np.cumsum(count) + count, count) + np.arange(count.sum())


def joint_skin(
    grid: Grid,
    x: Float[np.ndarray, "vertex 3"],
    normal: Float[np.ndarray, "vertex 3"],
    bark: Barks,
    collars: Collars,
    o: Outlines,
    hole: Holes,
    bridge: Bridges,
    feet: tuple[Float[np.ndarray, "corner 3"], Float[np.ndarray, "corner 3"]],
    stored: StoredRings,
    total: int,
) -> tuple[Vertices, Int[np.ndarray, "triangle 3"]]:
    """Bridges and skirts: vertices that come after the `total` of the tubes, and triangles; `feet` are the outlines' corners
    and their normals."""
    corner, beyond = _loop_vertices(grid, x, normal, bark, hole, stored, total)
    lowest = _lowest(hole)
    base = total + len(beyond.limb)
    foot = _on_parent(grid, bark, o, hole, lowest, np.arange(len(o.theta)), o.theta, o.s, *feet)
    skirt, skirts = _skirts(grid, x, normal, bark, collars, o, hole, bridge, lowest, base)
    corner = np.r_[corner, base + np.arange(len(o.theta))]
    parts = [beyond, foot, skirt]
    bridging = corner[bridge.triangle]
    over, bridging = _over_seam(grid, x, normal, bark, o, hole, bridge, lowest, bridging, foot, base, base + len(foot.limb) + len(skirt.limb))
    parts.append(over)
    return Vertices(*(np.concatenate(column) for column in zip(*parts, strict=True))), np.concatenate([bridging, skirts])


def _lowest(hole: Holes):
    """The lowest ring of each hole."""
    loop_hole = np.repeat(hole.of_loop, np.diff(hole.start))
    lowest = np.full(len(hole.limb), np.iinfo(np.int64).max)
    np.minimum.at(lowest, loop_hole, hole.ring)
    return lowest


def _loop_vertices(grid: Grid, x, normal, bark: Barks, hole: Holes, stored: StoredRings, total: int):
    """The vertex of every corner of the loops, and those vertices that the grid lacks."""
    loop_hole = np.repeat(hole.of_loop, np.diff(hole.start))
    limb, n, lowest = hole.limb[loop_hole], grid.columns[hole.ring], _lowest(hole)
    beyond = (hole.column < 0) | (hole.column > n)
    copy = np.where(hole.ring == lowest[loop_hole], stored.upper[hole.ring], stored.lower[hole.ring])
    corner = stored.first[copy] + hole.column
    corner[beyond] = total + np.arange(beyond.sum())
    ring, column, limb, n = hole.ring[beyond], hole.column[beyond], limb[beyond], n[beyond]
    vertex = grid.first[ring] + ((column % n) << grid.level[ring])
    u = bark.offset[limb, 0] + bark.repeat[lowest[loop_hole[beyond]]] * column / n
    return corner, Vertices(x[vertex], normal[vertex], np.stack([u, bark.offset[limb, 1] - bark.along[ring]], axis=1), limb)


def _on_parent(grid: Grid, bark: Barks, o: Outlines, hole: Holes, lowest, corner, theta, s, position, normal) -> Vertices:
    """Vertices with the parent's bark at (θ, s), which belong to these corners of the outlines."""
    fork = o.of_corner[corner]
    parent, h = o.parent[fork], hole.of_fork[fork]
    j, up = grid.row(parent, s)
    along = (1 - up) * bark.along[j] + up * bark.along[j + 1]
    u = bark.offset[parent, 0] + bark.repeat[lowest[h]] * (theta / (2.0 * np.pi) + hole.turns[fork])
    return Vertices(position, normal, np.stack([u, bark.offset[parent, 1] - along], axis=1), parent)


def _skirts(grid: Grid, x, normal, bark: Barks, collars: Collars, o: Outlines, hole: Holes, bridge: Bridges, lowest, base: int):
    """The lower halves of the bows; their first rings are the outlines' vertices, which start at `base`."""
    rows = np.where(bridge.bridged[hole.of_fork], skirt_rings(collars), 0)
    fork = o.of_corner
    corner = np.flatnonzero(rows[fork] > 0)
    count = rows[fork[corner]]
    each = np.repeat(corner, count)
    row = 1 + np.arange(len(each)) - np.repeat(np.cumsum(count) - count, count)
    t = row / np.maximum(bow_rings(collars.size)[fork[each]] - 1, 1)
    lift = (2 * t * (1 - t))[:, None] * o.rise[0, each] + (t**2)[:, None] * o.rise[1, each]
    within = each - o.start[fork[each]]
    vertex = grid.first[grid.ring.start[o.limb[fork[each]]] + row] + within
    made = _on_parent(grid, bark, o, hole, lowest, each, o.theta[each] + lift[:, 0], o.s[each] + lift[:, 1], x[vertex], normal[vertex])
    place = np.full(len(fork), -1)
    place[corner] = base + len(fork) + np.cumsum(count) - count  # of the first vertex over each corner
    after = np.arange(1, len(fork) + 1)
    after[o.start[1:] - 1] = o.start[:-1]
    a = np.where(row == 1, base + each, place[each] + row - 2)
    b = np.where(row == 1, base + after[each], place[after[each]] + row - 2)
    d, c = place[each] + row - 1, place[after[each]] + row - 1
    return made, np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)


def _over_seam(grid: Grid, x, normal, bark: Barks, o: Outlines, hole: Holes, bridge: Bridges, lowest, triangle, foot: Vertices, base: int, total: int):
    """In holes that go all round, corners of triangles that lie across the seam from their first one get vertices of their own."""
    rows = np.flatnonzero(hole.around[bridge.hole])
    theta = np.r_[2.0 * np.pi * hole.column / grid.columns[hole.ring], o.theta]
    corner = bridge.triangle[rows]
    turn = np.round((theta[corner[:, :1]] - theta[corner]) / (2.0 * np.pi)).astype(np.int64)
    at = np.flatnonzero(turn.ravel())
    where, wanted = corner.ravel()[at], turn.ravel()[at]
    key, first, copy = np.unique(where * 64 + wanted, return_index=True, return_inverse=True)
    where, wanted = where[first], wanted[first]
    h = bridge.hole[rows][at[first] // 3]
    triangle = triangle.copy()
    changed = triangle[rows].ravel()
    changed[at] = total + copy.reshape(-1)
    triangle[rows] = changed.reshape(-1, 3)
    loop = where < len(hole.ring)
    k = np.where(loop, where, 0)
    ring, column = hole.ring[k], hole.column[k]
    f = np.where(loop, 0, where - len(hole.ring))
    limb = hole.limb[h]
    vertex = grid.first[ring] + ((column % grid.columns[ring]) << grid.level[ring])
    pick = lambda own, other: np.where(loop[:, None], own, other)  # noqa: E731
    u = bark.offset[limb, 0] + bark.repeat[lowest[h]] * column / grid.columns[ring]
    uv = pick(np.stack([u, bark.offset[limb, 1] - bark.along[ring]], axis=1), foot.uv[f])
    uv[:, 0] += bark.repeat[lowest[h]] * wanted
    return Vertices(pick(x[vertex], foot.position[f]), pick(normal[vertex], foot.normal[f]), uv, limb), triangle
