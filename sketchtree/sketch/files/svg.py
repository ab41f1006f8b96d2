"""What strokes does an SVG file hold? The drawing as one sees it, in the user units of its viewBox, y up.

The document is walked as a browser paints it (`painted`), curves become polylines, and what clips hide is cut off. The
viewBox is not mapped to the viewport, so that a point of the file keeps its numbers (y negated).
"""

import dataclasses
import math
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from sketchtree.errors import SketchError
from sketchtree.sketch.files.areas import inside
from sketchtree.sketch.files.document import local_name, parse_xml
from sketchtree.sketch.files.ids import unique
from sketchtree.sketch.files.limits import MAX_MB, MAX_STROKES
from sketchtree.sketch.files.outlines import flatten
from sketchtree.sketch.files.painted import Walk
from sketchtree.sketch.files.path_effects import Spine
from sketchtree.sketch.files.recognise import HEAD
from sketchtree.sketch.files.shapes import Shape, extent_of
from sketchtree.sketch.files.svg_record import restored, sketch_record
from sketchtree.sketch.files.viewport import View
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

FLATNESS = 5e-4  # how far a flattened curve may lie from the true one, of the drawing's size
MOST_TOLD = 20  # warnings of one file
_PAGE = 0.9  # of the page's width and height, from which a painted rectangle is the paper


def read_svg(data: bytes, name: str, *, max_strokes: int = MAX_STROKES, max_mb: float = MAX_MB) -> Sketch:
    """The strokes of an SVG file, in document order (in the sketch's own order for a file of ours). Raises SketchError."""
    root = parse_xml(data, name, max_mb=max_mb)
    if local_name(root.tag) != "svg":
        tag = root.tag.rpartition("}")[2]
        raise SketchError(f"{name} is XML, but its root is <{tag[:40]}>, not <svg>.", remedy="Export the drawing as SVG.")
    with np.errstate(all="ignore"):  # numbers too large are refused by name
        walk = Walk(root, name, max_strokes)
        strokes, warnings = _strokes(walk.shapes(), walk)
    x, y, width, height = walk.box
    sketch = Sketch(strokes, name=name, page=(x, 0.0 - y - height, x + width, 0.0 - y) if walk.has_page else None)
    try:
        record = sketch_record(root)
    except ValueError:
        record = None
        walk.left_out.add("a spoilt record")
    if record is not None:
        kept = record.page if root.get("viewBox") == record.view_box else sketch.page
        sketch = dataclasses.replace(sketch, units=record.units, view_deg=record.view_deg, page=kept)
    return dataclasses.replace(sketch, warnings=_few(_linked(data) + walk.warnings() + warnings))


def _linked(data: bytes) -> tuple[str, ...]:
    """A warning if the file asks for a style sheet outside it."""
    found = b"<?xml-stylesheet" in data[:HEAD].replace(b"\0", b"")
    return ("A style sheet of another file was left out; lines may look other than drawn.",) if found else ()


def _few(warnings: tuple[str, ...]) -> tuple[str, ...]:
    if len(warnings) <= MOST_TOLD:
        return warnings
    return (*warnings[: MOST_TOLD - 1], f"{len(warnings) - MOST_TOLD + 1} more remarks like these were left away.")


def _strokes(shapes: list[Shape], walk: Walk) -> tuple[tuple[Stroke, ...], tuple[str, ...]]:
    """Flatten every shape in one go, cut what is clipped, and name the strokes."""
    strokes: list[tuple[float, Stroke]] = []  # with the row each had in the sketch that was written
    papers: list[str] = []
    used = dict.fromkeys((shape.record.id for shape in shapes if _keeps_id(shape)), 1)
    cut = redrawn = 0
    for number, (shape, whole) in enumerate(zip(shapes, _flattened(shapes), strict=True), 1):
        parts = _shown(shape, whole)
        if shape.clip is not None and not _same(parts, whole):
            cut += bool(parts)
            walk.left_out.add("a shape outside its clip", int(not parts))
        own = shape.element.get("id")
        for k, part in enumerate(parts):
            if shape.filled and shape.record is None and shape.naming.kind is None and _is_page(part.points, walk.view):
                papers.append(own or "no id")
                continue
            if k == 0 and _keeps_id(shape):
                stroke_id = shape.record.id
            else:
                stroke_id = unique((own or f"stroke-{number}") + (f"-{k + 1}" if k else ""), used)
            stroke = _stroke(stroke_id, shape, part, walk.name)
            if shape.record is not None:
                stroke, lost = restored(stroke, shape)
                redrawn += lost
            strokes.append((shape.record.row if shape.record else math.inf, stroke))
    strokes.sort(key=lambda entry: entry[0])
    warnings = [f"A filled shape over the whole page ({paper}) was taken for the paper and left out." for paper in papers]
    if cut:
        warnings.append(f"{cut} {'shape was' if cut == 1 else 'shapes were'} cut where a clip or mask hides the rest.")
    if redrawn:
        warnings.append(f"{redrawn} {'stroke has' if redrawn == 1 else 'strokes have'} lost pressure and time: other points were drawn since.")
    return tuple(stroke for _, stroke in strokes), tuple(warnings)


