"""How thick is a limb, where its colour ends?

Across a limb the colour is the limb's own, `c`, and beyond either edge something else. With d(o) = |I(o) − c| at o pixels from the middle, the photo as it is (no smoothing: it would
make twigs half as thick again), averaged along half a step of the limb:

    the edge is the first o with d(o) > HALF · D, and the mean of d from there on for AHEAD · o + 1 pixels is as well

D is the FAR quantile of d on that side within `reach`: what lies beside the limb. Furrows, lichen and the grain of old prints are no edge, since beyond them the limb goes on. Where another
limb crosses, or a hedge of the same colour stands behind, one place is wrong; limbs taper, so that the widths along one are put right together (`tapered`): medians of WINDOW neighbours, then
the widths of least squared error, in logarithms, that never grow towards the tip (pool adjacent violators).
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, UInt8
from scipy import ndimage

HALF = 0.5
FAR = 75.0  # percent
AHEAD = 0.4
WINDOW = 5  # places, half a circle apart
_BESIDE = 2.0 / 640.0  # of the photo's longer side, at least two pixels: so far from its line a limb's middle may lie
_FINEST = 0.5  # pixels between places across
_ALONG = 5  # places averaged along a limb
_LEAST = 0.5  # pixels, half a width


class Edges(NamedTuple):
    """What is seen across a limb at each of some places."""

    half: Float[np.ndarray, " place"]  # half the thickness, pixels
    contrast: Float[np.ndarray, " place"]  # D, the weaker side's, levels of 255
    aside: Float[np.ndarray, " place"]  # how far to the right of the line, looking along it, the limb's middle is


def edges_at(rgb: UInt8[np.ndarray, "row column 3"], place: Float[np.ndarray, "place 2"], along: Float[np.ndarray, "place 2"], *, reach: float, step: float) -> Edges:
    """The edges of limbs at places `step` apart along them; no edge farther off than `reach`."""
    fine = max(_FINEST, reach / 60)
    count, beside = max(int(reach / fine), 2), max(int(round(max(2.0, _BESIDE * max(rgb.shape)) / fine)), 1)
    colour = _across(rgb, place, along, fine * np.arange(-count, count + 1), step)
    middle = colour[:, count - 1 : count + 2].mean(axis=1)
    own = ndimage.median_filter(middle, size=(WINDOW, 1), mode="nearest")
    apart = np.sqrt(((colour - own[:, None]) ** 2).sum(axis=2))
    seen = ndimage.uniform_filter1d(apart, 3, axis=1)[:, count - beside : count + beside + 1]
    shift = seen.argmin(axis=1) - beside
    sides = [apart[:, count:], apart[:, count::-1]]
    far = [np.percentile(side, FAR, axis=1) for side in sides]
    right = fine * _first_edge(_moved(sides[1], sides[0], shift), HALF * far[0], fine)
    left = fine * _first_edge(_moved(sides[0], sides[1], -shift), HALF * far[1], fine)
    return Edges(np.maximum(0.5 * (left + right), _LEAST), np.minimum(*far), fine * shift + 0.5 * (right - left))


def _across(rgb, place, along, off: Float[np.ndarray, " off"], step: float) -> Float[np.ndarray, "place off 3"]:
    """The colours across limbs, averaged along half a step on either side."""
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    before = step * np.linspace(-0.5, 0.5, _ALONG)
    at = place[:, None, None] + before[None, :, None, None] * along[:, None, None] + off[None, None, :, None] * across[:, None, None]
    column = np.clip(at[..., 0].astype(np.int32), 0, rgb.shape[1] - 1)
    row = np.clip(at[..., 1].astype(np.int32), 0, rgb.shape[0] - 1)
    return rgb.reshape(-1, 3)[row * rgb.shape[1] + column].mean(axis=1, dtype=np.float32)


def _moved(behind, ahead, shift) -> Float[np.ndarray, "place off"]:
    """One side of a profile, counted from a middle `shift` samples further on (or, negative, back on the other side)."""
    line = np.concatenate([behind[:, :0:-1], ahead], axis=1)
    first, last = behind.shape[1] - 1, line.shape[1] - 1
    return np.take_along_axis(line, np.clip(first + shift[:, None] + np.arange(ahead.shape[1]), 0, last), axis=1)


def _first_edge(apart: Float[np.ndarray, "place off"], limit: Float[np.ndarray, " place"], fine: float) -> Float[np.ndarray, " place"]:
    """The first sample beyond the limit from which on it goes on so; the last where none does."""
    count = apart.shape[1]
    summed = np.concatenate([np.zeros((len(apart), 1)), np.cumsum(apart, axis=1)], axis=1)
    start = np.arange(count)
    stop = np.minimum(start + np.maximum(np.rint(AHEAD * start + 1 / fine).astype(int), 1), count)
    beyond = (apart > limit[:, None]) & ((summed[:, stop] - summed[:, start]) / (stop - start) > limit[:, None])
    return np.where(beyond.any(axis=1), beyond.argmax(axis=1), count).astype(np.float64)


def tapered(half: Float[np.ndarray, " place"], most: float = np.inf) -> Float[np.ndarray, " place"]:
    """Widths along a limb, from its foot: none thicker than `most`, none thicker than the one before it."""
    smooth = ndimage.median_filter(np.log(half), size=min(WINDOW, 2 * len(half) - 1), mode="nearest")
    mean, weight = [], []
    for value in np.minimum(smooth, np.log(most)):
        mean.append(value), weight.append(1)
        while len(mean) > 1 and mean[-2] < mean[-1]:
            held = weight[-2] + weight[-1]
            mean[-2:], weight[-2:] = [(mean[-2] * weight[-2] + mean[-1] * weight[-1]) / held], [held]
    return np.exp(np.repeat(mean, weight))


def roughness(half: Float[np.ndarray, " place"]) -> float:
    """By how much widths differ from one place to the next, in logarithms."""
    return max(float(np.median(np.abs(np.diff(np.log(half))))) if len(half) > 1 else 1.0, 0.05)
