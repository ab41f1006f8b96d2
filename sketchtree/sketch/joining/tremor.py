"""Is the line's jitter meant? A trembling hand zigzags faster than branches bend.

A line is averaged over a short length to either side of every point, less near its ends, which stay:

    p̄(s) = Σ_k w_k p(s + u_k r),    u_k from −1 to 1,    w_k ∝ cos²(π u_k / 2),    r = min(R, s, L − s)

If that shortens it by more than SHORTENS, what went was tremor and the average is kept; else the line stays as it was.
"""

import dataclasses

import numpy as np

from sketchtree.sketch.joining.lines import Line

REACH = 0.015  # R, of H, along the trembling line
SHORTENS = 0.1  # of its length
STILL = 2 * float(np.arccos(1 - SHORTENS))  # radians: a line that turns less in all is too straight to be shortened so
_TAPS = np.linspace(-1, 1, 13)[1:-1]
_WEIGHTS = np.cos(np.pi * _TAPS / 2) ** 2 / np.sum(np.cos(np.pi * _TAPS / 2) ** 2)


def without_tremor(line: Line, height: float) -> Line:
    """The line with a trembling hand's zigzags averaged out; itself if there are none. `height` is H."""
    if len(line.points) < 5:
        return line
    reach = np.minimum(REACH * height, np.minimum(line.along, line.length - line.along))
    points = np.einsum("k,kpa->pa", _WEIGHTS, line.at(line.along + _TAPS[:, None] * reach))
    steady = dataclasses.replace(line, points=points)
    return steady if steady.length < (1 - SHORTENS) * line.length else line
