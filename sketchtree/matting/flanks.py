"""Where does a limb end that is marked along its middle? At the two edges that keep it company the whole way.

A trunk before dark bushes has their colours, and no colour tells the two apart; but its edges run along the line that was drawn on it, and whatever else is seen there runs elsewhere. Ours: with E(s, o) the difference
between the mean colours of `_WIDE` pixels on either side of the place o pixels beside the line at s (root mean square over the channels, averaged over `_ALONG` pixels of the line), an edge is the course of greatest

    Σ_s (1 − `LIKE` P(s, o_s)) log(1 + E(s, o_s) / Ē) − `NEAR` o_s − `GAPS` G(s, o_s) − `STEADY` |o_s − o_{s−1}| − `MIDDLE` |o_s − o'_s| / (o_s + o'_s)        Ē the median of E along the line
                                                                                                                         P how much what lies beyond has the wood's colours
                                                                                                                         G pixels between the line and the edge that have not

found by dynamic programming, first on the side that shows more, then on the other, whose o' is then known: lines are drawn along the middle, more or less. Where the edge is not seen the course goes on from where it is.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int
from scipy.ndimage import gaussian_filter1d, map_coordinates, uniform_filter1d
from scipy.spatial import KDTree

NEAR, STEADY, MIDDLE, LIKE, GAPS = 0.012, 4.0, 1.0, 0.7, 0.1
REACH = 0.05  # of the picture's longer side: no edge is farther off
CLEARLY = 0.1  # probability of wood below which a pixel is clearly none
SOLID = (0.2, 0.1)  # part of the way from a line to its edge that is clearly no wood: between twigs, and in a limb
THICK = (2.5, 4.0)  # pixels, half a limb: thinner ones are as well told by their colours
SEEN = (1.5, 2.5)  # Ē: an edge that is none, and a sure one
LEAST_INSIDE = 0.8  # how surely what lies between edges that are not seen is the limb, where most of the line's are
KNOWN = (0.5, 0.7)  # part of a line's edges that is seen: few, and most
_STEP, _WIDE, _ALONG = 0.5, 2.0, 5
_SMOOTH = 2.0, 3.0  # pixels along a line, σ, of its places and its directions
_NEAR_BY = 5.0  # pixels along a line, σ, over which an edge is seen
_MOVES = (-2, -1, 0, 1, 2)  # half pixels from one place to the next
_SOFT = 1.0  # pixels inside an edge within which the limb is not sure


class Flanks(NamedTuple):
    """The two edges of a line, first on its right-hand side, looking along it (x right, y down)."""

    place: Float[np.ndarray, "place 2"]  # on the line, a pixel apart
    across: Float[np.ndarray, "place 2"]  # unit vector to the first side
    off: Float[np.ndarray, "side place"]  # pixels from the line
    solid: Float[np.ndarray, "side place"]  # 0 to 1: how surely what lies before it is all wood
    seen: Float[np.ndarray, "side place"]  # 0 to 1: how surely that is an edge


def flanks(rgb: Float[np.ndarray, "row column 3"], wood: Float[np.ndarray, "row column"], line: Float[np.ndarray, "point 2"]) -> Flanks | None:
    """The edges of what a line was drawn along; None of a mere dot. `wood`: how likely each pixel is wood by its colour alone, 0 to 1."""
    place, along = _places(line)
    if len(place) < 2 * _ALONG:
        return None
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    count = int(REACH * max(rgb.shape[:2]) / _STEP)
    edge, beyond, gaps = _edges(np.concatenate([rgb, wood[..., None]], axis=2), place, across, count)
    usual = max(float(np.median(edge)), 1e-6)
    gain = (1.0 - LIKE * beyond) * np.log1p(edge / usual) - GAPS * gaps
    first = int(np.argmax([_course(one)[1] for one in gain]))
    off = np.zeros((2, len(place)))
    off[first] = _course(gain[first])[0]
    off[1 - first] = _course(gain[1 - first], off[first])[0]
    at = np.clip(np.floor(off / _STEP).astype(int), 0, count - 1)
    strong = gaussian_filter1d(np.take_along_axis(edge, at[..., None], axis=2)[..., 0], _NEAR_BY, axis=1, mode="nearest") / usual
    gap = gaussian_filter1d(np.take_along_axis(gaps, at[..., None], axis=2)[..., 0] / off, _NEAR_BY, axis=1, mode="nearest")
    return Flanks(place, across, off, np.clip((SOLID[0] - gap) / (SOLID[0] - SOLID[1]), 0.0, 1.0), np.clip((strong - SEEN[0]) / (SEEN[1] - SEEN[0]), 0.0, 1.0))


def _places(line) -> tuple[Float[np.ndarray, "place 2"], Float[np.ndarray, "place 2"]]:
    """(places a pixel apart, unit directions)."""
    run = np.r_[0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T))]
    at = np.linspace(0.0, run[-1], max(int(np.ceil(run[-1])), 1) + 1)
    place = gaussian_filter1d(np.column_stack([np.interp(at, run, line[:, k]) for k in (0, 1)]), _SMOOTH[0], axis=0, mode="nearest")
    along = gaussian_filter1d(np.gradient(place, axis=0), _SMOOTH[1], axis=0, mode="nearest") if len(place) > 1 else np.zeros((1, 2))
    return place, along / np.maximum(np.hypot(*along.T), 1e-9)[:, None]


def _edges(layers, place, across, count: int) -> tuple[Float[np.ndarray, "side place off"], ...]:
    """(E at ½ `_STEP`, 1½ `_STEP` … pixels on either side; how much of what lies beyond is like wood; how much of what lies before is not, pixels). `layers`: red, green, blue, and that."""
    wide = int(_WIDE / _STEP)
    off = _STEP * np.arange(-count - wide, count + wide + 1)
    at = place[:, None] + off[None, :, None] * across[:, None]
    value = np.stack([map_coordinates(layers[..., k], [at[..., 1] - 0.5, at[..., 0] - 0.5], order=1, mode="nearest") for k in range(4)], axis=-1)
    sums = np.cumsum(np.pad(uniform_filter1d(value, _ALONG, axis=0, mode="nearest"), ((0, 0), (1, 0), (0, 0))), axis=1)
    zero = count + wide
    right, left = np.arange(zero + 1, zero + 1 + count), np.arange(zero, zero - count, -1)  # each lies between that sample and the one before it
    outer, inner = (np.stack([_between(sums, right + a, right + b), _between(sums, left - b, left - a)]) for a, b in ((0, wide), (-wide, 0)))
    unlike = 1.0 - np.clip(np.diff(sums[..., 3], axis=1) / CLEARLY, 0.0, 1.0)
    gaps = _STEP * np.stack([np.cumsum(unlike[:, zero : zero + count], axis=1), np.cumsum(unlike[:, zero : zero - count : -1], axis=1)])
    return np.sqrt(((outer - inner)[..., :3] ** 2).mean(axis=-1)), np.clip(outer[..., 3], 0.0, 1.0), gaps


def _between(sums, first, last) -> Float[np.ndarray, "place off 4"]:
    return (sums[:, last] - sums[:, first]) / (last - first)[0]


def _course(gain: Float[np.ndarray, "place off"], other: Float[np.ndarray, " place"] | None = None) -> tuple[Float[np.ndarray, " place"], float]:
    """(the offsets of the best course, its worth)."""
    off = _STEP * (np.arange(gain.shape[1]) + 0.5)
    worth = gain - NEAR * off
    if other is not None:
        worth = worth - MIDDLE * np.abs(off - other[:, None]) / (off + other[:, None])
    best, came = worth[0].copy(), np.zeros(worth.shape, np.int64)
    reach = max(_MOVES)
    moves = STEADY * _STEP * np.abs(np.array(_MOVES))
    index = np.arange(len(off))[:, None] + np.arange(len(_MOVES))
    for row in range(1, len(worth)):
        from_each = np.pad(best, reach, constant_values=-np.inf)[index] - moves
        came[row] = from_each.argmax(axis=1)
        best = from_each.max(axis=1) + worth[row]
    return off[_back(came, int(best.argmax()))], float(best.max())


def _back(came, last: int) -> Int[np.ndarray, " place"]:
    course = np.empty(len(came), np.int64)
    course[-1] = last
    for row in range(len(came) - 1, 0, -1):
        course[row - 1] = course[row] + _MOVES[came[row, course[row]]]
    return course


def between(found: Flanks, shape: tuple[int, int]) -> tuple[tuple[slice, slice], Float[np.ndarray, "row column"], Float[np.ndarray, "row column"]]:
    """(a window of the picture; how surely each pixel of it lies between the two edges; how surely it lies beside the line but not between them)."""
    far = REACH * max(shape) + 2.0
    low, high = np.floor(found.place.min(axis=0) - far).astype(int), np.ceil(found.place.max(axis=0) + far).astype(int)
    rows, columns = (slice(int(np.clip(low[k], 0, shape[1 - k])), int(np.clip(high[k], 0, shape[1 - k]))) for k in (1, 0))
    y, x = np.mgrid[rows, columns] + 0.5
    away, which = KDTree(found.place).query(np.stack([x, y], axis=-1), distance_upper_bound=far)
    beside = np.isfinite(away)
    which = np.where(beside, which, 0)
    off = (x - found.place[which, 0]) * found.across[which, 0] + (y - found.place[which, 1]) * found.across[which, 1]
    beside &= away <= np.abs(off) + 1.0  # not beyond the line's ends
    side = (off < 0).astype(int)
    edge, seen = found.off[side, which], found.seen[side, which]
    solid = found.solid[side, which] * np.clip((found.off.sum(axis=0)[which] / 2.0 - THICK[0]) / (THICK[1] - THICK[0]), 0.0, 1.0)
    inside, beyond = (np.clip(sign * (edge - np.abs(off)) / _SOFT, 0.0, 1.0) for sign in (1, -1))
    guessed = LEAST_INSIDE * np.clip((found.seen.mean() - KNOWN[0]) / (KNOWN[1] - KNOWN[0]), 0.0, 1.0)
    sure = solid * np.maximum(seen, guessed)
    return (rows, columns), np.where(beside, inside * sure, 0.0), np.where(beside, sure * beyond, 0.0)
