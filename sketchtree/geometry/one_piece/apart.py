"""How do limbs that leave their parent close together find room on its surface?

Outlines are taken for ellipses with half axes a (round the parent, metres) and b (along it). Two of them are clear of each
other when

    (Δx / (a₁ + a₂))² + (Δs / (b₁ + b₂))²  ≥  _CLEAR²        Δx = r Δθ,  r the parent's radius

In passes over all pairs at once, those that are not are first made smaller, down to `_SMALL` of their size, then pushed apart;
what is still crowded after `_PATIENT` passes is made smaller still, so that it ends. No outline reaches into its parent's
own collar, past its tip, or farther round than `_ROUND`.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.one_piece.outlines import Outlines

_CLEAR = 1.2
_SMALL = 0.6
_PASSES, _PATIENT = 60, 20
_ROUND = np.radians(100.0)  # largest half angle of an outline, seen from the parent's axis


def apart(
    outlines: Outlines, lowest: Float[np.ndarray, " limb"], highest: Float[np.ndarray, " limb"]
) -> tuple[Outlines, Float[np.ndarray, " fork"]]:
    """The outlines moved and scaled so that none overlap; and how much smaller each became.

    `lowest` and `highest` bound them on each limb, metres along it."""
    if len(outlines.limb) == 0:
        return outlines, np.ones(0)
    west, east, low, high = outlines.box()
    r = outlines.thick
    theta, s = 0.5 * (west + east), 0.5 * (low + high)
    a, b = 0.5 * (east - west) * r, 0.5 * (high - low)
    floor, roof = lowest[outlines.parent], highest[outlines.parent]
    across = np.minimum(1.0, _ROUND * r / a)
    along = np.minimum(1.0, 0.45 * (roof - floor) / b)
    shrink = np.ones(len(r))
    for turn in range(_PASSES):
        wide, tall = a * across * shrink, b * along * shrink
        s = np.clip(s, floor + tall, roof - tall)
        i, j = _near(outlines.parent, s, tall)
        dx, ds = _wrapped(theta[j] - theta[i]) * 0.5 * (r[i] + r[j]), s[j] - s[i]
        q = np.hypot(dx / (wide[i] + wide[j]), ds / (tall[i] + tall[j]))
        crowded = q < _CLEAR
        if not crowded.any():
            break
        i, j, dx, ds, q = (column[crowded] for column in (i, j, dx, ds, q))
        smaller = np.clip(q / _CLEAR, 0.85, 1.0)
        least = np.where(turn < _PATIENT, _SMALL, 0.0)
        for k in (i, j):
            np.minimum.at(shrink, k, np.maximum(shrink[k] * smaller, np.minimum(shrink[k], least)))
        _push(theta, s, r, i, j, dx, ds, q, tall)
    return outlines.moved(theta, s, across * shrink, along * shrink), shrink


def _push(theta, s, r, i, j, dx, ds, q, tall) -> None:
    """Moves pairs apart along the line between them, or along the parent where they coincide; each by half."""
    together = q < 0.05
    dx, ds = np.where(together, 0.0, dx), np.where(together, 0.3 * np.minimum(tall[i], tall[j]), ds)
    factor = 0.25 * np.where(together, 1.0, np.minimum(_CLEAR / np.maximum(q, 0.05) - 1.0, 1.0))
    for k, sign in ((i, -1.0), (j, 1.0)):
        np.add.at(theta, k, sign * factor * dx / r[k])
        np.add.at(s, k, sign * factor * ds)


def _near(parent: Int[np.ndarray, " fork"], s, tall):
    """Pairs on one parent whose stretches of it come near each other; the lower first."""
    low, high = s - _CLEAR * tall, s + _CLEAR * tall
    order = np.lexsort((low, parent))
    pairs = []
    for ahead in range(1, len(order)):
        i, j = order[:-ahead], order[ahead:]
        meets = (parent[i] == parent[j]) & (low[j] < high[i])
        if not meets.any() and ahead > 24:
            break
        pairs.append((i[meets], j[meets]))
        if not (parent[i] == parent[j]).any():
            break
    if not pairs:
        return order[:0], order[:0]
    i, j = (np.concatenate(side) for side in zip(*pairs, strict=True))
    swap = s[i] > s[j]
    return np.where(swap, j, i), np.where(swap, i, j)


def _wrapped(angle):
    return (angle + np.pi) % (2.0 * np.pi) - np.pi
