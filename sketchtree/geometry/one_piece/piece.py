"""What surface is a tree's wood in one closed piece?

The limbs' tubes, open at their feet, have holes where others grow out of them (`holes`); triangles join each hole to the first
rings of the limbs in it (`bridge`). Both sides of such a joint have vertices of their own, for the bark of each; they share
position and normal, so that the wood is closed when welded and the light does not break. Lids close the feet of stems.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.one_piece.bows import bow, lengthwise_in_collars
from sketchtree.geometry.one_piece.bridge import Bridges, bridges, regions
from sketchtree.geometry.one_piece.distinct import distinct
from sketchtree.geometry.one_piece.grid import Grid, circles, normals
from sketchtree.geometry.one_piece.holes import Holes, cell_start, holes, rows_of
from sketchtree.geometry.one_piece.joint_skin import Barks, Vertices, joint_skin, skirt_cells
from sketchtree.geometry.one_piece.outlines import Collars, Outlines
from sketchtree.geometry.one_piece.plan import Plan, plan_one_piece
from sketchtree.geometry.stitch import StoredRings, Surface, fan, sides, stored_rings
from sketchtree.geometry.unwrap import circumference, lengthwise, pace, repeats

_TRIES, _SMALLER = 6, 0.7


@dataclass(frozen=True, eq=False)
class Piece:
    """The whole wood, and whose each vertex and triangle is."""

    surface: Surface
    of_vertex: Int[np.ndarray, " vertex"]  # limb
    of_triangle: Int[np.ndarray, " triangle"]  # limb
    sunk: Int[np.ndarray, " limb"]  # limbs that could not be joined: closed tubes that stand inside their parents

    def part(self, among: Bool[np.ndarray, " limb"]) -> Surface:
        """What belongs to the limbs `among` all."""
        keep = among[self.of_vertex]
        renumber = np.cumsum(keep) - 1
        s = self.surface
        return Surface(s.position[keep], s.normal[keep], s.uv[keep], renumber[s.triangle[among[self.of_triangle]]])


def within_budget(lines: CentreLines, offset: Float[np.ndarray, "limb 2"], detail: Detail, height: float) -> Piece:
    """The piece, made coarser until it has no more than `detail.most_triangles`; `height` is the tree's, metres."""
    most = detail.most_triangles
    while True:
        piece = one_piece(plan_one_piece(lines, detail, height), lines, offset, detail)
        count = len(piece.surface.triangle)
        if count <= most or detail.is_coarsest:
            return piece
        detail = detail.coarser(max(1.5, count / most))


def one_piece(plan: Plan, lines: CentreLines, offset: Float[np.ndarray, "limb 2"], detail: Detail) -> Piece:
    """The surface of the wood planned; `offset` shifts the bark of each limb (tiles)."""
    grid, collars = plan.grid, plan.collars
    outlines, hole, bridge = _joined(plan)
    x = circles(grid, lines, detail.flare)
    fork = outlines.of_corner
    (corner,) = grid.at(outlines.parent[fork], outlines.theta, outlines.s, x)
    bow(grid, x, collars, outlines, corner, plan.profile)
    normal = normals(grid, x)
    (lit,) = grid.at(outlines.parent[fork], outlines.theta, outlines.s, normal)
    lit /= np.maximum(np.linalg.norm(lit, axis=1, keepdims=True), 1e-300)
    _light_feet(grid, normal, collars, outlines, lit)
    x = distinct(x, normal)
    corner = x[grid.first[grid.ring.start[outlines.limb]][fork] + np.arange(len(fork)) - outlines.start[fork]]
    bark = _barks(grid, plan, offset, detail.tile)
    v = bark.along[grid.of_vertex].copy()
    lengthwise_in_collars(grid, x, v, bark.pace, collars)
    return _skin(grid, x, normal, v, bark, collars, outlines, hole, bridge, (corner, lit), lines, detail.tile)


def _joined(plan: Plan) -> tuple[Outlines, Holes, Bridges]:
    """Outlines, holes and their bridges. Outlines that don't fit into their holes are made smaller."""
    o = _fitted(plan)
    for _ in range(_TRIES):
        hole = _holes(plan, o)
        bridge = bridges(plan.grid, o, hole)
        if bridge.bridged.all():
            break
        o = _smaller(o, ~bridge.bridged[hole.of_fork])
    return o, hole, bridge


def _fitted(plan: Plan) -> Outlines:
    """The outlines, those made smaller whose holes could not be triangulated at all."""
    o, fork = plan.outlines, np.arange(len(plan.outlines.limb))
    for _ in range(_TRIES if len(fork) else 0):
        some = o.only(fork)
        hole = _holes(plan, some)
        fork = fork[~regions(plan.grid, some, hole).sound[hole.of_fork]]
        if len(fork) == 0:
            break
        o = _smaller(o, np.isin(np.arange(len(o.limb)), fork))
    return o


