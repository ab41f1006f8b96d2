"""Where does a stroke go back over itself? Whoever does not lift the pen walks back along a branch to draw the next.

At a cusp, a turn sharper than CUSP, two parts of the stroke meet. A part that lies along the other all its way is dropped.
Parts that lie along each other only for a while, from the cusp to a fork, keep what they share once: it stays
with the part that goes on straighter from the fork, and the other begins there, as a line of its own. All other sharp turns
are left as they were drawn.
"""

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.sketch.joining.lines import Line, angle_between

DOT = 0.005  # of H: a smaller stroke is a dot
AGAIN = 0.005  # of H: a part that lies no farther than this along another is that part, drawn again
FOLD = 0.03  # of H: going back over a shorter piece is a tremor
LAP = 0.06  # of H: how far parts must lie along each other up to a fork; a narrow V does so for less
CUSP = np.radians(150)  # a sharper turn is a change of mind


def unfolded(line: Line, height: float) -> list[Line]:
    """The line without the parts that go back over it; what is left in one piece stays one line. `height` is H."""
    cusps = _cusps(line, height)
    if len(cusps) == 0:
        return [line]
    bounds = np.r_[0.0, cusps, line.length]
    parts = [line.cut(a, b) for a, b in zip(bounds[:-1], bounds[1:], strict=True)]
    low, high = bounds[:-1].copy(), bounds[1:].copy()
    again = np.array([_goes_back(k, parts, height) for k in range(len(parts))])
    low[again] = high[again]
    for k in range(1, len(parts)):
        if not again[k - 1] and not again[k]:
            before, after = _shared(parts[k - 1].reversed(), parts[k], height)
            high[k - 1] -= before
            low[k] += after
    return _runs(line, low, high, DOT * height)


def _runs(line: Line, low, high, least: float) -> list[Line]:
    """What is left between `low` and `high` of every part, joined where nothing was taken off; the line itself if nothing was."""
    runs: list[list[float]] = []
    for a, b in zip(low.tolist(), high.tolist(), strict=True):
        if b - a <= least:
            continue
        if runs and runs[-1][1] == a:
            runs[-1][1] = b
        else:
            runs.append([a, b])
    return [line] if runs == [[0.0, line.length]] else [line.cut(a, b) for a, b in runs]


def _goes_back(k: int, parts: list[Line], height: float) -> bool:
    """Whether a part between cusps lies along the one before or after it (of two alike, the later one does)."""
    part = parts[k]
    if part.length < FOLD * height:
        return False
    beside = [j for j in (k - 1, k + 1) if 0 <= j < len(parts) and (parts[j].length, k) > (part.length, j)]
    return any(farthest(part, parts[j].shape) <= AGAIN * height for j in beside)


def _shared(one: Line, other: Line, height: float) -> tuple[float, float]:
    """How much to take off the beginning of each of two parts that begin at one cusp."""
    laps = _lap(one, other, height), _lap(other, one, height)
    if min(laps) < LAP * height:
        return 0.0, 0.0
    bends = _bend(one, laps[0], height), _bend(other, laps[1], height)
    return (0.0, laps[1]) if bends[0] <= bends[1] else (laps[0], 0.0)


def _lap(part: Line, other: Line, height: float) -> float:
    """How far a part lies along another from its beginning on."""
    s = np.union1d(part.along, np.linspace(0.0, part.length, 65))
    off = shapely.distance(shapely.points(part.at(s)), other.shape) > AGAIN * height
    return float(s[np.argmax(off) - 1]) if off.any() else part.length


def _bend(part: Line, s: float, height: float) -> float:
    """How much a part bends at a fork; more than any if it ends there."""
    reach = FOLD * height
    if part.length - s <= DOT * height:
        return np.inf
    here = part.at(s)
    return float(angle_between(here - part.at(max(s - reach, 0.0)), part.at(min(s + reach, part.length)) - here))


def _cusps(line: Line, height: float) -> Float[np.ndarray, " cusp"]:
    """Lengths at which the line turns back."""
    reach = min(DOT * height, 0.2 * line.length)
    s = line.along[1:-1]
    here = line.points[1:-1]
    turn = angle_between(here - line.at(np.maximum(s - reach, 0.0)), line.at(np.minimum(s + reach, line.length)) - here)
    found: list[float] = []
    for k in np.flatnonzero(turn > CUSP):
        if s[k] > reach and s[k] < line.length - reach and (not found or s[k] - found[-1] > reach):
            found.append(float(s[k]))
    return np.array(found)


def farthest(line: Line, shape: shapely.LineString) -> float:
    """The greatest distance of a line's points from another line."""
    s = np.union1d(line.along, np.linspace(0, line.length, 9))
    return float(shapely.distance(shapely.points(line.at(s)), shape).max())
