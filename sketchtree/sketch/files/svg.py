"""What strokes does an SVG file hold? The drawing as one sees it, in the user units of its viewBox, y up.

The document is walked as a browser paints it (`painted`), curves become polylines, and what clips hide is cut off. The
viewBox is not mapped to the viewport, so that a point of the file keeps its numbers (y negated).
"""

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.sketch.files.areas import inside
from sketchtree.sketch.files.document import local_name, parse_xml
from sketchtree.sketch.files.ids import unique
from sketchtree.sketch.files.limits import MAX_MB, MAX_STROKES
from sketchtree.sketch.files.outlines import flatten
from sketchtree.sketch.files.painted import Shape, Walk, extent_of
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

FLATNESS = 5e-4  # how far a flattened curve may lie from the true one, of the drawing's size
_PAGE = 0.9  # of the page's width and height, from which a painted rectangle is the paper


def read_svg(data: bytes, name: str, *, max_strokes: int = MAX_STROKES, max_mb: float = MAX_MB) -> Sketch:
    """The strokes of an SVG file, in document order. Raises SketchError."""
    root = parse_xml(data, name, max_mb=max_mb)
    if local_name(root.tag) != "svg":
        tag = root.tag.rpartition("}")[2]
        raise SketchError(f"{name} is XML, but its root is <{tag[:40]}>, not <svg>.", remedy="Export the drawing as SVG.")
    with np.errstate(all="ignore"):  # numbers too large are refused by name
        walk = Walk(root, name, max_strokes)
        strokes, warnings = _strokes(walk.shapes(), walk)
    x, y, width, height = walk.box
    paper = (x, 0.0 - y - height, x + width, 0.0 - y) if walk.has_page else None
    return Sketch(strokes, name=name, units="px", page=paper, warnings=walk.warnings() + warnings)


def _strokes(shapes: list[Shape], walk: Walk) -> tuple[tuple[Stroke, ...], tuple[str, ...]]:
    """Flatten every shape in one go, cut what is clipped, and name the strokes."""
    lines = _flattened(shapes)
    strokes: list[Stroke] = []
    warnings: list[str] = []
    used: set[str] = set()
    cut = 0
    for number, (shape, parts) in enumerate(zip(shapes, lines, strict=True), 1):
        if shape.clip is not None:
            whole = parts
            parts = [(line, closed, press) for drawn in whole for line, closed, press in _clipped(shape, *drawn)]
            if not parts and whole:
                walk.left_out.add("a shape outside its clip")
            cut += len(parts) > 0 and any(a is not b for (a, *_), (b, *_) in zip(parts, whole, strict=False)) or 0 < len(parts) != len(whole)
        own = shape.element.get("id")
        for k, (line, closed, press) in enumerate(parts):
            if shape.filled and shape.naming.kind is None and _is_page(line, walk.view):
                warnings.append(f"A filled shape over the whole page ({own or 'no id'}) was taken for the paper and left out.")
                continue
            stroke_id = unique((own or f"stroke-{number}") + (f"-{k + 1}" if k else ""), used)
            strokes.append(_stroke(stroke_id, shape, line, closed, press, walk.name))
    if cut:
        warnings.append(f"{cut} {'shape was' if cut == 1 else 'shapes were'} cut where a clip or mask hides the rest.")
    return tuple(strokes), tuple(warnings)


def _stroke(stroke_id: str, shape: Shape, line, closed: bool, press, name: str) -> Stroke:
    kind = shape.naming.kind
    try:
        return Stroke(
            stroke_id,
            line * (1.0, -1.0),
            kind or StrokeKind.BRANCH,
            labelled=kind is not None,
            closed=closed or shape.filled,
            width=shape.width,
            pressure=press,
            filled=shape.filled,
            layer=shape.naming.layer,
        )
    except SketchError as error:
        raise SketchError(f"in {name}, {error.message}", stroke=stroke_id, remedy=error.remedy) from None


def _flattened(shapes: list[Shape]) -> list[list]:
    """For every shape its polylines: (points (y down), closed, pressure or None)."""
    paths = [path for shape in shapes for path in shape.paths]
    if not paths:
        return [[] for _ in shapes]
    points, steps = flatten(np.concatenate([path.cubics for path in paths]), FLATNESS * extent_of(paths))
    first = np.r_[0, np.cumsum(steps)]
    ends = np.r_[0, np.cumsum([len(path.cubics) for path in paths])]
    found, k = [], 0
    for shape in shapes:
        lines = []
        for path in shape.paths:
            line = np.concatenate([path.start[None], points[first[ends[k]] : first[ends[k + 1]]]])
            press = _pressure(shape, steps[ends[k] : ends[k + 1]])
            if path.closed and len(line) > 1 and (line[0] == line[-1]).all():
                line, press = line[:-1], None if press is None else press[:-1]
            lines.append((line, path.closed, press))
            k += 1
        found.append(lines)
    return found


def _pressure(shape: Shape, steps) -> np.ndarray | None:
    """The width of a thickened line at its points, of its greatest."""
    if shape.spine is None or shape.spine.knots is None:
        return None
    done = np.repeat(np.arange(len(steps)), steps)
    within = np.arange(len(done)) - np.repeat(np.cumsum(steps) - steps, steps) + 1
    times = np.r_[0.0, done + within / np.repeat(steps, steps)]
    return np.interp(times, *shape.spine.knots.T) / shape.spine.width


def _clipped(shape: Shape, line, closed: bool, press) -> list:
    parts = inside(line, closed or shape.filled, shape.filled, shape.clip)
    if len(parts) == 1 and parts[0][0] is line:
        return [(line, closed, press)]
    return [(part, whole, None) for part, whole in parts]


def _is_page(line, view: tuple[float, float]) -> bool:
    low, high = line.min(0), line.max(0)
    corners = np.array([[x, y] for x in (low[0], high[0]) for y in (low[1], high[1])])
    gaps = np.abs(line[:, None] - corners).max(-1).min(1)
    return bool(len(line) == 4 and gaps.max() < 1e-6 * max(view) and (high - low >= _PAGE * np.array(view)).all())