class _Part(NamedTuple):
    """One polyline of a shape, y down."""

    points: Float[np.ndarray, "point 2"]
    closed: bool
    pressure: Float[np.ndarray, " point"] | None = None


def _stroke(stroke_id: str, shape: Shape, part: _Part, name: str) -> Stroke:
    kind = shape.naming.kind
    try:
        return Stroke(
            stroke_id,
            part.points * (1.0, -1.0),
            kind or StrokeKind.BRANCH,
            labelled=kind is not None,
            closed=part.closed or shape.filled,
            width=shape.width,
            pressure=part.pressure,
            filled=shape.filled,
            layer=shape.naming.layer,
        )
    except SketchError as error:
        raise SketchError(f"in {name}, {error.message}", stroke=stroke_id, remedy=error.remedy) from None


def _keeps_id(shape: Shape) -> bool:
    return shape.record is not None and shape.element.get("id") == shape.record.as_id


def _flattened(shapes: list[Shape]) -> list[list[_Part]]:
    """For every shape its polylines, uncut."""
    paths = [path for shape in shapes for path in shape.paths]
    pieces = np.concatenate([np.zeros((0, 4, 2)), *(path.cubics for path in paths)])
    points, steps = flatten(pieces, FLATNESS * extent_of(paths))
    pieces_before = np.r_[0, np.cumsum([len(path.cubics) for path in paths])].astype(np.int64)
    ends, first = pieces_before.tolist(), np.r_[0, np.cumsum(steps)][pieces_before].tolist()
    found, k = [], 0
    for shape in shapes:
        parts = [] if shape.drawn is None else [_Part(*shape.drawn)]
        for path in shape.paths:
            line = np.concatenate([path.start[None], points[first[k] : first[k + 1]]])
            press = None if shape.spine is None else _pressure(shape.spine, steps[ends[k] : ends[k + 1]])
            if path.closed and len(line) > 1 and (line[0] == line[-1]).all():
                line, press = line[:-1], None if press is None else press[:-1]
            parts.append(_Part(line, path.closed, press))
            k += 1
        found.append(parts)
    return found


def _pressure(spine: Spine, steps: Int[np.ndarray, " piece"]) -> Float[np.ndarray, " point"] | None:
    """The width of a thickened line at its points, of its greatest."""
    if spine.knots is None:
        return None
    done = np.repeat(np.arange(len(steps)), steps)
    within = np.arange(len(done)) - np.repeat(np.cumsum(steps) - steps, steps) + 1
    times = np.r_[0.0, done + within / np.repeat(steps, steps)]
    return np.interp(times, *spine.knots.T) / spine.width


def _shown(shape: Shape, whole: list[_Part]) -> list[_Part]:
    """The parts of a shape that its clip shows; the very same ones where it shows all."""
    if shape.clip is None:
        return whole
    found = []
    for part in whole:
        pieces = inside(part.points, part.closed or shape.filled, shape.filled, shape.clip)
        found += [part] if len(pieces) == 1 and pieces[0][0] is part.points else [_Part(*piece) for piece in pieces]
    return found


def _same(parts: list[_Part], whole: list[_Part]) -> bool:
    return len(parts) == len(whole) and all(a is b for a, b in zip(parts, whole, strict=True))


def _is_page(line, view: View) -> bool:
    low, high = line.min(0), line.max(0)
    corners = np.array([[x, y] for x in (low[0], high[0]) for y in (low[1], high[1])])
    gaps = np.abs(line[:, None] - corners).max(-1).min(1)
    return bool(len(line) == 4 and gaps.max() < 1e-6 * max(view[:2]) and (high - low >= _PAGE * np.array(view[:2])).all())
