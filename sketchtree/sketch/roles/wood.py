"""Which lines do the branch strokes draw? Pen strokes as they are, painted shapes by the lines down their middle.

Of a stroke that drew a crown only its legs count. Widths that a pen set are believed if they differ (`widths`);
those measured between the edges of a shape always.
"""

import numpy as np

from sketchtree.sketch.joining.cleaning import as_line
from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.joining.widths import drawn_widths
from sketchtree.sketch.roles.silhouette import is_blob, middle_lines, with_holes
from sketchtree.sketch.strokes import Stroke


def wood_lines(strokes: tuple[Stroke, ...], rows: list[int], legs: dict[int, tuple[np.ndarray, ...]]) -> tuple[list[Line], bool]:
    """(the lines of these strokes and of the `legs`, whether their widths were measured on the drawing)."""
    drawn = [row for row in rows if not strokes[row].filled]
    penned = [strokes[row] for row in drawn]
    widths = drawn_widths(penned)
    lines = [as_line(row, stroke.id, stroke.points, width) for row, stroke, width in zip(drawn, penned, widths, strict=True)]
    lines += [as_line(row, strokes[row].id, points, np.nan) for row, parts in legs.items() for points in parts]
    lines = [line for line in lines if line is not None]
    by_pen = any(np.isfinite(line.width).any() for line in lines if not strokes[line.row].wood)
    painted = [row for row in rows if strokes[row].filled]
    for outer, holes in with_holes([strokes[row] for row in painted]):
        shape = strokes[painted[outer]]
        if not is_blob(shape):
            lines += middle_lines(painted[outer], shape, [strokes[painted[hole]] for hole in holes])
    known = any(np.isfinite(line.width).any() for line in lines)
    return lines, known and not by_pen
