"""Drawings by a shaky hand, and how two graphs of one drawing compare. Shared by this folder's tests."""

from pathlib import Path

import numpy as np
import shapely

from sketchtree.sketch.graph import SketchGraph
from sketchtree.sketch.strokes import Sketch, Stroke

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
SHARED = Path(__file__).resolve().parents[2].parent / "shared" / "data"


def redraw(sketch: Sketch, change) -> Sketch:
    """The sketch with `change(stroke) -> [strokes]` done to every stroke."""
    return Sketch(tuple(new for stroke in sketch.strokes for new in change(stroke)), name=sketch.name, units=sketch.units)


def moved(stroke: Stroke, points: np.ndarray, suffix: str = "") -> Stroke:
    """The stroke with other points (pressure and time dropped where their number changes)."""
    same = len(points) == len(stroke.points)
    return Stroke(
        stroke.id + suffix,
        points,
        stroke.kind,
        labelled=stroke.labelled,
        closed=stroke.closed,
        width=stroke.width,
        pressure=stroke.pressure if same else None,
        filled=stroke.filled,
    )


def parents(graph: SketchGraph) -> dict[str, str | None]:
    """For every limb the limb it grows from, each named after the first stroke that drew it."""
    name = [graph.stroke_ids[graph.stroke[row]].removesuffix("~") for row in graph.limb_first]
    return {name[k]: None if up < 0 else name[up] for k, up in enumerate(graph.limb_parent)}


def farthest(a: SketchGraph, b: SketchGraph) -> float:
    """Greatest distance of a node of `a` from the nearest node of `b`, of H."""
    gaps = np.hypot(*(a.xy[:, None] - b.xy[None]).transpose(2, 0, 1)).min(1)
    return float(gaps.max() / a.height)


def polyline_distance(a: SketchGraph, b: SketchGraph) -> float:
    """Greatest distance of a node of `a` from the drawn curves of `b`, of H."""
    curves = shapely.union_all([shapely.LineString(b.curve(row)) for row in range(len(b)) if not b.is_base[row]])
    return float(shapely.distance(shapely.points(a.xy), curves).max() / a.height)
