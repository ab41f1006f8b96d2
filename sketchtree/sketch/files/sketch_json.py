"""Our own sketch file: strokes as points, with pressure and time where the pen gave them.

    {"sketchtree": 1, "units": "px", "y": "down", "view_deg": 0, "page": [left, top, right, bottom],
     "strokes": [{"id": "trunk", "kind": "branch", "points": [[x, y, pressure?, t_ms?], ...], "width": 3, "layer": "tree",
                  "closed": false, "filled": false, "labelled": false, "wood": false, "view_deg": 0}, ...]}

`page` has the file's own y: its edges as a reader sees them. `view_deg` of a stroke: it was drawn on a page turned by so much. `wood`: the width is the limb's own thickness. A pen without
pressure gives `[x, y, null, t_ms]`. Only `sketchtree` and every stroke's `points` are required; other keys are passed over. A
kind that is written out counts as labelled unless `labelled` says otherwise. Pressures beyond 1 are parts of the file's
greatest. What is written reads back as the same sketch, bit for bit.
"""

import dataclasses
import json
from typing import Any

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.sketch.files.json_text import parse_json
from sketchtree.sketch.files.limits import MAX_STROKES, check_strokes
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

VERSION = 1
_REMEDY = "Compare it with the sketch JSON described in docs/formats.md."


def read_sketch_json(data: bytes, name: str, *, max_strokes: int = MAX_STROKES) -> Sketch:
    """A sketch from the bytes of a JSON file. Raises SketchError naming the stroke at fault."""
    document = parse_json(data, name)
    _check_head(document, name)
    rows = document["strokes"]
    check_strokes(len(rows), name, max_strokes)
    up = document.get("y", "down") == "up"
    strokes = tuple(_stroke(row, k, name, up) for k, row in enumerate(rows))
    _check_ids(strokes, name)
    edges = document.get("page")
    page = None if edges is None else _page([float(edge) for edge in edges], up)
    strokes, warnings = _pressed(strokes)
    view = float(document.get("view_deg", 0.0))
    return Sketch(strokes, name=name, units=document.get("units", "px"), view_deg=view, page=page, warnings=warnings)


def sketch_json(sketch: Sketch) -> str:
    """The text of a sketch file, y up, one stroke a line."""
    head = {"sketchtree": VERSION, "units": sketch.units, "y": "up", "view_deg": float(sketch.view_deg)}
    if sketch.page is not None:
        left, bottom, right, top = (float(edge) for edge in sketch.page)
        head["page"] = [left, top, right, bottom]
    rows = [json.dumps(_row(stroke)) for stroke in sketch.strokes]
    return json.dumps(head)[:-1] + ', "strokes": [\n ' + ",\n ".join(rows) + "\n]}\n"


def _pressed(strokes: tuple[Stroke, ...]) -> tuple[tuple[Stroke, ...], tuple[str, ...]]:
    """(the strokes with pressures from 0 to 1, what to say of it): a tablet's own steps are parts of the greatest."""
    most = max((float(stroke.pressure.max()) for stroke in strokes if stroke.pressure is not None), default=1.0)
    if most <= 1.0:
        return strokes, ()
    scaled = [stroke if stroke.pressure is None else dataclasses.replace(stroke, pressure=stroke.pressure / most) for stroke in strokes]
    return tuple(scaled), (f"Pressures go up to {most:g}; they were read as parts of that.",)


