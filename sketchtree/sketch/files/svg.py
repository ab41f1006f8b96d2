"""What strokes does an SVG file hold? The drawing as one sees it, in the user units of its viewBox, y up.

The document is walked as a browser paints it (`painted`). Clips, masks and filters are ignored: a stroke counts as it
was drawn. The viewBox is not mapped to the viewport, so that a point of the file keeps its numbers (y negated).
"""

import numpy as np
from cssselect2 import ElementWrapper

from sketchtree.errors import SketchError
from sketchtree.sketch.files.document import parse_xml
from sketchtree.sketch.files.outlines import flatten
from sketchtree.sketch.files.painted import Shape, Walk, extent_of
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

FLATNESS = 5e-4  # how far a flattened curve may lie from the true one, of the drawing's size


def read_svg(data: bytes, name: str, *, max_strokes: int = 20_000) -> Sketch:
    """The strokes of an SVG file, in document order. Raises SketchError."""
    root = parse_xml(data, name)
    if root.tag.rpartition("}")[2] != "svg":
        tag = root.tag.rpartition("}")[2]
        raise SketchError(f"{name} is XML, but its root is <{tag}>, not <svg>.", remedy="Export the drawing as SVG.")
    walk = Walk(ElementWrapper.from_xml_root(root), name, max_strokes)
    shapes = walk.shapes()
    strokes, warnings = _strokes(shapes, name, walk.view)
    return Sketch(strokes, name=name, units="px", warnings=tuple(walk.warnings) + warnings)


def _strokes(shapes: list[Shape], name: str, view: tuple[float, float]) -> tuple[tuple[Stroke, ...], tuple[str, ...]]:
    """Flatten every shape in one go and name the strokes."""
    entries = [(shape, k, path) for shape in shapes for k, path in enumerate(shape.paths)]
    if not entries:
        return (), ()
    tolerance = FLATNESS * extent_of([path for *_, path in entries])
    pieces = np.concatenate([path.cubics for *_, path in entries])
    points, steps = flatten(pieces, tolerance)
    ends = np.r_[0, np.cumsum(steps)][np.r_[0, np.cumsum([len(path.cubics) for *_, path in entries])]]
    strokes, warnings, used = [], [], set()
    order = {id(shape): number for number, shape in enumerate(shapes, 1)}
    for number, (shape, k, path) in enumerate(entries):
        line = np.concatenate([path.start[None], points[ends[number] : ends[number + 1]]]) * (1.0, -1.0)
        if path.closed and len(line) > 1 and (line[0] == line[-1]).all():
            line = line[:-1]
        if shape.filled and shape.kind is None and _is_page(line, view):
            warnings.append(f"A filled shape over the whole page ({shape.id or 'no id'}) was taken for the paper and left out.")
            continue
        stroke_id = _unique((shape.id or f"stroke-{order[id(shape)]}") + (f"-{k + 1}" if k else ""), used)
        try:
            strokes.append(
                Stroke(
                    stroke_id,
                    line,
                    shape.kind or StrokeKind.BRANCH,
                    labelled=shape.kind is not None,
                    closed=path.closed or shape.filled,
                    width=shape.width,
                    filled=shape.filled,
                )
            )
        except SketchError as error:
            raise SketchError(f"in {name}, {error.message}", stroke=stroke_id, remedy=error.remedy) from None
    return tuple(strokes), tuple(warnings)


def _unique(name: str, used: set[str]) -> str:
    free, k = name, 1
    while free in used:
        k += 1
        free = f"{name}-{k}"
    used.add(free)
    return free


def _is_page(line, view: tuple[float, float]) -> bool:
    low, high = line.min(0), line.max(0)
    corners = np.array([[x, y] for x in (low[0], high[0]) for y in (low[1], high[1])])
    gaps = np.abs(line[:, None] - corners).max(-1).min(1)
    return bool(len(line) == 4 and gaps.max() < 1e-6 * max(view) and (high - low >= 0.9 * np.array(view)).all())
