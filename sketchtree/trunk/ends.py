"""Where does a limb truly end? Its line smoothed, and led on along its own direction to the contour.

Noise on the contour makes the axis waver by about as much, and bends its last piece into some corner. Each chain between forks is smoothed (a Gaussian in arc length of half its median radius, 1 to 6 pixels; both
ends stay); then, at a tip and at the foot, what lies within the last circle is replaced by a straight line to the contour. A tip on the contour would have a radius of nothing: it keeps that of this circle.
"""

from collections.abc import Callable

import numpy as np
import shapely
from jaxtyping import Bool, Float
from scipy.ndimage import gaussian_filter1d

Line = Float[np.ndarray, "point 2"]

_SHARE, _LEAST, _MOST = 0.5, 1.0, 6.0  # σ of the Gaussian: of the median radius; pixels
_CLEAR = 1.6  # radii from the end: at a corner of a right angle the line is never farther than √2 of them, the corner's circles
_REACH = 2.4  # radii of the last circle, or as far as the chain's own last circle reaches, and two pixels: within that the contour must be met
_BEHIND, _LEAST_BEHIND = 3.0, 8.0  # radii, and pixels, over which a limb's own direction is measured
_ABOVE = 1.0  # pixels
_STEP = 0.25  # pixels
_OFF = 0.3  # pixels a line may leave out
_PIECE = 12.0  # pixels, the longest straight piece


def smooth(line: Line, radius: float) -> Line:
    """A chain without its wavering, a point a pixel."""
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    if arc[-1] < 2.0:
        return line[[0, -1]]
    at = np.linspace(0.0, arc[-1], int(np.ceil(arc[-1])) + 1)
    even = np.column_stack([np.interp(at, arc, line[:, k]) for k in (0, 1)])
    straight = np.linspace(0.0, 1.0, len(at))[:, None] * (even[-1] - even[0]) + even[0]
    off = even - straight  # nothing at both ends: continued as an odd function, it stays so
    doubled = np.concatenate([off, -off[-2:0:-1]])
    sigma = float(np.clip(_SHARE * radius, _LEAST, _MOST))
    return straight + gaussian_filter1d(doubled, sigma, axis=0, mode="wrap")[: len(off)]


def clear_of_end(line: Line, radius: Float[np.ndarray, " point"]) -> Bool[np.ndarray, " point"]:
    """Whose circles lie clear of the chain's last point, a tip?"""
    return np.hypot(*(line - line[-1]).T) >= _CLEAR * radius


def clear_of_ground(line: Line, radius: Float[np.ndarray, " point"]) -> Bool[np.ndarray, " point"]:
    """Whose circles do not reach down as far as that of the chain's last point, a foot?"""
    return line[:, 1] + radius <= line[-1, 1] + radius[-1] - _ABOVE


def led_out(line: Line, radius: Float[np.ndarray, " point"], clear: Bool[np.ndarray, " point"], within: Callable[[Line], np.ndarray]) -> tuple[Line, float]:
    """(a chain whose last point is an end, up to the contour; the radius there). `clear`: points that the end has no part in; the last of them is where the straight piece begins."""
    clear = np.flatnonzero(clear)
    if len(clear) == 0 or clear[-1] == 0:
        return line, float(radius.min() if len(clear) == 0 else radius[-1])
    last = int(clear[-1])
    wide = float(radius[last])
    behind = np.flatnonzero(np.hypot(*(line[: last + 1] - line[last]).T) >= max(_BEHIND * wide, _LEAST_BEHIND))
    start = line[behind[-1]] if len(behind) else line[0]
    step = line[last] - start
    step = step / max(float(np.hypot(*step)), 1e-9)
    reach = max(_REACH * wide, float(np.hypot(*(line[-1] - line[last]))) + float(radius[-1]))
    far = np.arange(0.0, reach + 2.0, _STEP)
    out = np.flatnonzero(~within(line[last] + far[:, None] * step))
    if len(out) == 0 or out[0] == 0:
        return line, wide
    return np.concatenate([line[: last + 1], (line[last] + far[out[0] - 1] * step)[None]]), wide


def telling(line: Line) -> Line:
    """The same line by fewer points, none of its pieces longer than `_PIECE`."""
    return shapely.get_coordinates(shapely.segmentize(shapely.simplify(shapely.LineString(line), _OFF), _PIECE))