def _check_head(document: Any, name: str) -> None:
    if not isinstance(document, dict) or "sketchtree" not in document:
        raise SketchError(f"{name} is JSON, but not a sketch: it has no key 'sketchtree'.", remedy=_REMEDY)
    version = document["sketchtree"]
    if not isinstance(version, int) or isinstance(version, bool) or version < 1:
        raise SketchError(f"{name} has 'sketchtree': {version!r}; a version number was expected.", remedy=_REMEDY)
    if version > VERSION:
        raise SketchError(
            f"{name} is a sketch of version {version}; this program reads up to {VERSION}.",
            remedy="Upgrade SketchTree, or save the sketch in the older form.",
        )
    if document.get("y", "down") not in ("up", "down"):
        raise SketchError(f"{name} has 'y': {document['y']!r}; 'up' or 'down' was expected.", remedy=_REMEDY)
    if not isinstance(document.get("strokes"), list):
        raise SketchError(f"{name} has no list 'strokes'.", remedy=_REMEDY)
    if not isinstance(document.get("units", "px"), str):
        raise SketchError(f"{name} has 'units': {document['units']!r}; a word was expected.", remedy=_REMEDY)
    if not (_is_number(document.get("view_deg", 0.0)) and np.isfinite(document.get("view_deg", 0.0))):
        raise SketchError(f"{name} has 'view_deg': {document['view_deg']!r}; degrees were expected.", remedy=_REMEDY)
    page = document.get("page")
    if page is not None and not (isinstance(page, list) and len(page) == 4 and all(map(_is_number, page)) and np.isfinite(page).all()):
        raise SketchError(f"{name} has 'page': {json.dumps(page)[:60]}; [left, top, right, bottom] was expected.", remedy=_REMEDY)


def _page(edges: list[float], up: bool) -> tuple[float, float, float, float]:
    """(left, bottom, right, top), y up, of the edges as the file has them."""
    left, top, right, bottom = edges
    return (left, bottom, right, top) if up else (left, 0.0 - bottom, right, 0.0 - top)


def _stroke(row: Any, k: int, name: str, up: bool) -> Stroke:
    if not isinstance(row, dict):
        raise SketchError(f"in {name}, it is not an object.", stroke=k + 1, remedy=_REMEDY)
    stroke_id = str(row.get("id", f"stroke-{k + 1}")).encode("utf-8", "replace").decode()  # half a surrogate pair can't be printed
    columns = _columns(row.get("points"), stroke_id, name)
    kind = row.get("kind")
    if kind is not None and kind not in tuple(StrokeKind):
        raise SketchError(f"in {name}, its kind is {kind!r}; one of {', '.join(StrokeKind)} was expected.", stroke=stroke_id, remedy=_REMEDY)
    width = row.get("width")
    if width is not None and not (_is_number(width) and 0 <= width < np.inf):
        raise SketchError(f"in {name}, its width is {width!r}; a number of at least 0 was expected.", stroke=stroke_id, remedy=_REMEDY)
    view = row.get("view_deg", 0.0)
    if not (_is_number(view) and np.isfinite(view)):
        raise SketchError(f"in {name}, its 'view_deg' is {view!r}; degrees were expected.", stroke=stroke_id, remedy=_REMEDY)
    layer = row.get("layer")
    if layer is not None and not isinstance(layer, str):
        raise SketchError(f"in {name}, its layer is {layer!r}; a name was expected.", stroke=stroke_id, remedy=_REMEDY)
    flags = {flag: row.get(flag, flag == "labelled" and kind is not None) for flag in ("closed", "filled", "labelled", "wood")}
    wrong = next((flag for flag, value in flags.items() if not isinstance(value, bool)), None)
    if wrong:
        raise SketchError(f"in {name}, its '{wrong}' is {flags[wrong]!r}; true or false was expected.", stroke=stroke_id, remedy=_REMEDY)
    try:
        return Stroke(
            stroke_id,
            columns[:, :2] * (1.0, 1.0 if up else -1.0),
            StrokeKind(kind or "branch"),
            width=None if width is None else float(width),
            pressure=columns[:, 2] if columns.shape[1] > 2 and not _without_pressure(columns) else None,
            time=columns[:, 3] if columns.shape[1] > 3 else None,
            layer=layer,
            view_deg=float(view),
            **flags,
        )
    except SketchError as error:
        raise SketchError(f"in {name}, {error.message.split(': ', 1)[-1]}", stroke=stroke_id, remedy=error.remedy) from None


