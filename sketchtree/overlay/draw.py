"""The overlay of one reading: the drawing with what was read of it, and a legend."""

import numpy as np
from jaxtyping import Float, UInt8

from sketchtree.overlay.legend import legend
from sketchtree.overlay.marks import Placing, reading_marks
from sketchtree.overlay.scene import Scene, Underlay
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch

LONG_SIDE = 1300.0  # pixels: the drawing's larger side
LEAST_HEIGHT = 760.0  # pixels: room for the legend
MARGIN = 40.0  # pixels around the drawing
LEGEND = 440.0  # pixels: width of the legend's column


def overlay(
    sketch: Sketch,
    graph: SketchGraph,
    *,
    underlay: UInt8[np.ndarray, "row column 3"] | None = None,
    long_side: float = LONG_SIDE,
    explained: bool = True,
) -> Scene:
    """The picture of what was read. `underlay`: the scanned drawing itself, whose pixels are the sketch's units;
    `long_side`: pixels of the drawing's larger side; `explained`: with a legend beside it."""
    low, high = _bounds(sketch, graph)
    scale = long_side / float((high - low).max())
    width, height = (high - low) * scale
    tall = max(height, LEAST_HEIGHT) if explained else height
    place = Placing(low, high, MARGIN, MARGIN + (tall - height) / 2, scale)
    total = (2 * MARGIN + width + (LEGEND if explained else 0.0), 2 * MARGIN + tall)
    column, listed = legend(sketch.name, graph, 2 * MARGIN + width, MARGIN, total[1] - MARGIN / 2) if explained else ([], 0)
    marks = [*reading_marks(sketch, graph, place, numbered=listed), *column]
    return Scene(round(total[0]), round(total[1]), tuple(marks), f"How {sketch.name} was read", _underlay(underlay, place))


def _bounds(sketch: Sketch, graph: SketchGraph) -> tuple[Float[np.ndarray, " 2"], Float[np.ndarray, " 2"]]:
    """Corners of what is to be seen; the page too, unless it is far larger than the drawing."""
    points = np.concatenate([stroke.points for stroke in sketch.strokes] + [graph.xy, *graph.crown])
    low, high = points.min(0), points.max(0)
    size = max(float((high - low).max()), 1e-9)
    if sketch.page is not None:
        page_low, page_high = np.array(sketch.page[:2]), np.array(sketch.page[2:])
        near = (page_low > low - 0.3 * size) & (page_high < high + 0.3 * size)
        if near.all():
            low, high = np.minimum(low, page_low), np.maximum(high, page_high)
    thin = np.maximum(0.15 * size - (high - low), 0.0) / 2
    return low - thin, high + thin


def _underlay(pixels: UInt8[np.ndarray, "row column 3"] | None, place: Placing) -> Underlay | None:
    if pixels is None:
        return None
    rows, columns = pixels.shape[:2]
    (left, top), (right, bottom) = place([(0.0, 0.0), (float(columns), -float(rows))])
    return Underlay(pixels, (float(left), float(top), float(right - left), float(bottom - top)))
