"""Are two lines the two sides of one trunk? People who draw a crown often draw its trunk as an outline.

Two lines that reach the ground are its sides if they run side by side: of like length, never much nearer
or farther than elsewhere between a fifth and four fifths of the way up, and close by their length. The trunk is their
middle, as wide as they are apart. Where they flare out along the ground they are cut; a side may be drawn in several pieces, and
one line may draw both: down, along the ground and up again; under a crown also up, across and down again.

Without a crown the sides must be closer and more even, for two stems may stand side by side; less so if nothing grows from
them and several strokes start at their tops: the fronds of a palm. What lies between the sides is bark.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.sketch.joining.lines import Line, angle_between, extent

ON_GROUND = 0.15  # of H: both feet within this of the lowest point
LIKE = 0.55  # least ratio of the lengths
EVEN = {"crown": 4.0, "fronds": 3.0, "alone": 2.0}  # most by which the distance between them varies
APART = {"crown": 0.6, "fronds": 0.35, "alone": 0.25}  # widest mean distance, of their length
OVERLAP = 0.02  # of H: sides are farther apart than this
ACROSS = 0.3  # of its height: a line that draws both sides is never farther than this from its turn between them
STEEP = 0.7  # sine of the slope of a side
FLARE, FLAT = 0.35, 0.5  # part of a side that may run out along the ground, and the sine of the slope that ends it
MEETS = 0.015  # of H: pieces of one side meet end to end within this …
BENDS = np.radians(60)  # … and bend no more there
FRONDS, AROUND = 3, 0.25  # strokes that start at the tops, within this part of the sides' length
BARE = (0.1, 0.8)  # the part of a side from which nothing else grows
LOW = 0.4  # of a crown's height: between several lines only those are sides that end below
INSIDE = 0.02  # of H: what lies this far outside the sides still counts as bark between them


@dataclass(frozen=True, eq=False)
class Trunks:
    """The lines of a drawing with the sides of trunks replaced."""

    lines: list[Line]
    sides: list[tuple[Line, Line]]  # (middle, the other side) where two strokes drew a trunk
    bark: list[Line]  # what was drawn between the sides


def trunks_of_edges(lines: list[Line], crowns: list[Float[np.ndarray, "point 2"]]) -> Trunks:
    """The lines with the sides of every trunk replaced by their middle. `crowns`: outlines found so far."""
    if not lines:
        return Trunks(lines, [], [])
    height = extent(lines)
    lowest = min(float(line.points[:, 1].min()) for line in lines)
    upward = [line if line.points[0, 1] <= line.points[-1, 1] else line.reversed() for line in lines]
    standing = [k for k, line in enumerate(upward) if line.points[0, 1] - lowest <= ON_GROUND * height and _rises(_unflared(line))]
    if len(standing) == 1:
        return _of_one_line(lines, lowest, height, bool(crowns))
    several = len(standing) > 2
    sides = {k: (upward[k], [k]) if several else _whole_side(k, upward, height) for k in standing}
    for a, b in _pairs(standing, upward):
        used = {*sides[a][1], *sides[b][1]}
        rest = [line for k, line in enumerate(lines) if k not in used]
        middle = _pair(sides[a][0], sides[b][0], rest, height, crowns, several=several)
        if middle is None or set(sides[a][1]) & set(sides[b][1]):
            continue
        trunk = _replaced(lines, used, middle, (sides[a][0], sides[b][0]), height)
        if len(trunk.bark) >= len(standing) - 2:
            return trunk
    return _of_one_line(lines, lowest, height, bool(crowns)) if len(standing) == 0 else Trunks(lines, [], [])


def _pairs(standing: list[int], lines: list[Line]) -> list[tuple[int, int]]:
    """Pairs of standing lines, those farthest apart first: what stands between is bark."""
    order = sorted(standing, key=lambda k: (lines[k].points[0, 0], lines[k].points[-1, 0]))
    spans = [(j - i, i) for i in range(len(order)) for j in range(i + 1, len(order))] if len(order) <= 12 else []
    return [(order[i], order[i + span]) for span, i in sorted(spans, key=lambda pair: (-pair[0], pair[1]))]


def _pair(a: Line, b: Line, rest: list[Line], height: float, crowns, *, several: bool) -> Line | None:
    """The middle of two sides; None if they are none."""
    longer, shorter = sorted((_unflared(a), _unflared(b)), key=lambda line: -line.length)
    manner = "crown" if crowns else "fronds" if _carry_fronds(longer, shorter, rest, height) else "alone"
    if several and not (crowns and all(_ends_low(side, crowns) for side in (a, b))):
        return None
    return _middle(longer, shorter, height, manner)


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


def _whole_side(k: int, lines: list[Line], height: float) -> tuple[Line, list[int]]:
    """(a side with the pieces that carry it on from its top, which lines these are)."""
    side, used = lines[k], [k]
    while len(used) < 4:
        best, least = None, BENDS
        for j, line in enumerate(lines):
            if j in used or line.length < 2 * MEETS * height:
                continue
            for piece in (line, line.reversed()):
                if np.hypot(*(piece.points[0] - side.points[-1])) <= MEETS * height:
                    bend = float(angle_between(side.direction(side.length, 0.1 * side.length), piece.direction(0.0, 0.1 * piece.length)))
                    best, least = ((j, piece), bend) if bend < least else (best, least)
        if best is None or len([1 for j, line in enumerate(lines) if j not in used and _ends_near(line, side.points[-1], MEETS * height)]) > 1:
            return side, used
        used.append(best[0])
        points = np.vstack([side.points, best[1].points[1:]])
        side = Line(side.row, side.id, points, np.r_[side.width, best[1].width[1:]])
    return side, used


def _ends_near(line: Line, point, reach: float) -> bool:
    return bool(min(np.hypot(*(line.points[0] - point)), np.hypot(*(line.points[-1] - point))) <= reach)


def _replaced(lines: list[Line], used: set[int], middle: Line, sides: tuple[Line, Line], height: float) -> Trunks:
    """The lines with a trunk's sides replaced; what lies between them apart."""
    between = shapely.make_valid(shapely.Polygon(np.vstack([sides[0].points, sides[1].points[::-1]]))).buffer(INSIDE * height)
    rest = [line for k, line in enumerate(lines) if k not in used]
    bark = [line for line in rest if line.shape.intersection(between).length >= 0.9 * line.length]
    others = [(middle, lines[k]) for k in sorted(used) if lines[k].row != middle.row]
    return Trunks([line for line in rest if not any(line is b for b in bark)] + [middle], others, bark)


