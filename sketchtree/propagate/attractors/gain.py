"""By how much would each placement lower the energy (Tan et al. 2008, §3.2, "Speedup")?

    gain = E(T^n) − E(T^(n+1)) = Σ_s max(0, d_s^n − d̂_s)        d̂_s: from the attractor to the new branches alone

Only attractors that could come nearer count: those whose distance is more than the least that the farthest twig of any subtree would leave. Where there are very many of
them, every k-th stands for k. All pairs of attractors and pieces are one block of single-precision arrays.
"""

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.propagate.attractors.attractors import Attractors
from sketchtree.propagate.attractors.placement import Placed

MOST = 112  # attractors looked at for one branch
_BLOCK = 60_000  # pairs at a time: they stay in a processor's cache, and BLAS takes no threads, which cost more than they bring here


def gains(attractors: Attractors, at: Placed, reach: float, floor: float = 0.0) -> Float[np.ndarray, "subtree turn"]:
    """The gain of every subtree in every turn on one branch, metres. `reach`: how far from the middle of the branch any of them comes; `floor`: nearer than this counts as this."""
    axes = attractors.axes
    middle = at.middle[:axes]
    near = _near(attractors, middle, reach, floor)
    found = np.zeros(at.start.shape[:2])
    used = at.there.any(axis=-1)
    if len(near) == 0 or not used.any():
        return found
    every = -(-len(near) // MOST)
    near = near[::every]
    place = attractors.place[near] - middle
    before = attractors.distance[near].astype(np.float32)
    found[used] = every * _gain(place, before, at.start[used][..., :axes] - middle, at.end[used][..., :axes] - middle, at.there[used], np.float32(floor))
    return found


def _near(attractors: Attractors, middle, reach: float, floor: float):
    """Attractors that may come nearer."""
    away = np.linalg.norm(attractors.place - middle, axis=1)
    return np.flatnonzero((away - reach < attractors.distance) & (attractors.distance > floor))


def _gain(place, before, start: Float[np.ndarray, "placement piece axis"], end, there: Bool[np.ndarray, "placement piece"], floor):
    """The gain of every placement, all of which have pieces; block after block."""
    of = np.nonzero(there)[0]
    start, vector = start[there], (end - start)[there]
    first = np.r_[np.flatnonzero(np.r_[True, of[1:] != of[:-1]]), len(of)]
    lift = np.concatenate([place, np.ones((len(place), 1))], axis=1).astype(np.float32).T  # so that one product adds the constant too
    most, found, begin = max(_BLOCK // len(place), there.shape[1]), np.empty(len(there)), 0
    while begin < len(there):
        stop = max(int(np.searchsorted(first, first[begin] + most, side="right")) - 1, begin + 1)
        pieces = slice(first[begin], first[stop])
        square = np.minimum.reduceat(_squared(lift, start[pieces], vector[pieces]), first[begin:stop] - first[begin], axis=0)
        square += (place * place).sum(axis=1).astype(np.float32)
        after = np.maximum(np.sqrt(np.maximum(square, 0.0, out=square), out=square), floor, out=square)
        found[begin:stop] = np.maximum(before - after, 0.0).sum(axis=1)
        begin = stop
    return found


def _squared(lift, start, vector):
    """|s − p|² − |s|² for every piece and attractor: with the piece's unit direction v and length ℓ, w = v·(s − start), t = w cut to 0-ℓ, it is |start|² − 2 s·start + t (t − 2 w)."""
    length = np.linalg.norm(vector, axis=1, keepdims=True)
    unit = vector / np.maximum(length, 1e-300)
    along = np.concatenate([unit, -(unit * start).sum(axis=1, keepdims=True)], axis=1).astype(np.float32) @ lift
    square = np.concatenate([-2.0 * start, (start * start).sum(axis=1, keepdims=True)], axis=1).astype(np.float32) @ lift
    share = np.clip(along, np.float32(0.0), length.astype(np.float32))
    along *= np.float32(-2.0)
    along += share
    along *= share
    square += along
    return square