def _columns(points: Any, stroke_id: str, name: str) -> np.ndarray:
    """Points as (point, 2-4) of x, y, pressure, t; every row as long as the first."""
    if not isinstance(points, list) or not all(isinstance(point, list) for point in points):
        raise SketchError(f"in {name}, its points are not a list of [x, y] rows.", stroke=stroke_id, remedy=_REMEDY)
    size = len(points[0]) if points else 2
    if not (2 <= size <= 4 and all(len(point) == size for point in points) and _all_numbers(points, size)):
        raise _bad_point(points, size, stroke_id, name)
    columns = np.array(points, float).reshape(-1, size)
    if size == 4 and 0 < sum(point[2] is None for point in points) < len(points):
        raise SketchError(f"in {name}, its pressure is null at some points only.", stroke=stroke_id, remedy="Give it at every point, or null at all.")
    if size > 2 and (columns[:, 2] < 0).any():
        raise SketchError(f"in {name}, its pressure is below 0; 0 to 1 was expected.", stroke=stroke_id, remedy=_REMEDY)
    if not np.isfinite(np.delete(columns, 2, axis=1) if _without_pressure(columns) else columns).all():
        raise SketchError(
            f"in {name}, it has a coordinate that is not a finite number.",
            stroke=stroke_id,
            remedy="Export the drawing again, or delete that stroke.",
        )
    return columns


def _all_numbers(points: list[list], size: int) -> bool:
    """Whether every value is a number; a pressure, where a time follows, may be null."""
    kinds = {type(value) for point in points for value in point}
    if kinds <= {float}:
        return True
    return all(_is_number(value) or (value is None and j == 2 and size == 4) for point in points for j, value in enumerate(point))


def _bad_point(points: list[list], size: int, stroke_id: str, name: str) -> SketchError:
    """The error that names the first point that is not as it should be."""
    good = (2 <= size <= 4 and len(point) == size and _all_numbers([point], size) for point in points)
    k = next(k for k, fits in enumerate(good) if not fits)
    return SketchError(
        f"in {name}, point {k + 1} is {json.dumps(points[k])[:60]}; [x, y], [x, y, pressure] or "
        "[x, y, pressure, t_ms] was expected, the same for all its points.",
        stroke=stroke_id,
        remedy=_REMEDY,
    )


def _without_pressure(columns: np.ndarray) -> bool:
    """Whether the pen gave times but no pressure: null in every row."""
    return columns.shape[1] == 4 and bool(np.isnan(columns[:, 2]).all())


def _check_ids(strokes: tuple[Stroke, ...], name: str) -> None:
    seen: set[str] = set()
    for stroke in strokes:
        if stroke.id in seen:
            raise SketchError(f"in {name}, its id is used twice.", stroke=stroke.id, remedy="Give every stroke an id of its own.")
        seen.add(stroke.id)


def _row(stroke: Stroke) -> dict[str, Any]:
    columns = [stroke.points.astype(object)]
    if stroke.pressure is not None or stroke.time is not None:
        columns.append(np.full((len(stroke.points), 1), None) if stroke.pressure is None else _column(stroke.pressure))
    if stroke.time is not None:
        columns.append(_column(stroke.time))
    row = {"id": stroke.id, "kind": str(stroke.kind), "labelled": bool(stroke.labelled), "points": np.hstack(columns).tolist()}
    row |= {flag: True for flag in ("closed", "filled", "wood") if getattr(stroke, flag)}
    row |= {} if stroke.layer is None else {"layer": stroke.layer}
    row |= {"view_deg": float(stroke.view_deg)} if stroke.view_deg else {}
    return row | ({} if stroke.width is None else {"width": float(stroke.width)})


def _column(values) -> np.ndarray:
    return np.asarray(values, float).astype(object)[:, None]


def _is_number(value: Any) -> bool:
    """Whether a JSON value is a number that a float can hold; NaN and infinity are told apart later."""
    return isinstance(value, float) or (isinstance(value, int) and not isinstance(value, bool) and abs(value) <= 1.7e308)
