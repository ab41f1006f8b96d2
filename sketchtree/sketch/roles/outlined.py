"""Which lines are the sides of a limb rather than limbs? Limbs drawn by their outline become their middle line.

Three ways to draw one: a closed thin outline; one line out and back again, open at the foot; two lines that meet at
the tip, where much of the drawing is drawn so. Whoever does not lift the pen goes on from there as the next limb. All of them, once closed, enclose a slender shape (`brush`). What is wider, or encloses next to nothing, stays
as it was drawn: a limb that arches over, or a line gone over twice.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.sketch.joining.lines import Line, ends_of, extent, turning
from sketchtree.sketch.roles.brush import Middles, even_border, middles, simplified, squared

MEET = 0.015  # of H: the two sides meet at the tip
FREE = 0.02  # of H: and nothing else comes nearer to it
CROWD, FEW = 5, 1000  # so many ends in one place are of three lines or more; looked for where there are more ends than that
HELD = 0.05  # of H: at the foot something else does
NARROW = 0.12  # widest mean distance of the sides of an open outline, of its length
PAIRED = 0.25  # the same of two lines that meet at the tip
WIDE = 0.008  # of H: sides nearer to each other are one line drawn twice
FEET = 0.45  # farthest the two feet lie apart, of the length
HABIT = (2, 0.35)  # pairs, and their part of all that is drawn: two limbs' tips may meet by chance, but seldom everywhere
LIKE = 0.5  # least ratio of the lengths of two sides
SHUT = 0.6  # an outline whose ends come this near, of its mean width, is as good as closed
WITHIN = 0.9  # least part of a line inside the outline of a limb that makes it bark
LEAVES, RETURNS = 0.1, 0.1  # of H: an outline leads so far from its stroke's end; and back, to this part of that, before its stroke goes on
OPENED = 0.03  # of H: least mean width of such an outline: a trembling hand comes back past where it was by less
PINCHED = 0.5  # of its middle width: an outline that is no wider where its stroke begins, in its middle part, is two limbs from there
LOOSE = 2.5  # widest opening of an outline at the foot, of its mean width


@dataclass(frozen=True, eq=False)
class Outlined:
    """The lines of a drawing with the outlines of limbs replaced by their middle."""

    lines: list[Line]
    sides: list[tuple[Line, Line]]  # (middle, the other side) where two lines drew a limb
    bark: list[Line]  # what was drawn inside an outline


def limbs_of_outlines(lines: list[Line], closed: list[bool]) -> Outlined:
    """The lines, those that outline a limb replaced by its middle. `closed`: lines that the file closes."""
    if not lines:
        return Outlined(lines, [], [])
    height = extent(lines)
    lines, closed = _loops_apart(lines, closed, height)
    lines, areas = _single_outlines(lines, closed, height)
    if not areas:
        return Outlined(*_pairs(lines, height), [])
    inside = shapely.union_all(list(areas.values()))
    outer = {lines[k].row for k in areas}
    others = [k for k, line in enumerate(lines) if line.row not in outer]
    bark = [k for k in others if lines[k].shape.intersection(inside).length >= WITHIN * lines[k].length]
    kept, sides = _pairs([line for k, line in enumerate(lines) if k not in bark], height)
    return Outlined(kept, sides, [lines[k] for k in bark])


def _loops_apart(lines: list[Line], closed: list[bool], height: float) -> tuple[list[Line], list[bool]]:
    """The lines, those that outline a limb and then go on as another cut there; which are closed now."""
    turns = turning(lines) >= np.pi  # what comes back turns round
    parts = [_loop_and_rest(line, height) if turn and not shut else () for line, turn, shut in zip(lines, turns, closed, strict=True)]
    cut = [part for part in parts if part]
    if not cut:
        return lines, closed
    found = middles(np.array([even_border(loop.points) for loop, _ in cut]))
    limbs = {id(loop) for n, (loop, _) in enumerate(cut) if _is_limb(found, n, np.inf, height) and found.width[n].mean() >= OPENED * height}
    whole = [part if part and id(part[0]) in limbs else (line,) for line, part in zip(lines, parts, strict=True)]
    flags = [(True, False) if len(part) == 2 else (shut,) for part, shut in zip(whole, closed, strict=True)]
    return [line for part in whole for line in part], [flag for part in flags for flag in part]


def _loop_and_rest(line: Line, height: float) -> tuple[Line, ...]:
    """(the part of a line that leaves one of its ends and comes back to it, what goes on from there); () if it does neither."""
    if line.length < LEAVES * height:
        return ()
    s = np.linspace(0.0, line.length, 129)
    at = line.at(s)
    for start in (0, -1):
        away = np.hypot(*(at - line.points[start]).T)[:: 1 if start == 0 else -1]
        back = (np.maximum.accumulate(away) >= LEAVES * height) & (away <= RETURNS * np.maximum.accumulate(away))
        if not back.any():
            continue
        first = int(np.argmax(back))
        run = first + int(np.argmin(np.r_[back[first:], False]))
        turn = first + int(np.argmin(away[first:run]))
        if away[turn:].max() >= LEAVES * height:
            place = float(s[turn]) if start == 0 else float(line.length - s[turn])
            parts = line.cut(0.0, place), line.cut(place, line.length)
            return parts if start == 0 else parts[::-1]
    return ()


def _single_outlines(lines: list[Line], closed: list[bool], height: float) -> tuple[list[Line], dict[int, shapely.Geometry]]:
    """(lines, those that run out and back replaced by their middle; of those that are closed, the area inside)."""
    length = np.array([line.length for line in lines])
    ends = ends_of(lines)
    opening = np.hypot(*(ends[::2] - ends[1::2]).T)
    back = (np.array(closed) | (opening <= 0.3 * length)) & (length > 4 * WIDE * height)
    rows = [k for k in np.flatnonzero(back) if len(lines[k].points) > 3]
    if not rows:
        return lines, {}
    found = middles(np.array([even_border(lines[k].points) for k in rows]))
    result, areas = list(lines), {}
    more: list[Line] = []
    for n, k in enumerate(rows):
        gap = opening[k] / max(float(found.width[n].mean()), 1e-300)
        whole = closed[k] or gap <= SHUT
        if _is_limb(found, n, np.inf if whole else NARROW, height) and (whole or gap <= LOOSE):
            result[k], *others = _parted(_middle_line(lines[k], found, n, height), 0.5 * (lines[k].points[0] + lines[k].points[-1]))
            more += others
            if whole:
                areas[int(k)] = shapely.make_valid(shapely.Polygon(lines[k].points)).buffer(WIDE * height)
    return result + more, areas


def _parted(middle: Line, start: Float[np.ndarray, " 2"]) -> list[Line]:
    """Two limbs where the middle line of an outline is pinched at the place where its stroke begins and ends: both start there."""
    s = float(shapely.line_locate_point(middle.shape, shapely.Point(start)))
    near = middle.cut(max(s - 0.05 * middle.length, 0.0), min(s + 0.05 * middle.length, middle.length))
    if not 0.2 * middle.length <= s <= 0.8 * middle.length or near.width.min() > PINCHED * np.median(middle.width):
        return [middle]
    return [middle.cut(0.0, s).reversed(), middle.cut(s, middle.length)]


def _pairs(lines: list[Line], height: float) -> tuple[list[Line], list[tuple[Line, Line]]]:
    """Two lines that meet at a free tip, and not far apart at the foot, become their middle."""
    length = np.array([line.length for line in lines])
    ends = ends_of(lines)
    pairs = _meeting(ends, length, height)
    if length[np.unique(pairs // 2)].sum() < HABIT[1] * length.sum() or len(pairs) < HABIT[0]:
        return lines, []
    pairs = pairs[_free_and_held(lines, ends, pairs, height)]
    if len(pairs) < HABIT[0]:
        return lines, []
    sides = [(_towards(lines[a // 2], a), _towards(lines[b // 2], b)) for a, b in pairs.tolist()]
    found = middles(np.array([even_border(np.vstack([one.points, other.points[::-1]])) for one, other in sides]))
    limb = np.array([_is_limb(found, n, PAIRED, height) for n in range(len(pairs))])
    used: set[int] = set()
    made: list[tuple[Line, Line]] = []
    for n in np.argsort(found.width.mean(1), kind="stable"):
        a, b = (pairs[n] // 2).tolist()
        if limb[n] and not used & {a, b}:
            used |= {a, b}
            longer, shorter = sorted(sides[n], key=lambda side: -side.length)
            made.append((_middle_line(longer, found, n, height), shorter))
    if len(made) < HABIT[0] or length[sorted(used)].sum() < HABIT[1] * length.sum():
        return lines, []
    return [line for k, line in enumerate(lines) if k not in used] + [middle for middle, _ in made], made


def _towards(line: Line, end: int) -> Line:
    """The line drawn so that it ends at this end of it: odd, its last point; even, its first."""
    return line if end % 2 else line.reversed()


def _is_limb(found: Middles, n: int, limit: float, height: float) -> bool:
    mean = float(found.width[n].mean())
    length = float(np.hypot(*np.diff(found.points[n], axis=0).T).sum())
    return bool(found.single[n] and mean <= limit * length and mean >= WIDE * height)


def _middle_line(line: Line, found: Middles, n: int, height: float) -> Line:
    points, width = simplified(*squared(found.points[n], found.width[n]), 1e-3 * height)
    return Line(line.row, line.id, points, width)


def _meeting(ends: Float[np.ndarray, "end 2"], length: Float[np.ndarray, " line"], height: float) -> Int[np.ndarray, "pair 2"]:
    """Pairs of ends (two a line) that meet, of lines alike in length whose other ends are not far apart."""
    alone = np.arange(len(ends)) if len(ends) <= FEW else np.flatnonzero(~_crowded(ends, height))
    pairs = alone[cKDTree(ends[alone]).query_pairs(MEET * height, output_type="ndarray")]
    a, b = pairs.T // 2
    feet = np.hypot(*(ends[pairs[:, 0] ^ 1] - ends[pairs[:, 1] ^ 1]).T)
    alike = np.minimum(length[a], length[b]) >= LIKE * np.maximum(length[a], length[b])
    return pairs[(a != b) & alike & (feet <= FEET * np.minimum(length[a], length[b])) & (feet >= WIDE * height)]


def _crowded(ends: Float[np.ndarray, "end 2"], height: float) -> np.ndarray:
    """Ends so near to those of two other lines that they are no free tips; without them thousands in one place make no pairs."""
    near, _ = cKDTree(ends).query(ends, k=CROWD, distance_upper_bound=(FREE - 0.5 * MEET) * height)
    return np.isfinite(near).all(1)


def _free_and_held(lines: list[Line], ends, pairs, height: float) -> np.ndarray:
    """Whether nothing but the pair comes near its tip, and something else near its feet."""
    index = np.repeat(np.arange(len(lines)), [len(line.points) for line in lines])
    tree = shapely.STRtree(shapely.linestrings(np.concatenate([line.points for line in lines]), indices=index))

    def others_near(which, points, reach):
        row, line = tree.query(shapely.points(points), predicate="dwithin", distance=reach)
        own = (line == which[row, 0] // 2) | (line == which[row, 1] // 2)
        near = np.zeros(len(which), bool)
        near[row[~own]] = True
        return near

    good = ~others_near(pairs, 0.5 * (ends[pairs[:, 0]] + ends[pairs[:, 1]]), FREE * height)
    free = pairs[good]
    held = [others_near(free, ends[free[:, k] ^ 1], HELD * height) for k in (0, 1)]
    good[good] = held[0] | held[1]
    return good
