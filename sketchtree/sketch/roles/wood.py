"""Which lines do the branch strokes draw? Pen strokes as they are; shapes and outlines by the line down their middle.

Of a stroke that drew a crown only its legs count. Widths that a pen set are believed if they differ (`widths`);
those measured between the edges of a limb always. Painted shapes that are single strokes of a brush (`brush`) count as a pen's
where they are all thin; other shapes are limbs as thick as they were painted (`silhouette`).
"""

import dataclasses
from dataclasses import dataclass

import numpy as np

from sketchtree.sketch.joining.cleaning import as_line
from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.joining.widths import VARIES, drawn_widths
from sketchtree.sketch.roles.brush import blunt, even_border, middles, simplified
from sketchtree.sketch.roles.measures import Measures
from sketchtree.sketch.roles.outlined import limbs_of_outlines
from sketchtree.sketch.roles.rim import without_rims
from sketchtree.sketch.roles.silhouette import is_blob, middle_lines, with_holes
from sketchtree.sketch.strokes import Stroke

SLENDER = 0.14  # widest brush stroke, of its length; wider shapes are limbs: their medial axis is taken
MANY = 60  # painted shapes: among so many, every one that can be a brush stroke is
PEN = 0.025  # of the drawing's size: where the widest brush stroke is narrower, a pen or brush set the widths


@dataclass(frozen=True, eq=False)
class Wood:
    """The lines that the branch strokes draw."""

    lines: list[Line]
    measured: bool  # any widths that these lines have, or their trunk gets, are the limbs' own thickness; no pen set them
    sides: list[tuple[Line, Line]]  # (middle, the other side) of limbs that two lines drew
    bark: list[Line]  # what was drawn inside the outline of a limb
    holes: list[tuple[int, int]]  # (row of a hole, row of the painted shape that it is in)
    rims: list[Line]  # painted lines of which a part, or all, ran along a crown's outline


def wood_lines(
    m: Measures, rows: list[int], legs: dict[int, tuple[np.ndarray, ...]], pieces: list[tuple[int, Stroke]], crowns: list[np.ndarray]
) -> Wood:
    """The lines of these strokes, of the `legs` of strokes that drew a crown too, and of `pieces` of painted ones.

    `crowns`: outlines; painted lines that run along them are their rims.
    """
    strokes = m.strokes
    penned = [row for row in rows if not strokes[row].filled]
    lines, closed = _pen_lines(m, penned)
    lines += [line for row, parts in legs.items() for points in parts if (line := as_line(row, strokes[row].id, points, np.nan))]
    closed += [False] * (len(lines) - len(closed))
    plain = {id(line) for line in lines}
    outlined = limbs_of_outlines(lines, closed)
    lines = outlined.lines
    by_pen = any(np.isfinite(line.width).any() for line in lines if id(line) in plain and not strokes[line.row].wood)
    shapes = _shapes(strokes, [row for row in rows if strokes[row].filled])
    painted, thin = _painted_lines(strokes, shapes)
    painted += [line for row, piece in pieces for line in middle_lines(row, piece, [])]
    painted, rims = without_rims(painted, crowns)
    lines = lines + painted
    return Wood(lines, not by_pen and not thin, outlined.sides, outlined.bark, [(hole, outer) for outer, holes in shapes for hole in holes], rims)


def _pen_lines(m: Measures, rows: list[int]) -> tuple[list[Line], list[bool]]:
    """(lines of the strokes that were drawn with a pen, whether each is closed)."""
    strokes = [m.strokes[row] for row in rows]
    clean = m.shortest_step[rows] > 1e-9 * m.size[rows]
    lines, closed = [], []
    for row, stroke, width, plain in zip(rows, strokes, drawn_widths(strokes), clean.tolist(), strict=True):
        begun = np.nan if stroke.time is None else float(stroke.time[0])
        if plain and len(stroke.points) > 1:
            line = Line(row, stroke.id, stroke.points, np.full(len(stroke.points), width) if isinstance(width, float) else width, begun)
        else:
            line = as_line(row, stroke.id, stroke.points, width, begun)
        if line is not None:
            lines.append(line)
            closed.append(stroke.closed)
    return lines, closed


def _shapes(strokes: tuple[Stroke, ...], rows: list[int]) -> list[tuple[int, list[int]]]:
    """(row of a painted shape, rows of its holes)."""
    return [(rows[outer], [rows[hole] for hole in holes]) for outer, holes in with_holes([strokes[row] for row in rows])]


def _painted_lines(strokes: tuple[Stroke, ...], shapes: list[tuple[int, list[int]]]) -> tuple[list[Line], bool]:
    """(lines down the middle of painted shapes, whether all of them are thin strokes of a brush)."""
    if not shapes:
        return [], False
    whole = [outer for outer, holes in shapes if not holes and len(strokes[outer].points) > 3]
    brushed = _brushed([strokes[row] for row in whole], whole, many=len(shapes) > MANY)
    lines = []
    for row, holes in shapes:
        if row in brushed:
            lines.append(brushed[row])
        elif not is_blob(strokes[row]):
            lines += middle_lines(row, strokes[row], [strokes[hole] for hole in holes])
    if len(brushed) < len(lines) or not lines:
        return lines, False
    return _as_penned(lines, float(np.ptp(np.concatenate([strokes[row].points for row, _ in shapes]), axis=0).max()))


def _brushed(strokes: list[Stroke], rows: list[int], *, many: bool) -> dict[int, Line]:
    """Row → line, of the shapes that are single strokes of a brush."""
    if not strokes:
        return {}
    found = middles(np.array([even_border(stroke.points) for stroke in strokes]))
    length = np.hypot(*np.moveaxis(np.diff(found.points, axis=1), -1, 0)).sum(1)
    slender = found.single & (many | (found.width.mean(1) <= SLENDER * length))
    made = {}
    for k in np.flatnonzero(slender):
        points, width = simplified(found.points[k], blunt(found.points[k], found.width[k]), 0.05 * float(np.median(found.width[k])))
        made[rows[k]] = Line(rows[k], strokes[k].id, points, width)
    return made


def _as_penned(lines: list[Line], size: float) -> tuple[list[Line], bool]:
    """(the lines with a pen's widths where all are thin, whether they are): a line as wide throughout says nothing."""
    usual = np.array([float(np.median(line.width)) for line in lines])
    if usual.max() > PEN * size:
        return lines, False
    lines = [_trimmed(line, width) for line, width in zip(lines, usual, strict=True)]
    if usual.max() < VARIES * usual.min():
        lines = [dataclasses.replace(line, width=np.full(len(line.points), np.nan)) for line in lines]
    return lines, True


def _trimmed(line: Line, width: float) -> Line:
    """The line from where the pen was set down to where it was lifted: half a width inside its blunt ends."""
    ends = [0.5 * width, line.length - 0.5 * width]
    if line.length <= 3 * width:
        return line
    at = np.interp(ends, line.along, line.width)
    low = ends[0] if at[0] >= 0.6 * width else 0.0
    high = ends[1] if at[1] >= 0.6 * width else line.length
    return line.cut(low, high) if (low, high) != (0.0, line.length) else line
