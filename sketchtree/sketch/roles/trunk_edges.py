"""Are two lines the two sides of one trunk? People who draw a crown often draw its trunk as an outline.

Two lines, the only ones that reach the ground, are its sides if they run side by side: of like length, never much nearer
or farther than elsewhere between a fifth and four fifths of the way up, and close by their length. The trunk is their
middle, as wide as they are apart. One line may draw both: down, along the ground and up again; under a crown also up,
across and down again.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.joining.lines import Line, extent

ON_GROUND = 0.15  # of H: both feet within this of the lowest point
LIKE = 0.55  # least ratio of the lengths
EVEN = (4.0, 2.0)  # most by which the distance between them varies: under a crown, without one
APART = (0.6, 0.25)  # widest mean distance, of their length: under a crown, without one
OVERLAP = 0.02  # of H: sides are farther apart than this
ACROSS = 0.3  # of its height: a line that draws both sides is never farther than this from its turn between them
STEEP = 0.7  # sine of the slope of a side


def trunk_of_edges(lines: list[Line], under_crown: bool) -> tuple[list[Line], tuple[Line, Line] | None]:
    """(the lines with two sides replaced by their middle, (middle, the shorter side) or None)."""
    height = extent(lines)
    lowest = min(float(line.points[:, 1].min()) for line in lines)
    upward = [line if line.points[0, 1] <= line.points[-1, 1] else line.reversed() for line in lines]
    standing = [k for k, line in enumerate(upward) if line.points[0, 1] - lowest <= ON_GROUND * height and _rises(line)]
    if len(standing) != 2:
        return _of_one_line(lines, lowest, height, under_crown)
    longer, shorter = sorted((upward[k] for k in standing), key=lambda line: -line.length)
    middle = _middle(longer, shorter, height, not under_crown)
    if middle is None:
        return lines, None
    return [line for k, line in enumerate(lines) if k not in standing] + [middle], (middle, shorter)


def _of_one_line(lines: list[Line], lowest: float, height: float, under_crown: bool):
    """The same for a trunk whose two sides are one line, the only line on the ground."""
    standing = [k for k, line in enumerate(lines) if line.points[:, 1].min() - lowest <= ON_GROUND * height]
    sides = _sides(lines[standing[0]], under_crown) if len(standing) == 1 else None
    middle = sides and _middle(*sorted(sides, key=lambda side: -side.length), height, not under_crown)
    if not middle:
        return lines, None
    return [line for k, line in enumerate(lines) if k not in standing] + [middle], (middle, sides[1])


def _sides(line: Line, under_crown: bool) -> tuple[Line, Line] | None:
    """Both halves of a line that turns once at the ground (under a crown: or once at the top), drawn upward."""
    for up in (1.0, -1.0) if under_crown else (1.0,):
        turn = _turn(line.points * (1.0, up))
        if turn is not None:
            halves = line.cut(0.0, line.along[turn[0]]), line.cut(line.along[turn[1]], line.length)
            return (halves[0].reversed(), halves[1]) if up > 0 else (halves[0], halves[1].reversed())
    return None


def _turn(points: Float[np.ndarray, "point 2"]) -> tuple[int, int] | None:
    """Where a line that comes down, runs along its lowest part and goes up again begins and ends that run."""
    step = np.diff(points, axis=0)
    slope = step[:, 1] / np.hypot(step[:, 0], step[:, 1])
    rise = points[:, 1] - points[:, 1].min()
    low = np.flatnonzero(rise <= ACROSS * rise.max())
    if min(rise[0], rise[-1]) < 2 * ACROSS * rise.max() or low[-1] - low[0] >= len(low):
        return None
    first = next((k for k in low if slope[k] > -STEEP), low[-1])
    last = next((k for k in low[::-1] if slope[k - 1] < STEEP), low[0])
    return (int(first), int(last)) if first <= last else None


def _rises(line: Line) -> bool:
    return bool(line.points[-1, 1] - line.points[0, 1] > 0.4 * line.length)


def _middle(longer: Line, shorter: Line, height: float, alone: bool) -> Line | None:
    if shorter.length < LIKE * longer.length:
        return None
    t = np.linspace(0.0, 1.0, 41)
    a, b = longer.at(t * longer.length), shorter.at(t * shorter.length)
    apart = np.hypot(*(a - b).T)
    inner = apart[(t >= 0.2) & (t <= 0.8)]
    sides = np.sign((a - b)[:, 0])[(t >= 0.2) & (t <= 0.8)]
    if inner.min() < OVERLAP * height or inner.max() > EVEN[alone] * inner.min() or abs(sides.sum()) < len(sides):
        return None
    if inner.mean() > APART[alone] * 0.5 * (longer.length + shorter.length):
        return None
    return Line(longer.row, longer.id, 0.5 * (a + b), np.minimum(apart, 1.5 * inner.mean()))
