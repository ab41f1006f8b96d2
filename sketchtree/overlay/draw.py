"""The overlay of one reading: the drawing with what was read of it, and a legend."""

import numpy as np
from jaxtyping import Float

from sketchtree.overlay.legend import legend
from sketchtree.overlay.marks import Placing, reading_marks
from sketchtree.overlay.scan import Scan
from sketchtree.overlay.scene import Scene, Underlay
from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch

LONG_SIDE = 1300.0  # pixels: the drawing's larger side
LEAST_HEIGHT = 760.0  # pixels: room for the legend
AROUND = 0.3  # of the drawing's size: more of an empty page is not shown
MARGIN = 40.0  # pixels around the drawing
LEGEND = 440.0  # pixels: width of the legend's column


def overlay(
    sketch: Sketch,
    graph: SketchGraph,
    *,
    underlay: Scan | None = None,
    long_side: float = LONG_SIDE,
    explained: bool = True,
) -> Scene:
    """The picture of what was read. `underlay`: the scanned drawing itself;
    `long_side`: pixels of the drawing's larger side; `explained`: with a legend beside it."""
    low, high = _bounds(sketch, graph)
    scale = long_side / float((high - low).max())
    width, height = (high - low) * scale
    tall = max(height, LEAST_HEIGHT) if explained else height
    place = Placing(low, high, MARGIN, MARGIN + (tall - height) / 2, scale)
    total = (2 * MARGIN + width + (LEGEND if explained else 0.0), 2 * MARGIN + tall)
    column, listed = legend(sketch.name, graph, 2 * MARGIN + width, MARGIN, total[1] - MARGIN / 2) if explained else ([], 0)
    marks = [*reading_marks(sketch, graph, place, numbered=listed), *column]
    return Scene(round(total[0]), round(total[1]), tuple(marks), f"How {sketch.name} was read", _underlay(underlay, place, total))


def _bounds(sketch: Sketch, graph: SketchGraph) -> tuple[Float[np.ndarray, " 2"], Float[np.ndarray, " 2"]]:
    """Corners of what is to be seen: the drawing, and its page as far as it lies around it."""
    points = np.concatenate([stroke.points for stroke in sketch.strokes] + [graph.xy, *graph.crown])
    low, high = points.min(0), points.max(0)
    size = max(float((high - low).max()), 1e-9)
    if sketch.page is not None:
        around = AROUND * size
        low = np.minimum(low, np.maximum(sketch.page[:2], low - around))
        high = np.maximum(high, np.minimum(sketch.page[2:], high + around))
    thin = np.maximum(0.15 * size - (high - low), 0.0) / 2
    return low - thin, high + thin


def _underlay(under: Scan | None, place: Placing, size: tuple[float, float]) -> Underlay | None:
    """The part of the scan that is to be seen."""
    if under is None:
        return None
    low, high = place([(0.0, 0.0), (under.width, -under.height)])
    count = np.array(under.pixels.shape[1::-1])
    step = (high - low) / count
    first = np.clip(np.floor(-low / step), 0, count - 1).astype(int)
    last = np.clip(np.ceil((np.array(size) - low) / step), first + 1, count).astype(int)
    (left, top), (width, height) = low + first * step, (last - first) * step
    shown = under.pixels[first[1] : last[1], first[0] : last[0]]
    return Underlay(shown, (float(left), float(top), float(width), float(height)))
