"""Which painted shapes are single strokes of a brush? Programs that outline strokes write each as a filled polygon.

The border of such a shape is walked in N even steps b_0 … b_{N-1}. If it is one stroke, the two halves that part at one of its
ends run side by side, so that with the right end k

    middle  m_j = (b_{k+j} + b_{k-j}) / 2        width  w_j = |b_{k+j} − b_{k−j}|        j = 0 … N/2

k is where the mean width is least. It is a stroke if it is slender (mean w ≤ SLENDER of the length of m) and never
much wider than usual (a fork is: where its arms part, b_{k+j} and b_{k−j} lie on different arms). The border may cross itself:
a stroke that loops stays a stroke. An open line that runs out and back (both sides of a limb, joined at its tip) is read in the same way.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Bool, Float, Int

STEPS = 96  # N
SLENDER = 0.3  # greatest mean width of a stroke, of its length
BULGE = 2.6  # greatest width of a stroke, of its middle width
STRAY = 0.12  # or this part of its length, where that is more
FOLLOWS = 0.82  # least length of the middle line and width together, of half the border: the middle of unlike halves cuts corners
POINTED = 1.0  # greatest slope of its width towards the end of a stroke: where it falls faster, the end is blunt
END = 0.75  # of its width near a blunt end, below which a step lies on the end itself
BATCH = 256  # shapes worked on at once


@dataclass(frozen=True, eq=False)
class Middles:
    """The middle lines of shapes, one a row; only those that are single strokes mean anything."""

    points: Float[np.ndarray, "shape step 2"]
    width: Float[np.ndarray, "shape step"]
    single: Bool[np.ndarray, " shape"]


def middles(borders: Float[np.ndarray, "shape step 2"]) -> Middles:
    """The middle lines of closed borders, each given by STEPS even steps (the first not repeated)."""
    if len(borders) == 0:
        return Middles(np.zeros((0, STEPS // 2 + 1, 2)), np.zeros((0, STEPS // 2 + 1)), np.zeros(0, bool))
    parts = [_middles(borders[k : k + BATCH]) for k in range(0, len(borders), BATCH)]
    return Middles(*(np.concatenate([getattr(part, name) for part in parts]) for name in ("points", "width", "single")))


def even_border(points: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, "step 2"]:
    """STEPS points at even lengths along the closed line through these."""
    ring = np.vstack([points, points[:1]])
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(ring, axis=0).T))]
    at = np.arange(STEPS) * (s[-1] / STEPS)
    return np.stack([np.interp(at, s, ring[:, axis]) for axis in (0, 1)], 1)


def _middles(borders) -> Middles:
    ends = _ends(borders)
    j = np.arange(STEPS // 2 + 1)
    rows = np.arange(len(borders))[:, None]
    ahead, behind = borders[rows, (ends[:, None] + j) % STEPS], borders[rows, (ends[:, None] - j) % STEPS]
    points, width = 0.5 * (ahead + behind), np.hypot(*np.moveaxis(ahead - behind, -1, 0))
    length = np.hypot(*np.moveaxis(np.diff(points, axis=1), -1, 0)).sum(1)
    inner = width[:, 2:-2]
    usual = np.median(inner, axis=1)
    around = np.hypot(*np.moveaxis(borders - np.roll(borders, 1, axis=1), -1, 0)).sum(1)
    follows = length + width.mean(1) >= FOLLOWS * 0.5 * around
    single = (inner.mean(1) <= SLENDER * length) & (inner.max(1) <= np.maximum(BULGE * usual, STRAY * length)) & (usual > 0) & follows
    return Middles(points, width, single)


def _ends(borders) -> Int[np.ndarray, " shape"]:
    """Where each border is parted: the step whose two sides run closest together."""
    x, y = borders[..., 0], borders[..., 1]
    apart = np.hypot(x[:, :, None] - x[:, None, :], y[:, :, None] - y[:, None, :])
    j = np.arange(1, STEPS // 2)
    k = np.arange(STEPS // 2)
    ahead, behind = (k[:, None] + j) % STEPS, (k[:, None] - j) % STEPS
    return apart[:, ahead, behind].mean(-1).argmin(-1)


def slenderness(area: Float[np.ndarray, " shape"], around: Float[np.ndarray, " shape"]) -> Float[np.ndarray, " shape"]:
    """Length over width of the rectangles of these areas and perimeters; 1 where none is so round."""
    half = 0.25 * np.maximum(around, 1e-300)
    root = np.sqrt(np.maximum(half**2 - area, 0.0))
    return (half + root) / np.maximum(half - root, 1e-9 * half)


def blunt(points: Float[np.ndarray, "step 2"], width: Float[np.ndarray, " step"]) -> Float[np.ndarray, " step"]:
    """The widths with those near blunt ends as wide as the stroke is there: w_j ≥ w_k − POINTED · |s_j − s_k|.

    A border is parted at one point, so that its middle starts with a width of 0, however wide the stroke ends."""
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    return (width[None] - POINTED * np.abs(s[:, None] - s[None])).max(1)


def squared(points: Float[np.ndarray, "step 2"], width: Float[np.ndarray, " step"]):
    """(points, widths) without the steps along blunt ends, whose middle runs from a corner to the middle of the end."""
    full = blunt(points, width)
    inner = np.flatnonzero(width >= END * full)
    low, high = (int(inner[0]), int(inner[-1])) if len(inner) > 1 else (0, len(width) - 1)
    return points[low : high + 1], full[low : high + 1]


def simplified(points: Float[np.ndarray, "step 2"], width: Float[np.ndarray, " step"], tolerance: float):
    """(points, widths) of a middle line without the points that do not bend it."""
    line = shapely.LineString(points)
    kept = shapely.get_coordinates(shapely.simplify(line, tolerance))
    s = np.r_[0.0, np.cumsum(np.hypot(*np.diff(points, axis=0).T))]
    at = shapely.line_locate_point(line, shapely.points(kept))
    return kept, np.interp(at, s, width)
