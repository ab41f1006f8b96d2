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

ON_GROUND = (0.15, 0.2)  # of H: both feet within this of the lowest point; under a crown
LIKE = {"crown": 0.55, "fronds": 0.55, "alone": 0.7}  # least ratio of the lengths
EVEN = {"crown": 4.0, "fronds": 3.0, "alone": 2.0}  # most by which the distance between them varies
APART = {"crown": 0.6, "fronds": 0.35, "alone": 0.25}  # widest mean distance, of their length
OPEN = 0.6  # of that distance: without a crown the feet are as far apart: two limbs start at one place
OVERLAP = 0.02  # of H: sides are farther apart than this
ACROSS = 0.3  # of its height: a line that draws both sides is never farther than this from its turn between them
STEEP = 0.7  # sine of the slope of a side
FLARE, FLAT = 0.6, 0.5  # part of a side that may run out along the ground, and the sine of the slope that ends it
SHORT = 0.3  # of the longest line on the ground: shorter ones are no sides
STALLS = 0.3  # sine of the slope below which a side has stopped rising
MANY = 24  # lines on the ground: among more none are sides
PIECES = 4  # of one side
MEETS = 0.02  # of H: pieces of one side meet end to end within this …
BENDS = np.radians(60)  # … and bend no more there
FRONDS, AROUND = 3, 0.25  # strokes that start at the tops, within this part of the sides' length
BARE = (0.1, 0.8)  # the part of a side from which nothing else grows
LOW = 0.4  # of a crown's height: between several lines only those are sides that end below
IN_CROWN = 0.8  # least part of what goes on above a side that lies in the crown, to belong to it
SPUR = 1.5  # what goes on above a side for less than this, of the trunk's width there, is its shoulder
CAP = 0.3  # of the trunk's width: a line across it starts and ends this near to its edges
INSIDE = 0.02  # of H: what lies this far outside the sides still counts as bark between them


@dataclass(frozen=True, eq=False)
class Trunks:
    """The lines of a drawing with the sides of trunks replaced."""

    lines: list[Line]
    sides: list[tuple[Line, Line]]  # (middle, the other side) where two strokes drew a trunk
    bark: list[Line]  # what was drawn between the sides


@dataclass(frozen=True, eq=False)
class _Side:
    """What may be one side of a trunk."""

    line: Line  # upward, from the ground to where it stops rising
    rows: tuple[int, ...]  # the lines that drew it
    rest: tuple[Line, ...]  # how they go on from there


def trunks_of_edges(lines: list[Line], crowns: list[Float[np.ndarray, "point 2"]]) -> Trunks:
    """The lines with the sides of trunks replaced by their middle. `crowns`: outlines found so far; trees that stand
    side by side, each under crowns of its own, are looked at one by one."""
    trees = _side_by_side(lines, crowns)
    found = [_trunk_under(*tree) for tree in trees]
    return Trunks(*([one for trunks in found for one in getattr(trunks, name)] for name in ("lines", "sides", "bark")))


def _side_by_side(lines: list[Line], crowns: list[Float[np.ndarray, "point 2"]]) -> list[tuple[list[Line], list]]:
    """(lines, crowns) of every tree, where the crowns of trees share no abscissa and the feet stand below them."""
    spans: list[list] = []  # left, right, crowns
    for points in sorted(crowns, key=lambda points: float(points[:, 0].min())):
        left, right = float(points[:, 0].min()), float(points[:, 0].max())
        if spans and left <= spans[-1][1]:
            spans[-1] = [spans[-1][0], max(right, spans[-1][1]), [*spans[-1][2], points]]
        else:
            spans.append([left, right, [points]])
    if len(spans) < 2:
        return [(lines, crowns)]
    feet = [float(line.points[np.argmin(line.points[:, 1]), 0]) for line in lines]
    owner = [min(range(len(spans)), key=lambda k: max(spans[k][0] - x, x - spans[k][1], 0.0)) for x in feet]
    trees = [([line for line, mine in zip(lines, owner, strict=True) if mine == k], spans[k][2]) for k in range(len(spans))]
    low = [min((float(line.points[:, 1].min()) for line in tree), default=np.inf) for tree, _ in trees]
    height = extent(lines) if lines else 0.0
    return trees if max(low) - min(low) <= ON_GROUND[True] * height else [(lines, crowns)]


