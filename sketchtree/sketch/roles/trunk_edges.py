"""Are two lines the two sides of one trunk? People who draw a crown often draw its trunk as an outline.

Two lines that reach the ground are its sides if they run side by side (`two_sides`). The trunk is their
middle, as wide as they are apart. A side may be drawn in several pieces, and
one line may draw both: down, along the ground and up again; under a crown also up, across and down again.
What lies between the sides, across from one to the other, or along one of them all the way, is bark.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.sketch.joining.folding import farthest
from sketchtree.sketch.joining.lines import Line, angle_between, corners, extent
from sketchtree.sketch.roles.two_sides import MEETS, Side, middle_of, middle_of_pair, rises, side_of

ON_GROUND = (0.15, 0.2)  # of H: both feet within this of the lowest point; under a crown
ACROSS = 0.3  # of its height: a line that draws both sides is never farther than this from its turn between them
STEEP = 0.7  # sine of the slope of a side
SHORT = 0.3  # of the longest line on the ground: shorter ones are no sides
MANY = 24  # lines on the ground: among more none are sides
PIECES = 4  # of one side
BENDS = np.radians(60)  # … and bend no more there
IN_CROWN = 0.8  # least part of what goes on above a side that lies in the crown, to belong to it
SPUR = 1.5  # what goes on above a side for less than this, of the trunk's width there, is its shoulder
CAP = 0.3  # of the trunk's width: a line across it starts and ends this near to its edges
ALONG = 0.1  # of the trunk's width: a line nowhere farther than this from a side, and longer than that, goes over it again
INSIDE = 0.02  # of H: what lies this far outside the sides still counts as bark between them


@dataclass(frozen=True, eq=False)
class Trunks:
    """The lines of a drawing with the sides of trunks replaced."""

    lines: list[Line]
    sides: list[tuple[Line, Line]]  # (middle, the other side) where two strokes drew a trunk
    bark: list[Line]  # what was drawn between the sides


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
    lowest = corners(lines)[0][:, 1]
    ground = float(lowest.min()) + ON_GROUND[bool(crowns)] * height
    near = np.flatnonzero(lowest <= ground).tolist()
    if len(near) == 0 or len(near) > MANY:
        return Trunks(lines, [], [])
    upward = [line if line.points[0, 1] <= line.points[-1, 1] else line.reversed() for line in lines]
    sides = {k: side_of(upward[k], k, height, crowns) for k in near}
    sides = {k: side for k, side in sides.items() if rises(side.line) and side.line.points[0, 1] <= ground}
    longest = max((side.line.length for side in sides.values()), default=0.0)
    sides = {k: side for k, side in sides.items() if side.line.length >= SHORT * longest}
    if len(sides) >= 2:
        whole = {} if len(sides) > 2 else {k: _whole_side(k, upward, height, crowns) for k in sides}
        found = _trunk_of(sides, lines, height, crowns) or (_trunk_of(whole, lines, height, crowns) if whole else None)
        if found is not None:
            return found
    return _of_one_line(lines, near, height, bool(crowns)) if len(near) == 1 else Trunks(lines, [], [])


def _trunk_of(sides: dict[int, Side], lines: list[Line], height: float, crowns) -> Trunks | None:
    """The lines with the first pair of sides that makes a trunk replaced; None if no pair does."""
    several = len(sides) > 2
    for a, b in _pairs(sides):
        used = {*a.rows, *b.rows}
        others = [line for k, line in enumerate(lines) if k not in used] + [*a.rest, *b.rest]
        middle = middle_of_pair(a.line, b.line, others, height, crowns, several=several)
        if middle is None or len(used) < len(a.rows) + len(b.rows):
            continue
        trunk = _replaced(lines, used, middle, (a, b), height, crowns)
        if len(trunk.bark) >= len(sides) - 2:
            return trunk
    return None


def _pairs(sides: dict[int, Side]) -> list[tuple[Side, Side]]:
    """Pairs of sides, those farthest apart first: what stands between is bark."""
    order = sorted(sides.values(), key=lambda side: (side.line.points[0, 0], side.line.points[-1, 0]))
    spans = [(j - i, i) for i in range(len(order)) for j in range(i + 1, len(order))]
    return [(order[i], order[i + span]) for span, i in sorted(spans, key=lambda pair: (-pair[0], pair[1]))]


def _whole_side(k: int, lines: list[Line], height: float, crowns) -> Side:
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
    one = side_of(side, k, height, crowns)
    return Side(one.line, tuple(used), one.rest)


def _ends_near(line: Line, point, reach: float) -> bool:
    return bool(min(np.hypot(*(line.points[0] - point)), np.hypot(*(line.points[-1] - point))) <= reach)


def _replaced(lines: list[Line], used: set[int], middle: Line, sides: tuple[Side, Side], height: float, crowns) -> Trunks:
    """The lines with a trunk's sides replaced; what lies between them apart, what goes on in the crown dropped."""
    ring = np.vstack([sides[0].line.points, sides[1].line.points[::-1]])
    between = shapely.make_valid(shapely.Polygon(ring)).buffer(INSIDE * height)
    kept = [line for k, line in enumerate(lines) if k not in used]
    caps = {id(line) for line in kept if _caps(line, [lines[k] for k in used], float(middle.width.max()))}
    near = ALONG * float(np.median(middle.width))
    again = {id(line) for line in kept if line.length > 4 * near and any(farthest(line, lines[k].shape) <= near for k in used)}
    bark = [line for line in kept if id(line) in caps | again or line.shape.intersection(between).length >= 0.9 * line.length]
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
    middle = sides and middle_of(*sorted(sides, key=lambda side: -side.length), height, "crown" if under_crown else "alone")
    if not middle:
        return Trunks(lines, [], [])
    return _replaced(lines, {near[0]}, middle, tuple(Side(side, (near[0],), ()) for side in sides), height, [])


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


