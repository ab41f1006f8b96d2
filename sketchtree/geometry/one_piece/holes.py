"""Which part of a parent's grid makes way for the limbs that grow out of it?

Every outline takes the block of cells that its box, with a margin, touches. Blocks that share cells become one hole. Its
boundary is a loop along edges of the grid, listed counter-clockwise as (ring, column) with columns unwrapped. A hole that goes all
round the limb is cut open along a column that no outline crosses; where there is none, it has two loops, one at either end.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from sketchtree.geometry.one_piece.grid import Grid
from sketchtree.geometry.one_piece.loops import free_column, loops_round, unrolled
from sketchtree.geometry.one_piece.outlines import Outlines

_MARGIN = 0.25  # between outline and hole, at least, / lesser half axis of the outline


@dataclass(frozen=True, eq=False)
class Blocks:
    """Rows `low` to `high` (rings) and, once the columns are known, `west` to `east`, of each fork."""

    low: Int[np.ndarray, " fork"]
    high: Int[np.ndarray, " fork"]


@dataclass(frozen=True, eq=False)
class Holes:
    """Holes with their boundaries, ragged: loop l owns `start[l]:start[l + 1]`."""

    of_fork: Int[np.ndarray, " fork"]  # hole of each fork
    turns: Int[np.ndarray, " fork"]  # whole turns to add to a fork's θ, so that it lies within its hole's columns
    around: Bool[np.ndarray, " hole"]  # it goes all round the limb, uncut
    limb: Int[np.ndarray, " hole"]
    of_loop: Int[np.ndarray, " loop"]  # hole of each loop
    start: Int[np.ndarray, " loop+1"]
    ring: Int[np.ndarray, " corner"]
    column: Int[np.ndarray, " corner"]  # unwrapped
    cell: Int[np.ndarray, " cell"]  # covered cells, as numbered by `cell_start`
    hole_of_cell: Int[np.ndarray, " cell"]


def margins(o: Outlines) -> np.ndarray:
    """What a hole leaves round each outline, at least, metres."""
    west, east, low, high = o.box()
    return _MARGIN * np.minimum(0.5 * (east - west) * o.thick, 0.5 * (high - low))


def rows_of(grid_ring, of_ring, o: Outlines, first: Int[np.ndarray, " limb"], last: Int[np.ndarray, " limb"]) -> Blocks:
    """The rings between which each outline lies; no lower than `first` and no higher than `last` of its parent."""
    _, _, low, high = o.box()
    margin = margins(o)
    stride = 2.0 * float(grid_ring.s.max(initial=0.0)) + 1.0
    place = of_ring * stride + grid_ring.s
    below = np.searchsorted(place, o.parent * stride + np.maximum(low - margin, 0.0), side="right") - 1
    above = np.searchsorted(place, o.parent * stride + high + margin, side="left")
    return Blocks(np.clip(below, first[o.parent], last[o.parent] - 1), np.clip(above, first[o.parent] + 1, last[o.parent]))


def inside(blocks: Blocks, rings: int) -> tuple[Bool[np.ndarray, " ring"], Bool[np.ndarray, " ring"]]:
    """Rings inside blocks; and rings whose step from the ring below is in a block."""
    count = np.zeros(rings + 1, np.int64)
    np.add.at(count, blocks.low + 1, 1)
    np.add.at(count, blocks.high, -1)
    within = np.cumsum(count)[:-1] > 0
    count = np.zeros(rings + 2, np.int64)
    np.add.at(count, blocks.low + 1, 1)
    np.add.at(count, blocks.high + 1, -1)
    return within, np.cumsum(count)[:rings] > 0


def cell_start(grid: Grid) -> Int[np.ndarray, " ring+1"]:
    """The number of the first cell above each ring."""
    return np.r_[0, np.cumsum(grid.columns)].astype(np.int64)


def holes(grid: Grid, o: Outlines, blocks: Blocks) -> Holes:
    """The holes for all outlines."""
    west, east, _, _ = o.box()
    n = grid.columns[blocks.low]
    margin = margins(o) / o.thick
    left = np.floor((west - margin) * n / (2.0 * np.pi)).astype(np.int64)
    right = np.ceil((east + margin) * n / (2.0 * np.pi)).astype(np.int64)
    width, height = np.minimum(right - left, n), blocks.high - blocks.low
    fork, cell, row, column = _cells(grid, blocks, left, width, height)
    _, of_fork = connected_components(_sharing(fork, cell, len(left)), directed=False)
    single = (np.bincount(of_fork)[of_fork] == 1) & (width < n)
    plain = _rectangles(blocks, left, width, height, np.flatnonzero(single))
    traced = _traced(grid, of_fork, left, single, fork, row, column, o)
    turns, around = np.zeros(len(left), np.int64), np.zeros(of_fork.max(initial=-1) + 1, bool)
    loops = [(of_fork[f], *corners) for f, corners in plain]
    for hole, corners, goes_round, turned in traced:
        around[hole] = goes_round
        loops += [(hole, *loop) for loop in corners]
        for f, turn in turned.items():
            turns[f] = turn
    limb = np.zeros(len(around), np.int64)
    limb[of_fork] = o.parent
    unique, at = np.unique(cell, return_index=True)
    counts = [len(ring) for _, ring, _ in loops]
    return Holes(
        of_fork, turns, around, limb,
        np.array([hole for hole, _, _ in loops], np.int64), np.r_[0, np.cumsum(counts)].astype(np.int64),
        np.concatenate([ring for _, ring, _ in loops] or [np.zeros(0, np.int64)]),
        np.concatenate([column for _, _, column in loops] or [np.zeros(0, np.int64)]),
        unique, of_fork[fork[at]],
    )  # fmt: skip


def _cells(grid: Grid, blocks: Blocks, left, width, height):
    """Every cell of every block: fork, number, ring below, column (wrapped)."""
    size = width * height
    fork = np.repeat(np.arange(len(size)), size)
    within = np.arange(size.sum()) - np.repeat(np.cumsum(size) - size, size)
    row = blocks.low[fork] + within // width[fork]
    column = (left[fork] + within % width[fork]) % grid.columns[row]
    return fork, cell_start(grid)[row] + column, row, column


def _sharing(fork, cell, count: int):
    """Which forks share cells, as a graph from each fork to the first that has the cell."""
    order = np.lexsort((fork, cell))
    cell, fork = cell[order], fork[order]
    same = np.flatnonzero(np.diff(cell) == 0)
    return coo_matrix((np.ones(len(same)), (fork[same], fork[same + 1])), shape=(count, count))


def _rectangles(blocks: Blocks, left, width, height, forks):
    """The loop round each single block."""
    for f in forks.tolist():
        a, b, c, d = int(blocks.low[f]), int(blocks.high[f]), int(left[f]), int(left[f] + width[f])
        rings = [a] * (d - c) + list(range(a, b)) + [b] * (d - c) + list(range(b, a, -1))
        columns = list(range(c, d)) + [d] * (b - a) + list(range(d, c, -1)) + [c] * (b - a)
        yield f, (np.array(rings), np.array(columns))


def _traced(grid: Grid, of_fork, left, single, fork, row, column, o: Outlines):
    """Loops of the holes of several blocks, or that go round: hole, loops, whether it goes round, turns of its forks."""
    rest = np.flatnonzero(~single[fork])
    order = rest[np.argsort(of_fork[fork[rest]], kind="stable")]
    west, east, _, _ = o.box()
    for some in np.split(order, np.flatnonzero(np.diff(of_fork[fork[order]])) + 1) if len(order) else []:
        cells = set(zip(row[some].tolist(), column[some].tolist(), strict=True))
        n = int(grid.columns[row[some[0]]])
        forks, first = np.unique(fork[some], return_index=True)
        placed = unrolled(cells, n)
        if placed is not None:
            homes = [placed[cell] for cell in zip(row[some[first]].tolist(), column[some[first]].tolist(), strict=True)]
            turns = (np.array(homes) - left[forks]) // n
        else:
            scale = n / (2.0 * np.pi)
            cut = free_column(west[forks] * scale, east[forks] * scale, n)
            if cut is not None:
                placed = {(j, c): c if c >= cut else c + n for j, c in cells}
                turns = -np.floor((0.5 * (west + east)[forks] * scale - cut) / n).astype(np.int64)
        goes_round = placed is None
        loops = loops_round(cells, n) if goes_round else loops_round({(j, c) for (j, _), c in placed.items()}, None)
        yield int(of_fork[forks[0]]), loops, goes_round, {} if goes_round else dict(zip(forks.tolist(), turns.tolist(), strict=True))