def _trunk_under(lines: list[Line], crowns: list[Float[np.ndarray, "point 2"]]) -> Trunks:
    """The same for one tree."""
    if not lines:
        return Trunks(lines, [], [])
    height = extent(lines)
    lowest = np.array([line.points[:, 1].min() for line in lines])
    ground = float(lowest.min()) + ON_GROUND[bool(crowns)] * height
    near = np.flatnonzero(lowest <= ground).tolist()
    if len(near) == 0 or len(near) > MANY:
        return Trunks(lines, [], [])
    upward = [line if line.points[0, 1] <= line.points[-1, 1] else line.reversed() for line in lines]
    sides = {k: _side(upward[k], k, height, crowns) for k in near}
    sides = {k: side for k, side in sides.items() if _rises(side.line) and side.line.points[0, 1] <= ground}
    longest = max((side.line.length for side in sides.values()), default=0.0)
    sides = {k: side for k, side in sides.items() if side.line.length >= SHORT * longest}
    if len(sides) >= 2:
        whole = {} if len(sides) > 2 else {k: _whole_side(k, upward, height, crowns) for k in sides}
        found = _trunk_of(sides, lines, height, crowns) or (_trunk_of(whole, lines, height, crowns) if whole else None)
        if found is not None:
            return found
    return _of_one_line(lines, near, height, bool(crowns)) if len(near) == 1 else Trunks(lines, [], [])


def _trunk_of(sides: dict[int, _Side], lines: list[Line], height: float, crowns) -> Trunks | None:
    """The lines with the first pair of sides that makes a trunk replaced; None if no pair does."""
    several = len(sides) > 2
    for a, b in _pairs(sides):
        used = {*a.rows, *b.rows}
        others = [line for k, line in enumerate(lines) if k not in used] + [*a.rest, *b.rest]
        middle = _pair(a.line, b.line, others, height, crowns, several=several)
        if middle is None or len(used) < len(a.rows) + len(b.rows):
            continue
        trunk = _replaced(lines, used, middle, (a, b), height, crowns)
        if len(trunk.bark) >= len(sides) - 2:
            return trunk
    return None


def _side(line: Line, row: int, height: float, crowns) -> _Side:
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
        return _Side(line, (row,), ())
    top = float(s[ends[0] - 1 if deep[ends[0]] else ends[0]])
    return _Side(line.cut(0.0, top), (row,), (line.cut(top, line.length),) if top < line.length else ())


def _pairs(sides: dict[int, _Side]) -> list[tuple[_Side, _Side]]:
    """Pairs of sides, those farthest apart first: what stands between is bark."""
    order = sorted(sides.values(), key=lambda side: (side.line.points[0, 0], side.line.points[-1, 0]))
    spans = [(j - i, i) for i in range(len(order)) for j in range(i + 1, len(order))]
    return [(order[i], order[i + span]) for span, i in sorted(spans, key=lambda pair: (-pair[0], pair[1]))]


def _pair(a: Line, b: Line, rest: list[Line], height: float, crowns, *, several: bool) -> Line | None:
    """The middle of two sides; None if they are none."""
    longer, shorter = sorted((a, b), key=lambda line: -line.length)
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


