"""Which points of a polyline are enough to draw it?

Ramer 1972 and Douglas & Peucker 1973: the ends are kept, then, in every stretch between kept points, the point
that is farthest from the chord, as long as it is farther than ε. All stretches of all lines advance together, one split a pass.
Since halving overshoots, points that turn out not to be needed between their neighbours are given back, every other one a pass.

The distance is taken in any number of dimensions: with the radius as a fourth, tapers are followed as bends are.
"""

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.watch import Pulse, no_pulse

_ROUNDS = 3


def enough(
    point: Float[np.ndarray, "point dimension"],
    s: Float[np.ndarray, " point"],
    kept: Bool[np.ndarray, " point"],
    margin: Float[np.ndarray, " point"],
    tolerance: float,
    pulse: Pulse = no_pulse,
) -> Bool[np.ndarray, " point"]:
    """The points to keep: those `kept` from the outset, among them both ends of every line, and what it takes
    to stay within `tolerance` of the rest.

    `s` is the length along the line; no point is added within its `margin` of a kept neighbour (same unit).
    """
    needed, kept = kept, kept.copy()
    within = np.flatnonzero(~kept)
    while len(within):
        pulse()
        stand = np.flatnonzero(kept)
        right = np.searchsorted(stand, within)
        left, right = stand[right - 1], stand[right]
        free = (s[within] - s[left] >= margin[within]) & (s[right] - s[within] >= margin[within])
        away = np.where(free, _distance(point[within], point[left], point[right]), 0.0)
        far = away > tolerance
        order = np.lexsort((away, left))
        last = order[np.flatnonzero(np.diff(left[order], append=-1))]
        kept[within[last[far[last]]]] = True
        open_ = np.isin(left, left[last[far[last]]])  # the other stretches are done
        within = within[open_ & ~kept[within]]
    for turn in range(2 * _ROUNDS if kept.any() else 0):
        pulse()
        _give_back(point, needed, kept, turn % 2, tolerance)
    return kept


def _give_back(point, needed, kept, odd: int, tolerance: float) -> None:
    """Drop the kept points of one parity that the line between their neighbours does without."""
    stand = np.flatnonzero(kept)
    able = (np.arange(len(stand)) % 2 == odd) & ~needed[stand]
    left = np.where(able[:-1], -1, np.arange(len(stand) - 1))  # for every stretch, where the chord over it begins
    left[left < 0] = np.flatnonzero(able[:-1]) - 1
    right = np.where(able[1:], np.arange(len(stand) - 1) + 2, np.arange(len(stand) - 1) + 1)
    stretch = np.searchsorted(stand, np.arange(stand[0], stand[-1]), side="right") - 1
    away = _distance(point[stand[0] : stand[-1]], point[stand[left[stretch]]], point[stand[right[stretch]]])
    worst = np.maximum.reduceat(away, stand[:-1] - stand[0])
    inner = np.flatnonzero(able)
    kept[stand[inner[np.maximum(worst[inner - 1], worst[inner]) <= tolerance]]] = False


def _distance(x, a, b):
    """From points x to the chords a b."""
    chord = b - a
    share = np.sum((x - a) * chord, axis=1) / np.maximum(np.sum(chord * chord, axis=1), 1e-300)
    return np.linalg.norm(x - a - np.clip(share, 0.0, 1.0)[:, None] * chord, axis=1)
