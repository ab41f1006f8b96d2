"""How many triangles is each limb worth?

Every limb can be left out, drawn as a spike of three triangles, or as a tube of k of its rings with n sides. What a choice gets wrong is counted as
the area by which the limb's outline moves, seen from the side and averaged over all sides:

    left out      A = 2 r̄ L                          no triangle
    spike         A = L r̄                            3 triangles
    tube          A = 2 L (ē_k + w r̄)                2 n (k − 1) + n − 2 triangles

    L, r̄   length and mean radius     ē_k   mean distance of the full tree's rings from the polyline through k of them (radius as a fourth axis)
    w      mean of |h_n − h_m| over the directions; m: sides on the full tree; h_n(φ) = R_n cos((φ mod 2π/n) − π/n): how far a polygon reaches

A polygon of n sides is as wide on average as the full tree's of m sides and radius r (Cauchy: the mean width is the perimeter / π) with

    R_n = r q_m / q_n        q_n = n sin(π / n) / π

Where it is asked how near the surface stays, as of wood that was measured, D + A is counted instead of A, with D how far the limb's surface lies off what is drawn, times its length:

    left out      D = L (L / 4 + r̄)                  all of it lies as far off as what bears it is, at an angle of 30°
    spike         D = L (ē_2 + r̄ / 2)
    tube          D = L (ē_k + w r̄)

so that a long thin limb is worth more than its outline, and a crooked one is no spike.

Given a number of triangles, each limb takes the choice of least A + λ · triangles (or D + A), with one λ for all: at the optimum another triangle buys
the same everywhere (Everett 1963, "Generalized Lagrange multiplier method"). λ is found by bisection. A limb that bears one that is drawn is drawn.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.rings import Rings
from sketchtree.geometry.simplify import enough

SIDES = (3, 4, 6, 8, 12, 16)
_FINENESS = (0.0, 0.12, 0.3, 0.7, 1.6, 4.0)  # tolerances tried for the line of a limb, / its mean radius
_SEARCHES = 60
_HANGS = 0.25  # how far a limb's middle lies off what bears it, of its length: half the sine of 30°


@dataclass(frozen=True, eq=False)
class Shapes:
    """What is drawn of every limb."""

    kept: Bool[np.ndarray, " ring"]  # rings of the full tree that stay; none of limbs that are left out
    side: Int[np.ndarray, " limb"]  # of the rings; 0: left out
    spike: Bool[np.ndarray, " limb"]  # foot and tip only, and pointed
    triangles: int


def circumradius(side: Int[np.ndarray, " limb"], full: Int[np.ndarray, " limb"]) -> Float[np.ndarray, " limb"]:
    """R_n / r: what makes polygons of `side` sides as wide as the full tree's of `full` sides."""
    return _width(full) / _width(np.maximum(side, 3))


def _width(side):
    return side * np.sin(np.pi / side) / np.pi


@lru_cache(maxsize=512)
def roughness(side: int, full: int) -> float:
    """w / r; both polygons start at the same corner."""
    around = (np.arange(2000) + 0.5) / 2000 * 2.0 * np.pi
    own, other = (
        size * np.cos((around + np.pi / n) % (2.0 * np.pi / n) - np.pi / n) for n, size in ((side, _width(full) / _width(side)), (full, 1.0))
    )
    return float(np.mean(np.abs(own - other)))


@dataclass(frozen=True, eq=False)
class Choices:
    """The choices of every limb; column 0 leaves it out, 1 is the spike."""

    wrong: Float[np.ndarray, "limb choice"]  # metres²
    cost: Int[np.ndarray, "limb choice"]  # triangles
    fineness: Int[np.ndarray, " choice"]  # which of `kept`; NULL for the first two
    side: Int[np.ndarray, " choice"]
    kept: list  # rings kept at each fineness


def choose_shapes(ring: Rings, choices: Choices, parent: Int[np.ndarray, " limb"], weight: Float[np.ndarray, " limb"], budget: int) -> Shapes:
    """The best shapes of all limbs with at most `budget` triangles.

    `choices` are those of the limbs (`choices_of`); `weight` says how much of each limb is seen (0-1). A limb weighs a little even so: hidden
    wood goes first, but not all of it. Fewer triangles than asked for may come out.
    """
    wrong = choices.wrong * np.maximum(weight, 1e-6)[:, None]
    rows = np.arange(len(wrong))
    high = 2.0 * float(wrong.max(initial=0.0)) + 1e-12
    low, best = 1e-12 * high, np.zeros(len(wrong), np.int64)
    for _ in range(_SEARCHES):
        price = np.sqrt(low * high)
        picked = _picked(parent, choices, wrong, price)
        if int(choices.cost[rows, picked].sum()) <= budget:
            high, best = price, picked
        else:
            low = price
        if high / low < 1.0005:
            break
    return _shapes(ring, choices, best)


