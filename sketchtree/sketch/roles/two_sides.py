"""Do two lines run side by side, as the two sides of one trunk?

They are of like length, never much nearer or farther than elsewhere between a fifth and four fifths of the way up, and close by
their length. Where they flare out along the ground they are cut. Without a crown they must be closer and more even, and open at the foot,
for two stems may stand side by side, and two limbs start at one place; less so if nothing grows from them and several strokes
start at their tops: the fronds of a palm.
"""

from dataclasses import dataclass

import numpy as np
import shapely

from sketchtree.sketch.joining.lines import Line

LIKE = {"crown": 0.55, "fronds": 0.55, "alone": 0.7}  # least ratio of the lengths
EVEN = {"crown": 4.0, "fronds": 3.0, "alone": 2.0}  # most by which the distance between them varies
APART = {"crown": 0.6, "fronds": 0.35, "alone": 0.25}  # widest mean distance, of their length
OPEN = 0.6  # of that distance: without a crown the feet are as far apart: two limbs start at one place
OVERLAP = 0.02  # of H: sides are farther apart than this
FLARE, FLAT = 0.6, 0.5  # part of a side that may run out along the ground, and the sine of the slope that ends it
STALLS = 0.3  # sine of the slope below which a side has stopped rising
FRONDS, AROUND = 3, 0.25  # strokes that start at the tops, within this part of the sides' length
BARE = (0.1, 0.8)  # the part of a side from which nothing else grows
LOW = 0.4  # of a crown's height: between several lines only those are sides that end below
MEETS = 0.02  # of H: pieces of one side meet end to end within this …


@dataclass(frozen=True, eq=False)
class Side:
    """What may be one side of a trunk."""

    line: Line  # upward, from the ground to where it stops rising
    rows: tuple[int, ...]  # the lines that drew it
    rest: tuple[Line, ...]  # how they go on from there


def side_of(line: Line, row: int, height: float, crowns) -> Side:
    """The part of an upward line that may be a trunk's side: without its flare, up to where it stops rising."""
    line = _unflared(line)
    s = np.linspace(0.0, line.length, 41)
    x, y = line.at(s).T
    window = min(max(int(np.ceil(40 * 0.1 * height / line.length)), 4), 40)
    stalls = y[window:] - y[:-window] < STALLS * (s[window:] - s[:-window])
    deep = np.zeros(41, bool)
    for points in crowns:
        (left, low), (right, high) = points.min(0), points.max(0)
        deep |= (x >= left) & (x <= right) & (y > low + LOW * (high - low))
    ends = np.flatnonzero(np.r_[stalls, np.zeros(window, bool)] | deep)
    ends = ends[ends >= 4]
    if len(ends) == 0:
        return Side(line, (row,), ())
    top = float(s[ends[0] - 1 if deep[ends[0]] else ends[0]])
    return Side(line.cut(0.0, top), (row,), (line.cut(top, line.length),) if top < line.length else ())


def middle_of_pair(a: Line, b: Line, rest: list[Line], height: float, crowns, *, several: bool) -> Line | None:
    """The middle of two sides; None if they are none."""
    longer, shorter = sorted((a, b), key=lambda line: -line.length)
    manner = "crown" if crowns else "fronds" if _carry_fronds(longer, shorter, rest, height) else "alone"
    if several and not (crowns and all(_ends_low(side, crowns) for side in (a, b))):
        return None
    return middle_of(longer, shorter, height, manner)


def _ends_low(side: Line, crowns) -> bool:
    """Whether a side ends in the lower part of the crown over it, or below."""
    x, y = side.points[-1]
    tops = [(c[:, 1].min(), c[:, 1].max()) for c in crowns if c[:, 0].min() <= x <= c[:, 0].max()]
    return all(y <= low + LOW * (high - low) for low, high in tops)


def _carry_fronds(a: Line, b: Line, rest: list[Line], height: float) -> bool:
    """Whether several strokes start at the tops of two sides and none from the sides themselves."""
    if not rest:
        return False
    ends = shapely.points(np.array([line.points[k] for line in rest for k in (0, -1)]))
    bare = [side.cut(BARE[0] * side.length, BARE[1] * side.length).shape for side in (a, b)]
    if any((shapely.distance(ends, side) <= MEETS * height).any() for side in bare):
        return False
    top = shapely.LineString([a.points[-1], b.points[-1]])
    near = (shapely.distance(ends, top) <= AROUND * a.length).reshape(-1, 2).any(1)
    closes = np.hypot(*(a.points[-1] - b.points[-1])) <= 1.2 * np.hypot(*(a.points[0] - b.points[0]))
    return bool(near.sum() >= FRONDS and closes)


def middle_of(longer: Line, shorter: Line, height: float, manner: str) -> Line | None:
    """The middle of two sides, as wide as they are apart; None if they do not run side by side."""
    if shorter.length < LIKE[manner] * longer.length:
        return None
    t = np.linspace(0.0, 1.0, 41)
    a, b = longer.at(t * longer.length), shorter.at(t * shorter.length)
    apart = np.hypot(*(a - b).T)
    inner = apart[(t >= 0.2) & (t <= 0.8)]
    sides = np.sign((a - b)[:, 0])[(t >= 0.2) & (t <= 0.8)]
    if inner.min() < OVERLAP * height or inner.max() > EVEN[manner] * inner.min() or abs(sides.sum()) < len(sides):
        return None
    if inner.mean() > APART[manner] * 0.5 * (longer.length + shorter.length):
        return None
    if manner == "alone" and apart[0] < OPEN * inner.mean():
        return None
    return Line(longer.row, longer.id, 0.5 * (a + b), np.minimum(apart, 1.5 * inner.mean()))


def _unflared(line: Line) -> Line:
    """An upward line without the part at its foot that runs along the ground or hooks up from it."""
    inner = line.along <= FLARE * line.length
    lowest = int(np.argmin(np.where(inner, line.points[:, 1], np.inf)))
    step = np.diff(line.points[lowest:], axis=0)
    flat = step[:, 1] < FLAT * np.hypot(step[:, 0], step[:, 1])
    s = float(line.along[lowest + (0 if flat.all() else int(np.argmin(flat)))])
    return line.cut(s, line.length) if 0 < s <= FLARE * line.length else line


def rises(line: Line) -> bool:
    return bool(line.points[-1, 1] - line.points[0, 1] > 0.4 * line.length)
