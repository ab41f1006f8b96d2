"""From lines in pixels of the ink to strokes in pixels of the file, y up, in an order of their own.

A pen draws all its lines about alike: if the middle widths of all lines, weighted by length, lie within ONE_PEN of each other, every
stroke gets the pen's width and no pressure. Else the widths are those of the drawing: `pressure` is each stroke's profile. Where the
widest line is LIMB times the finest, or wider than BROAD of the drawing, or limbs were drawn by outlines, no pen set them: they are wood.
"""

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.sketch.raster.dots import Dotted
from sketchtree.sketch.raster.ink import Ink, extent
from sketchtree.sketch.raster.lines_of import Traced, thinned_out
from sketchtree.sketch.strokes import Stroke, StrokeKind

ONE_PEN = 1.5  # ratio of the 95 % to the 5 % width, weighted by length
LIMB = 2.5  # ratio of a limb's width to the fine lines', from which it is the limb's own
BROAD = 0.04  # of the drawing's larger side: no pen is as wide
ROUND_AND_ROUND = 2.5  # widths of the pen: the ends of a ring are no farther apart


def strokes_of(
    lines: list[Traced],
    dotted: list[Dotted],
    crowns: list[Float[np.ndarray, "point 2"]],
    filled: Bool[np.ndarray, "row col"] | None,
    ink: Ink,
    scale: float,
) -> tuple[Stroke, ...]:
    """The strokes, ids trace-1, trace-2, … from the longest line on, crowns last. `scale`: file pixels in one of the ink's."""
    lines = sorted((thinned_out(line, ink.pen) for line in lines), key=_rank)
    fine, pen = _widths(lines)
    broad = pen is not None and pen > BROAD * extent(ink.mask)
    strokes = []
    for line in lines:
        width = line.width
        wood = broad or (_is_limb(line, fine, filled) if pen is None or filled is not None else False)
        if pen is not None and not wood:
            width = np.full(len(line.points), pen)
        strokes.append(_stroke(f"trace-{len(strokes) + 1}", line, width, wood, scale))
    for curve in dotted:
        kind = StrokeKind.CROWN if curve.closed else StrokeKind.BRANCH
        strokes.append(
            Stroke(f"trace-{len(strokes) + 1}", curve.points * (scale, -scale), kind, closed=curve.closed, width=curve.width * scale)
        )
    for outline in crowns:
        strokes.append(Stroke(f"trace-{len(strokes) + 1}", outline * (1.0, -1.0), StrokeKind.CROWN, closed=True, filled=True))
    return tuple(strokes)


def _rank(line: Traced) -> tuple:
    return (-round(line.length, 3), *np.round(line.points[[0, -1]].ravel(), 3).tolist())


def _widths(lines: list[Traced]) -> tuple[float, float | None]:
    """(width of the finest lines, width of the one pen that drew all, or None), pixels."""
    if not lines:
        return 1.0, 1.0
    width = np.concatenate([line.width for line in lines])
    weight = np.concatenate([np.full(len(line.width), line.length / len(line.width)) for line in lines])
    order = np.argsort(width, kind="stable")
    share = np.cumsum(weight[order]) / weight.sum()
    low, middle, high = (float(width[order][np.searchsorted(share, q)]) for q in (0.05, 0.5, 0.95))
    return max(low, 1.0), middle if high <= ONE_PEN * low + 1.0 else None


def _is_limb(line: Traced, fine: float, filled: Bool[np.ndarray, "row col"] | None) -> bool:
    if filled is not None:
        at = np.floor(line.points).astype(int)
        at = np.clip(at, 0, np.array(filled.shape)[::-1] - 1)
        return bool(filled[at[:, 1], at[:, 0]].mean() >= 0.5)
    return float(np.quantile(line.width, 0.9)) >= LIMB * fine


def _stroke(stroke_id: str, line: Traced, width: Float[np.ndarray, " point"], wood: bool, scale: float) -> Stroke:
    widest = float(width.max())
    pressure = width / widest if np.ptp(width) > 0 else None
    return Stroke(stroke_id, line.points * (scale, -scale), closed=line.closed, width=widest * scale, pressure=pressure, wood=wood)
