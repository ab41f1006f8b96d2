"""What bounds a set of cells on a limb?

Cells are pairs (ring below, column to the west), columns modulo n round the limb. Their boundary is walked edge by edge with the
cells to its left, as (ring, column) of each corner.
"""

import numpy as np
from jaxtyping import Float, Int

Cell = tuple[int, int]
_MARGIN = 0.15  # of a column, between an outline and a cut


def unrolled(cells: set[Cell], n: int) -> dict[Cell, int] | None:
    """Columns without a jump from one cell to the next; None where going round leads back to a cell."""
    begin = min(cells)
    found, waiting = {begin: begin[1]}, [begin]
    while waiting:
        j, c = cell = waiting.pop()
        for dj, dc in ((0, 1), (0, -1), (1, 0), (-1, 0)):
            other = (j + dj, (c + dc) % n)
            if other not in cells:
                continue
            if other not in found:
                found[other] = found[cell] + dc
                waiting.append(other)
            elif found[other] != found[cell] + dc:
                return None
    return found


def free_column(west: Float[np.ndarray, " outline"], east: Float[np.ndarray, " outline"], n: int) -> int | None:
    """A column, 0 to n − 1, that lies outside all outlines from `west` to `east` (in columns, unwrapped), or None."""
    column = np.arange(n)[:, None]
    past = (column - (west - _MARGIN)) % n
    free = (past >= east - west + 2 * _MARGIN).all(axis=1) & (east - west + 2 * _MARGIN < n).all()
    return int(np.argmax(free)) if free.any() else None


def loops_round(cells: set[Cell], n: int | None) -> list[tuple[Int[np.ndarray, " corner"], Int[np.ndarray, " corner"]]]:
    """The boundary of a set of cells, counter-clockwise seen from outside; columns are taken modulo n, if given."""
    wrap = (lambda c: c % n) if n else (lambda c: c)
    following = _edges(cells, wrap)
    loops = []
    while following:
        begin = at = min(following)
        rings, columns, out, left_behind = [], [], None, None
        while at in following and not (at == begin and out is not None and _LEFT[out] == left_behind):
            ways = following[at]
            k = next((k for k, way in enumerate(ways) if out and way[2:] == _LEFT[out]), 0)
            j, c, *step = ways.pop(k)
            if not ways:
                del following[at]
            rings.append(at[0])
            columns.append(at[1])
            at, out = (j, c), tuple(step)
            left_behind = left_behind or out
        loops.append((np.array(rings), np.array(columns)))
    return loops


# Where two cells meet at a corner only, a loop that comes along one of them (its outside that way) goes on round the same one.
_LEFT = {(-1, 0): (0, 1), (0, 1): (1, 0), (1, 0): (0, -1), (0, -1): (-1, 0)}


def _edges(cells: set[Cell], wrap) -> dict[Cell, list[tuple[int, int, int, int]]]:
    """From each corner the edges of the boundary that begin there: where they end, and which way the outside is."""
    following: dict[Cell, list] = {}
    for j, c in sorted(cells):
        for (dj, dc), begin, end in (
            ((-1, 0), (j, c), (j, c + 1)),
            ((0, 1), (j, c + 1), (j + 1, c + 1)),
            ((1, 0), (j + 1, c + 1), (j + 1, c)),
            ((0, -1), (j + 1, c), (j, c)),
        ):
            if (j + dj, wrap(c + dc)) not in cells:
                following.setdefault((begin[0], wrap(begin[1])), []).append((end[0], wrap(end[1]), dj, dc))
    return following
