"""Where do the rings of a tree stand that is to be one piece, and where on them do its limbs grow out of each other?

    lines → collars → rings → outlines, moved apart → rings once more, with one below and one above every outline → sides → blocks

Within the block of cells that makes way for a limb neither the sides of the rings nor the repeat of the bark change.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.one_piece.apart import apart
from sketchtree.geometry.one_piece.grid import Grid, circles
from sketchtree.geometry.one_piece.holes import inside, margins, rows_of
from sketchtree.geometry.one_piece.outlines import Collars, Outlines, collars_of, outlines
from sketchtree.geometry.resolution import halvings, one_at_a_time, sides
from sketchtree.geometry.rings import Forks, rings

_SLENDER = 45.0  # farthest two rings stand apart, / radius
_BESIDE = 1.8  # where a fork's own rings stand, / margin of its hole
_SHIFTED = 0.25  # an outline that moved farther has a longer collar, / radius of the limb
_LONGER = 1.5  # by so many times as far as it moved
_SHOULDER = 0.4  # from a collar's shoulder to its top, about, / the same
_CLOSE = 1.2  # how far other rings keep away from them, / the same


@dataclass(frozen=True, eq=False)
class Plan:
    """Rings, and outlines on them."""

    grid: Grid
    collars: Collars
    outlines: Outlines
    profile: Float[np.ndarray, "3 corner 3"]  # A, F and C of each corner, see `outlines`
    first: Int[np.ndarray, " limb"]  # lowest ring of each limb that a hole may touch
    last: Int[np.ndarray, " limb"]  # … highest
    inside: Bool[np.ndarray, " ring"]  # within a block: the bark's repeat doesn't change there


def plan_one_piece(lines: CentreLines, detail: Detail, height: float) -> Plan:
    """Everything but the triangles; `lines` have one limb without a parent a piece, `height` is the tree's, metres."""
    tolerance = detail.tolerance * height
    foot = sides(lines.radius[lines.start[:-1]], tolerance, detail)
    collars = collars_of(lines, foot, detail, height)
    top, size = np.zeros(len(lines)), np.ones(len(lines), np.int64)
    top[collars.limb], size[collars.limb] = collars.top, collars.size
    ring = rings(lines, top, size, detail, height, slender=_SLENDER, forks=_NONE)
    side, level = _sides(ring, foot, size, tolerance, detail)
    grid = Grid.of(ring, side, level)
    alone, profile = outlines(lines, grid, circles(grid, lines, 0.0), collars)
    room = 0.25 * np.minimum(lines.length - top, lines.radius[lines.start[:-1]])
    moved, _ = apart(alone, top + 0.6 * room, lines.length - 0.6 * room)
    collars = _eased(collars, alone, moved, lines)
    top[collars.limb] = collars.top
    ring = rings(lines, top, size, detail, height, slender=_SLENDER, forks=_wanted(moved, lines))
    first = ring.start[:-1] + size - 1
    last = np.searchsorted(ring.limb * _stride(ring) + ring.s, np.arange(len(lines)) * _stride(ring) + lines.length * (1 + 1e-12), side="right") - 1
    blocks = rows_of(ring, ring.limb, moved, first, last)
    within, step = inside(blocks, len(ring.s))
    level = _levels(ring, side, size, step, tolerance, detail)
    return Plan(Grid.of(ring, side, level), collars, moved, profile, first, last, within)


def _eased(collars: Collars, alone: Outlines, moved: Outlines, lines: CentreLines) -> Collars:
    """Longer collars for the limbs whose outlines had to move, so that the surface does not hang over;
    not beyond half the way to what stands on them."""
    (west, east, low, high), (west_, east_, low_, high_) = alone.box(), moved.box()
    far = np.hypot(0.5 * (west_ + east_ - west - east) * alone.thick, 0.5 * (low_ + high_ - low - high))
    far = np.where((collars.size > 2) & (far > _SHIFTED * alone.thin), far, 0.0)
    free = 0.85 * lines.length
    np.minimum.at(free, moved.parent, low_ - margins(moved) * (1.0 + _BESIDE))
    longer = np.clip(0.5 * (free[collars.limb] - collars.top), 0.0, _LONGER * far)
    return replace(collars, top=collars.top + longer, ease=longer / (longer + _SHOULDER * alone.thin))


_NONE = Forks(np.zeros(0, np.int64), np.zeros(0), np.zeros(0))


def _stride(ring) -> float:
    return 2.0 * float(ring.s.max(initial=0.0)) + 1.0


def _wanted(o: Outlines, lines: CentreLines) -> Forks:
    """A ring below and one above every outline, unless the limb ends about there."""
    _, _, low, high = o.box()
    margin = np.r_[margins(o), margins(o)]
    limb, s = np.r_[o.parent, o.parent], np.r_[low, high] + _BESIDE * margin * np.repeat([-1.0, 1.0], len(low))
    on = (s > margin) & (s < lines.length[limb] - margin)
    return Forks(limb[on], s[on], _CLOSE * margin[on])


def _sides(ring, foot, size, tolerance: float, detail: Detail):
    needed = np.minimum(sides(ring.radius, tolerance, detail), foot[ring.limb])
    return halvings(needed, size, ring.start, detail.most_sides)


def _levels(ring, side, size, step_in_block, tolerance: float, detail: Detail):
    """Halvings of limbs that have `side` columns at their feet: none within collars and blocks."""
    limb = ring.limb
    within = np.arange(len(limb)) - ring.start[:-1][limb]
    needed = np.maximum(sides(ring.radius, tolerance, detail), 3)
    wanted = np.zeros(len(limb), np.int64)
    for halving in range(1, 8):
        able = (side[limb] % (1 << halving) == 0) & (side[limb] >> halving >= needed)
        wanted[able] = halving
    wanted[within < size[limb]] = 0
    free = ~step_in_block
    count = np.cumsum(free)
    count -= count[ring.start[:-1]][limb]
    return one_at_a_time(_rising(wanted, limb), count, limb)


def _rising(wanted, limb):
    """The halvings made to rise only: the least of each ring and those beyond it."""
    stride = int(wanted.max(initial=0)) + 1
    back = (wanted + limb * stride)[::-1]
    return np.minimum.accumulate(back)[::-1] - limb * stride


