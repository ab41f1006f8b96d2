"""Where is the trunk? Under the crown, the upright strip that is told from both its sides by the strongest upright edges.

For every column x and half width h, over the rows between the crown and the ground: the mean of |I(x) − I(x ± 2h)| in lightness, both sides counted by the weaker, less what the
strip varies along itself, weighted towards the crown's middle. The stroke runs from the ground up the strip and on to the crown's heart.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, UInt8
from scipy import ndimage

_WIDTHS = (0.008, 0.012, 0.018, 0.026)  # half widths tried, of the photo's size
_ASIDE = 0.22  # σ of how far from the crown's middle, of its width
_DOWN = 0.22  # of the photo's size: how far under the crown is looked at most
_UP = 0.55  # of the crown's height: where the stroke ends
_CLEAR = 14.0  # contrast of a trunk that is plainly seen, of 255


class Stem(NamedTuple):
    """A trunk's stroke, from its foot, and how plainly it is seen."""

    line: Float[np.ndarray, "point 2"]
    clear: float  # 0-1


def find_trunk(rgb: UInt8[np.ndarray, "row column 3"], crown: Bool[np.ndarray, "row column"]) -> Stem:
    """The trunk under a crown."""
    light = ndimage.gaussian_filter(rgb.astype(np.float32).mean(axis=2), 1.0)
    rows, columns = np.nonzero(crown)
    size, middle, breadth = max(crown.shape), float(np.median(columns)), float(columns.max() - columns.min() + 1)
    bottom = int(np.quantile(rows, 0.97))
    top, end = max(0, bottom - int(0.04 * size)), min(crown.shape[0] - int(0.03 * size), bottom + int(_DOWN * size))
    near = np.exp(-0.5 * ((np.arange(crown.shape[1]) - middle) / (_ASIDE * breadth)) ** 2)
    scores = np.array([_strip(light, max(1, round(part * size))) for part in _WIDTHS]).max(axis=0)  # row, column
    best = (scores[top:end].mean(axis=0)) * near
    x = int(np.argmax(best))
    seen = scores[:, max(0, x - 3) : x + 4].max(axis=1)
    plain = ndimage.uniform_filter1d(seen, max(3, int(0.03 * size)))
    foot = top + int(np.argmax(plain[top:end]))
    while foot < crown.shape[0] - int(0.03 * size) and plain[foot] > 0.4 * max(plain[top:end].max(), 1e-6):
        foot += 1
    foot = max(foot, min(bottom + int(0.05 * size), crown.shape[0] - 1))
    height = rows.max() - rows.min() + 1
    head = rows.max() - _UP * height
    inside = columns[np.abs(rows - head) < 0.08 * height]
    heart = float(np.median(inside)) if len(inside) else middle
    stop = 0.5 * (x + heart) if abs(heart - x) > 0.15 * breadth else x
    line = np.array([[x + 0.5, foot], [x + 0.5, 0.5 * (foot + bottom)], [x + 0.5, bottom], [0.5 * (x + stop) + 0.5, 0.5 * (bottom + head)], [stop + 0.5, head]])
    return Stem(line[np.r_[True, np.diff(line[:, 1]) < -0.5]], float(np.clip(best[x] / _CLEAR, 0, 1)))


def _strip(light: Float[np.ndarray, "row column"], half: int) -> Float[np.ndarray, "row column"]:
    """How much an upright strip about each pixel differs from both its sides."""
    strip = ndimage.uniform_filter1d(light, 2 * half + 1, axis=1)
    left, right = np.roll(strip, 2 * half + 1, axis=1), np.roll(strip, -2 * half - 1, axis=1)
    same = np.sign(strip - left) == np.sign(strip - right)
    weaker = np.where(same, np.minimum(np.abs(strip - left), np.abs(strip - right)), 0.0)
    weaker[:, : 3 * half + 2] = weaker[:, -3 * half - 2 :] = 0.0
    return weaker
