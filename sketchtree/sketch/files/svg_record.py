"""What of a sketch has no place in SVG? It rides along in attributes of our own namespace, and yields to later edits.

    sketchtree:sketch   on the root: {"version": 1, "units", "view_deg", "page", "viewBox"}
    sketchtree:stroke   on every path: {"row", "id", "kind", "labelled", "layer", "width", "wood", "view_deg", "pressure",
                        "time", "as": {"id", "group", "pen"}}; `view_deg` only of a stroke drawn on a turned page

`as` is what the file itself said when it was written: the path's id, its group's name, its line width. Where a drawing
program has since changed one of these, what the file says now counts and the record's value does not; pressure and time
count as long as there are as many of them as points. The points are always those of the path.
"""

import dataclasses
import json
import sys
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.files.path_data import numbers_of
from sketchtree.sketch.files.transforms import scale_of
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

NAMESPACE = "urn:sketchtree"  # a name, not a place
VERSION = 1
SKETCH, STROKE = f"{{{NAMESPACE}}}sketch", f"{{{NAMESPACE}}}stroke"


class StrokeRecord(NamedTuple):
    """The record of one stroke. `as_…`: what the file said when it was written."""

    row: int
    id: str
    kind: StrokeKind
    labelled: bool
    layer: str | None
    width: float | None
    wood: bool
    view_deg: float
    pressure: Float[np.ndarray, " point"] | None
    time: Float[np.ndarray, " point"] | None
    as_id: str
    as_group: str
    as_pen: str


class SketchRecord(NamedTuple):
    """The record of the whole sketch."""

    units: str
    view_deg: float
    page: tuple[float, float, float, float] | None
    view_box: str


def stroke_text(stroke: Stroke, row: int, *, as_id: str, as_group: str, as_pen: str) -> str:
    """The record of one stroke as the attribute's text."""
    record: dict[str, Any] = {"row": row, "id": stroke.id, "kind": str(stroke.kind), "labelled": bool(stroke.labelled)}
    record |= {"layer": stroke.layer, "width": None if stroke.width is None else float(stroke.width), "wood": bool(stroke.wood)}
    record |= {"view_deg": float(stroke.view_deg)} if stroke.view_deg else {}
    for name in ("pressure", "time"):
        values = getattr(stroke, name)
        record[name] = None if values is None else np.asarray(values, float).tolist()
    record["as"] = {"id": as_id, "group": as_group, "pen": as_pen}
    return json.dumps({key: value for key, value in record.items() if value is not None and value is not False})


def sketch_text(sketch: Sketch, view_box: str) -> str:
    """The record of the whole sketch as the attribute's text."""
    page = None if sketch.page is None else [float(side) for side in sketch.page]
    return json.dumps({"version": VERSION, "units": sketch.units, "view_deg": float(sketch.view_deg), "page": page, "viewBox": view_box})


def stroke_record(element: Element) -> StrokeRecord | None:
    """The record of one path. Raises ValueError if someone has spoilt it."""
    text = element.get(STROKE)
    if text is None:
        return None
    record, seen = _objects(text, "as")
    width, layer = record.get("width"), record.get("layer")
    texts = [record.get("id"), *(seen.get(key) for key in ("id", "group", "pen")), layer or ""]
    flags = [record.get(key, False) for key in ("labelled", "wood")]
    plain = all(isinstance(part, str) for part in texts) and all(isinstance(flag, bool) for flag in flags)
    fitting = _is_row(record.get("row")) and _is_number(record.get("view_deg", 0.0)) and (width is None or (_is_number(width) and width >= 0))
    if not plain or not fitting:
        raise ValueError("a record holds something else than was written")
    return StrokeRecord(
        record["row"],
        record["id"],
        StrokeKind(record.get("kind")),
        flags[0],
        layer,
        None if width is None else float(width),
        flags[1],
        float(record.get("view_deg", 0.0)),
        _column(record.get("pressure")),
        _column(record.get("time")),
        seen["id"],
        seen["group"],
        seen["pen"],
    )


def sketch_record(root: Element) -> SketchRecord | None:
    """The record of the sketch. Raises ValueError if someone has spoilt it, or if a later version wrote it."""
    text = root.get(SKETCH)
    if text is None:
        return None
    record, _ = _objects(text)
    page = record.get("page")
    whole = record.get("version") == VERSION and isinstance(record.get("units"), str) and isinstance(record.get("viewBox"), str)
    if not whole or not _is_number(record.get("view_deg")) or not (page is None or _is_page(page)):
        raise ValueError("a record holds something else than was written")
    return SketchRecord(record["units"], float(record["view_deg"]), None if page is None else tuple(map(float, page)), record["viewBox"])


def restored(stroke: Stroke, shape) -> tuple[Stroke, bool]:
    """(a stroke as it was before it was written, whether its pressure or time is lost). `stroke` is what the file itself says
    now; where that differs from what it said then, it is left as it is."""
    record: StrokeRecord = shape.record
    kept: dict[str, Any] = {"view_deg": record.view_deg}
    kept |= {"closed": shape.drawn[1]} if shape.drawn is not None else {}
    if shape.group == record.as_group:
        kept |= {"kind": record.kind, "labelled": record.labelled, "layer": record.layer}
    if shape.pen == record.as_pen:
        scale = scale_of(shape.matrix)
        kept |= {"width": None if record.width is None else record.width * scale, "wood": record.wood}
    columns = {"pressure": record.pressure, "time": record.time}
    fitting = {name: values for name, values in columns.items() if values is not None and len(values) == len(stroke.points)}
    lost = any(values is not None and name not in fitting for name, values in columns.items())
    return dataclasses.replace(stroke, **kept, **fitting), lost


def polyline(data: str) -> tuple[Float[np.ndarray, "point 2"], bool] | None:
    """(points, closed) of path data as we write them, `M x,y x,y … Z`, every point kept to the last bit; None for other data."""
    text = data.strip()
    closed = text.endswith("Z")
    numbers = text[1:-1] if closed else text[1:]
    if not text.startswith("M") or any(letter in numbers for letter in "MmLlHhVvCcSsQqTtAaZznN"):
        return None
    try:
        points = numbers_of(numbers)
    except ValueError:
        return None
    whole = len(points) > 0 and len(points) % 2 == 0 and bool(np.isfinite(points).all())
    return (points.reshape(-1, 2), closed) if whole else None


def _objects(text: str, inner: str | None = None) -> tuple[dict, dict]:
    try:
        record = json.loads(text)
    except RecursionError:
        raise ValueError("a record nests too deep") from None
    parts = (record, record.get(inner) if inner and isinstance(record, dict) else {})
    if not all(isinstance(part, dict) for part in parts):
        raise ValueError("a record is no object")
    return parts


def _column(values: Any) -> Float[np.ndarray, " point"] | None:
    if values is None:
        return None
    if not isinstance(values, list) or not all(map(_is_number, values)):
        raise ValueError("a record's column is no list of numbers")
    return np.array(values, float)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= sys.float_info.max


def _is_row(row: Any) -> bool:
    return isinstance(row, int) and not isinstance(row, bool) and row >= 0


def _is_page(page: Any) -> bool:
    return isinstance(page, list) and len(page) == 4 and all(map(_is_number, page))
