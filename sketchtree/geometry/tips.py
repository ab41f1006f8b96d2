"""How does a limb end that was drawn thick up to its end? Like a limb: it runs out into a twig.

A pen is many times as wide as a twig, so a stroke of varying width ends in a stump. Where nothing stands on a drawn limb's last stretch and
its tip is `_STOUT` to `_SAWN` times as thick as the tree's thinnest wood t, the stretch thins and ends as thick as that:

    r'(s) = t + (r(s) − t) w^¾        w = (S − s) / ℓ, in the last ℓ = min(`_LONG` r(S), S / 2) metres of a limb S long

This shapes the surface only: the skeleton keeps the radii that were drawn. Measured wood ends as it was measured,
and what is thicker ends in a stump: it was sawn off.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL

_STOUT, _SAWN = 4.0, 16.0
_LONG = 24.0
_TAPER = 0.75


def run_out(
    radius: Float[np.ndarray, " point"],
    s: Float[np.ndarray, " point"],
    start: Int[np.ndarray, " limb+1"],
    parent: Int[np.ndarray, " limb"],
    parent_s: Float[np.ndarray, " limb"],
    drawn: Bool[np.ndarray, " limb"],
    thinnest: float,
) -> Float[np.ndarray, " point"]:
    """The radii (metres) of limbs' points `s` metres from their feet, thinned at the tips of `drawn` limbs that end stout and free.
    Ragged by limb: `start`; `parent` and `parent_s` say what stands on what, and where."""
    last = start[1:] - 1
    length, tip = s[last], radius[last]
    ell = np.minimum(_LONG * tip, 0.5 * length)
    highest = np.zeros(len(length))
    on = parent != NULL
    np.maximum.at(highest, parent[on], parent_s[on])
    stout = drawn & (tip > _STOUT * thinnest) & (tip <= _SAWN * thinnest)
    ell = np.where(stout, np.minimum(ell, length - highest - tip), 0.0)
    ell = np.where(ell > 2.0 * tip, ell, 0.0)
    of = np.repeat(np.arange(len(length)), np.diff(start))
    left = np.clip((length[of] - s) / np.maximum(ell[of], 1e-12), 0.0, 1.0)
    thin = thinnest + np.maximum(radius - thinnest, 0.0) * left**_TAPER
    return np.where(ell[of] > 0, np.minimum(thin, radius), radius)