def _smaller(o: Outlines, some) -> Outlines:
    """The outlines `some` made smaller in place."""
    west, east, low, high = o.box()
    scale = np.where(some, _SMALLER, 1.0)
    return o.moved(0.5 * (west + east), 0.5 * (low + high), scale, scale)


def _holes(plan: Plan, o: Outlines) -> Holes:
    return holes(plan.grid, o, rows_of(plan.grid.ring, plan.grid.of_ring, o, plan.first, plan.last))


def _light_feet(grid: Grid, normal, collars, outlines: Outlines, lit) -> None:
    """The parent's normals at the foot of each collar, most of them one ring further up where the collar has more."""
    first = grid.ring.start[outlines.limb]
    fork = outlines.of_corner
    within = np.arange(len(fork)) - outlines.start[fork]
    normal[grid.first[first][fork] + within] = lit
    more = (collars.size > 2)[fork]
    above = (grid.first[first + 1][fork] + within)[more]
    bent = normal[above] + 0.7 * lit[more]
    normal[above] = bent / np.maximum(np.linalg.norm(bent, axis=1, keepdims=True), 1e-12)


def _barks(grid: Grid, plan: Plan, offset, tile: float) -> Barks:
    """As on tubes, but where repeats would change within a block they do so above it."""
    ring = grid.ring
    around = circumference(ring, grid.columns)
    repeat = repeats(ring, around, tile)
    free = np.where(plan.inside, 0, np.arange(len(repeat)))
    repeat = repeat[np.maximum.accumulate(free)]
    return Barks(offset, repeat, pace(ring, around, repeat, tile), lengthwise(ring, around, repeat, tile))


def _skin(grid: Grid, x, normal, v, bark: Barks, collars: Collars, o: Outlines, hole: Holes, bridge: Bridges, feet, lines: CentreLines, tile: float) -> Piece:
    """All vertices and triangles."""
    changed = np.r_[False, (np.diff(bark.repeat) != 0) & (np.diff(grid.of_ring) == 0)]
    stored = stored_rings(changed, grid.level, grid.side)
    used = bark.repeat[stored.source].copy()
    twice = np.flatnonzero(stored.upper != stored.lower)
    used[stored.lower[twice]] = bark.repeat[twice - 1]
    at = np.repeat(stored.source, stored.side + 1)
    vertex = grid.first[at] + stored.column % grid.side[at]
    limb = grid.of_ring[at]
    u = bark.offset[limb, 0] + np.repeat(used, stored.side + 1) * stored.column / grid.side[at]
    tubes = Vertices(x[vertex], normal[vertex], np.stack([u, bark.offset[limb, 1] - v[vertex]], axis=1), limb)
    joints, joint = joint_skin(grid, x, normal, bark, collars, o, hole, bridge, feet, stored, len(limb))
    covered = np.zeros(cell_start(grid)[-1], bool)
    covered[hole.cell[bridge.bridged[hole.hole_of_cell]]] = True
    covered[skirt_cells(grid, collars, bridge.bridged[hole.of_fork])] = True
    tube = sides(stored, grid.ring.start, covered)
    sunk = o.limb[~bridge.bridged[hole.of_fork]]
    lidded = np.sort(np.r_[np.flatnonzero(lines.parent == NULL), sunk])
    ends, end = _ends(grid, x, stored, lidded, tubes.uv, len(limb) + len(joints.limb), tile)
    position, normal, uv, of_vertex = (np.concatenate(column) for column in zip(tubes, joints, ends, strict=True))
    triangle = np.concatenate([tube, joint, end])
    return Piece(Surface(position, normal, uv, triangle), of_vertex, of_vertex[triangle[:, 2]], sunk)


def _ends(grid: Grid, x, stored: StoredRings, lidded, uv, total: int, tile: float):
    """Lids of the limbs `lidded` and apexes of all, with their triangles."""
    ring = grid.ring
    first, last = ring.start[lidded], ring.start[1:] - 1
    low, high = stored.lower[first], stored.upper[last]
    mean = np.add.reduceat(x, grid.first[:-1])[first] / grid.side[first][:, None] if len(first) else np.zeros((0, 3))
    apex = ring.point[last] + 0.5 * ring.radius[last][:, None] * ring.tangent[last]
    place = np.concatenate([0.5 * (uv[stored.first[end]] + uv[stored.first[end + 1] - 1]) for end in (low, high)])
    place[: len(first), 1] += ring.radius[first] / tile
    place[len(first) :, 1] -= ring.radius[last] / tile
    limb = np.r_[lidded, np.arange(len(last))]
    vertices = (np.concatenate([mean, apex]), np.concatenate([-ring.tangent[first], ring.tangent[last]]), place, limb)
    centre = total + np.arange(len(limb))
    return Vertices(*vertices), np.concatenate([fan(stored, low, centre[: len(first)])[:, [1, 0, 2]], fan(stored, high, centre[len(first) :])])