def _whole_side(k: int, lines: list[Line], height: float, crowns) -> _Side:
    """A side with the pieces that carry it on from its top."""
    side, used = lines[k], [k]
    while len(used) < PIECES:
        near = [j for j, line in enumerate(lines) if j not in used and line.length > 2 * MEETS * height and _ends_near(line, side.points[-1], MEETS * height)]
        if len(near) != 1:
            break
        piece = lines[near[0]]
        piece = piece if np.hypot(*(piece.points[0] - side.points[-1])) <= np.hypot(*(piece.points[-1] - side.points[-1])) else piece.reversed()
        if angle_between(side.direction(side.length, 0.1 * side.length), piece.direction(0.0, 0.1 * piece.length)) > BENDS:
            break
        used.append(near[0])
        side = Line(side.row, side.id, np.vstack([side.points, piece.points[1:]]), np.r_[side.width, piece.width[1:]])
    one = _side(side, k, height, crowns)
    return _Side(one.line, tuple(used), one.rest)


def _ends_near(line: Line, point, reach: float) -> bool:
    return bool(min(np.hypot(*(line.points[0] - point)), np.hypot(*(line.points[-1] - point))) <= reach)


def _replaced(lines: list[Line], used: set[int], middle: Line, sides: tuple[_Side, _Side], height: float, crowns) -> Trunks:
    """The lines with a trunk's sides replaced; what lies between them apart, what goes on in the crown dropped."""
    ring = np.vstack([sides[0].line.points, sides[1].line.points[::-1]])
    between = shapely.make_valid(shapely.Polygon(ring)).buffer(INSIDE * height)
    kept = [line for k, line in enumerate(lines) if k not in used]
    caps = {id(line) for line in kept if _caps(line, [lines[k] for k in used], float(middle.width.max()))}
    bark = [line for line in kept if id(line) in caps or line.shape.intersection(between).length >= 0.9 * line.length]
    crown = shapely.union_all([shapely.make_valid(shapely.Polygon(points)).buffer(INSIDE * height) for points in crowns])
    rest = [line for side in sides for line in side.rest if line.length > max(2 * INSIDE * height, SPUR * float(middle.width[-1]))]
    rest = [line for line in rest if line.shape.intersection(crown).length < IN_CROWN * line.length]
    others = [(middle, lines[k]) for k in sorted(used) if lines[k].row != middle.row]
    return Trunks([line for line in kept if not any(line is b for b in bark)] + rest + [middle], others, bark)


def _caps(line: Line, edges: list[Line], width: float) -> bool:
    """Whether a short line runs across from one edge to the other."""
    reach = CAP * width
    ends = shapely.points(line.points[[0, -1]])
    touched = [{k for k, edge in enumerate(edges) if shapely.distance(end, edge.shape) <= reach} for end in ends]
    return line.length <= 2 * width and all(touched) and len(touched[0] | touched[1]) > 1 and touched[0] != touched[1]


def _of_one_line(lines: list[Line], near: list[int], height: float, under_crown: bool) -> Trunks:
    """The same for a trunk whose two sides are one line, the only line on the ground."""
    sides = _sides(lines[near[0]], under_crown)
    middle = sides and _middle(*sorted(sides, key=lambda side: -side.length), height, "crown" if under_crown else "alone")
    if not middle:
        return Trunks(lines, [], [])
    return _replaced(lines, {near[0]}, middle, tuple(_Side(side, (near[0],), ()) for side in sides), height, [])


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
    """An upward line without the part at its foot that runs along the ground or hooks up from it."""
    inner = line.along <= FLARE * line.length
    lowest = int(np.argmin(np.where(inner, line.points[:, 1], np.inf)))
    step = np.diff(line.points[lowest:], axis=0)
    flat = step[:, 1] < FLAT * np.hypot(step[:, 0], step[:, 1])
    s = float(line.along[lowest + (0 if flat.all() else int(np.argmin(flat)))])
    return line.cut(s, line.length) if 0 < s <= FLARE * line.length else line


def _rises(line: Line) -> bool:
    return bool(line.points[-1, 1] - line.points[0, 1] > 0.4 * line.length)


def _middle(longer: Line, shorter: Line, height: float, manner: str) -> Line | None:
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
