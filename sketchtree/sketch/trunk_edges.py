"""Are two lines the two sides of one trunk? People who draw a crown often draw its trunk as an outline.

Two lines, the only ones that reach the ground, are its sides if they run side by side: of like length, never much nearer
or farther than elsewhere between a fifth and four fifths of the way up, and close by their length. The trunk is their
middle, as wide as they are apart.
"""

import numpy as np

from sketchtree.sketch.lines import Line, extent

ON_GROUND = 0.15  # of H: both feet within this of the lowest point
LIKE = 0.55  # least ratio of the lengths
EVEN = (4.0, 2.0)  # most by which the distance between them varies: under a crown, without one
APART = (0.6, 0.25)  # widest mean distance, of their length: under a crown, without one
OVERLAP = 0.02  # of H: sides are farther apart than this


def trunk_of_edges(lines: list[Line], under_crown: bool) -> tuple[list[Line], tuple[Line, Line] | None]:
    """(the lines with two sides replaced by their middle, (middle, the shorter side) or None)."""
    height = extent(lines)
    lowest = min(float(line.points[:, 1].min()) for line in lines)
    upward = [line if line.points[0, 1] <= line.points[-1, 1] else line.reversed() for line in lines]
    standing = [k for k, line in enumerate(upward) if line.points[0, 1] - lowest <= ON_GROUND * height and _rises(line)]
    if len(standing) != 2:
        return lines, None
    longer, shorter = sorted((upward[k] for k in standing), key=lambda line: -line.length)
    middle = _middle(longer, shorter, height, not under_crown)
    if middle is None:
        return lines, None
    return [line for k, line in enumerate(lines) if k not in standing] + [middle], (middle, shorter)


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