def _of_one_line(lines: list[Line], lowest: float, height: float, under_crown: bool) -> Trunks:
    """The same for a trunk whose two sides are one line, the only line on the ground."""
    standing = [k for k, line in enumerate(lines) if line.points[:, 1].min() - lowest <= ON_GROUND * height]
    sides = _sides(lines[standing[0]], under_crown) if len(standing) == 1 else None
    middle = sides and _middle(*sorted(sides, key=lambda side: -side.length), height, "crown" if under_crown else "alone")
    return _replaced(lines, {standing[0]}, middle, sides, height) if middle else Trunks(lines, [], [])


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
    return (int(first), int(last)) if 0 < first <= last < len(points) - 1 else None


def _unflared(line: Line) -> Line:
    """An upward line without the part at its foot that runs along the ground."""
    step = np.diff(line.points, axis=0)
    flat = step[:, 1] < FLAT * np.hypot(step[:, 0], step[:, 1])
    first = int(np.argmin(flat)) if not flat.all() else 0
    s = line.along[first]
    return line.cut(s, line.length) if 0 < s <= FLARE * line.length else line


def _rises(line: Line) -> bool:
    return bool(line.points[-1, 1] - line.points[0, 1] > 0.4 * line.length)


def _middle(longer: Line, shorter: Line, height: float, manner: str) -> Line | None:
    """The middle of two sides, as wide as they are apart; None if they do not run side by side."""
    if shorter.length < LIKE * longer.length:
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
    return Line(longer.row, longer.id, 0.5 * (a + b), np.minimum(apart, 1.5 * inner.mean()))
