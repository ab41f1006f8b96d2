"""How many sides has each ring, and how many rings a collar?

A regular polygon of n sides misses its circle of radius r by r (1 − cos(π / n)); n is the fewest sides for which that is
within the tolerance. Along a limb, which thins, the sides fall by halves:

    n(ring) = n₀ / 2^l       l = 0 at the foot, never falling, at most one more than at the ring below

    n₀   sides at the foot, so chosen that the limb has the fewest vertices     l   halvings

Every 2^l-th vertex of the foot's ring carries on, so that a fine ring meets a coarse one without a crack.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.detail import Detail

_TYPICAL = 0.8  # radius that sets the number of sides, / radius at the foot
_FEW = 8  # most sides of a limb whose collar has few rings


def sides(radius: Float[np.ndarray, " place"], tolerance: float, detail: Detail) -> Int[np.ndarray, " place"]:
    """Fewest sides of circles of these radii; `tolerance` in metres."""
    cosine = np.clip(1.0 - tolerance / np.maximum(_TYPICAL * radius, 1e-12), -0.5, 1.0 - 1e-9)
    n = np.pi / np.arccos(cosine)
    n = np.where(n > _FEW, 2 * np.ceil(n / 2), np.ceil(n))  # even above 8: fewer kinds to sweep
    return np.clip(n, detail.fewest_sides, detail.most_sides).astype(np.int64)


def collar_rings(side: int | Int[np.ndarray, " limb"]) -> Int[np.ndarray, " limb"]:
    """Rings of the collar of a limb with so many sides: fewer on thin limbs."""
    return np.where(np.asarray(side) <= _FEW, 6, 9)


def halvings(
    needed: Int[np.ndarray, " ring"], whole: Int[np.ndarray, " limb"], start: Int[np.ndarray, " limb+1"], most: int
) -> tuple[Int[np.ndarray, " limb"], Int[np.ndarray, " ring"]]:
    """Sides n₀ of every limb and halvings l of every ring, of rings that need `needed` sides at least.

    The first `whole[i]` rings of limb i keep all their sides (collars). Above 8 sides, n₀ is even and at most `most`.
    """
    limb = np.repeat(np.arange(len(whole)), np.diff(start))
    within = np.arange(len(limb)) - start[:-1][limb]
    needed = _falling(needed, limb, start)
    foot = needed[start[:-1]]
    best = np.full(len(whole), np.iinfo(np.int64).max)
    side, level = foot.copy(), np.zeros(len(limb), np.int64)
    for n in np.unique(np.r_[foot, [n for n in (4, 6, 8, 12, 16, 24) if n <= most]]).tolist():
        able = (foot <= n) & ((foot <= _FEW) == (n <= _FEW))
        tried = np.zeros(len(limb), np.int64)
        for l in range(1, (n & -n).bit_length()):
            tried[n >> l >= np.maximum(needed, 3)] = l
        tried[within < whole[limb]] = 0
        tried = one_at_a_time(tried, within, limb)
        total = np.bincount(limb, n >> tried, minlength=len(whole)).astype(np.int64)
        better = able & (total < best)
        best[better], side[better] = total[better], n
        level = np.where(better[limb], tried, level)
    return side, level


def _falling(needed, limb, start):
    """The needs made to fall towards the tips: the most of each ring and those beyond it."""
    stride = int(needed.max(initial=0)) + 1
    back = (needed + (len(start) - limb) * stride)[::-1]
    return np.maximum.accumulate(back)[::-1] - (len(start) - limb) * stride


def one_at_a_time(
    level: Int[np.ndarray, " ring"], step: Int[np.ndarray, " ring"], limb: Int[np.ndarray, " ring"]
) -> Int[np.ndarray, " ring"]:
    """Levels that rise by one at most wherever `step` (a count that rises by 0 or 1 a ring) does, and nowhere else."""
    slack = level - step
    stride = int(np.ptp(slack)) + 1 if len(slack) else 1
    return np.minimum.accumulate(slack - limb * stride) + limb * stride + step