def choices_of(ring: Rings, full: Int[np.ndarray, " limb"], surface: bool = False) -> Choices:
    """What every limb can be drawn as; on the full tree the limbs have `full` sides. `surface`: it counts how near that stays, not the outline alone."""
    limb, count = ring.limb, len(full)
    ends = np.zeros(len(limb), bool)
    ends[ring.start[:-1]] = ends[ring.start[1:] - 1] = True
    length = ring.s[ring.start[1:] - 1] - ring.s[ring.start[:-1]]
    share = _shares(ring)
    mean = np.bincount(limb, share * ring.radius, count)
    tube = np.column_stack([ring.point, ring.radius])
    area = 2.0 * mean * length
    wrong, cost, fineness, side, kept = [area, 0.5 * area], [np.zeros(count, np.int64), np.full(count, 3)], [NULL, NULL], [0, 3], []
    if surface:
        straight = np.bincount(limb, share * _away(ring, tube, ends), count)
        area = length * (_HANGS * length + mean) + area
        wrong = [area, np.minimum(length * (straight + 0.5 * mean) + wrong[1], area)]
    tubes = 3.0 if surface else 2.0
    rough = {n: np.array([roughness(n, int(m)) for m in range(3, int(full.max(initial=3)) + 1)])[full - 3] for n in SIDES}
    for rank, factor in enumerate(_FINENESS):
        scale = (max(factor, 1e-6) * np.maximum(mean, 1e-9))[limb]
        keep = enough(tube / scale[:, None], ring.s / scale, ends, np.zeros(len(limb)), 1.0)
        kept.append(keep)
        away = np.bincount(limb, share * _away(ring, tube, keep), count)
        rings = np.bincount(limb[keep], minlength=count)
        for n in SIDES:
            wrong.append(np.minimum(tubes * length * (away + rough[n] * mean), area))
            cost.append(2 * n * (rings - 1) + n - 2)
            fineness.append(rank)
            side.append(n)
    return Choices(np.stack(wrong, axis=1), np.stack(cost, axis=1), np.array(fineness), np.array(side), kept)


def _shares(ring: Rings) -> Float[np.ndarray, " ring"]:
    """The share of its limb's length that each ring stands for."""
    step = np.diff(ring.s, append=ring.s[-1:])
    step[ring.start[1:] - 1] = 0.0
    around = 0.5 * (step + np.r_[0.0, step[:-1]])
    total = np.bincount(ring.limb, around, len(ring.start) - 1)
    return around / np.maximum(total, 1e-300)[ring.limb]


def _away(ring: Rings, tube, keep) -> Float[np.ndarray, " ring"]:
    """How far each ring lies from the kept polyline at the same place along its limb."""
    stand = np.flatnonzero(keep)
    right = np.clip(np.searchsorted(stand, np.arange(len(keep))), 1, len(stand) - 1)
    left, right = stand[right - 1], stand[right]
    share = np.clip((ring.s - ring.s[left]) / np.where(ring.s[right] > ring.s[left], ring.s[right] - ring.s[left], 1.0), 0.0, 1.0)
    gap = np.linalg.norm(tube - tube[left] - share[:, None] * (tube[right] - tube[left]), axis=1)
    return np.where(keep, 0.0, gap)


def _picked(parent, options: Choices, wrong, price: float) -> Int[np.ndarray, " limb"]:
    """The best choice of every limb at a price a triangle; none is left out that bears one that is not."""
    total = wrong + price * options.cost
    picked = np.argmin(total, axis=1)
    missing = _bears(parent, picked > 0) & (picked == 0)
    picked[missing] = np.argmin(total[missing, 1:], axis=1) + 1
    return picked


def _bears(parent, drawn):
    """Limbs that bear one that is drawn, however far along."""
    bears = np.zeros(len(parent), bool)
    rows = np.flatnonzero(drawn)
    while len(rows):
        rows = np.unique(parent[rows])
        rows = rows[(rows != NULL) & ~bears[rows]]
        bears[rows] = True
    return bears


def _shapes(ring: Rings, options: Choices, picked) -> Shapes:
    limb, rank = ring.limb, options.fineness[picked]
    kept = np.zeros(len(limb), bool)
    for number, keep in enumerate(options.kept):
        kept |= keep & (rank == number)[limb]
    spike = picked == 1
    kept[ring.start[:-1][spike]] = kept[ring.start[1:][spike] - 1] = True
    return Shapes(kept, options.side[picked], spike, int(options.cost[np.arange(len(picked)), picked].sum()))
