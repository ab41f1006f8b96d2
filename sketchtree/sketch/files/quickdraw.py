"""What strokes does a Quick, Draw! drawing hold? One JSON object a line (`.ndjson`), as in Google's data set.

    {"word": "tree", "drawing": [[[x, …], [y, …], [t, …]?], …]}        px, y down; t in milliseconds, in the raw form only

A file of the data set holds many drawings; a sketch is one of them.
"""

from typing import Any

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.sketch.files.json_text import number_rows, parse_json
from sketchtree.sketch.files.limits import MAX_STROKES, check_number, check_points, check_strokes
from sketchtree.sketch.strokes import Sketch, Stroke

_REMEDY = "Save the line again as a file of its own."


def read_quickdraw(data: bytes, name: str, *, max_strokes: int = MAX_STROKES, number: int | None = None) -> Sketch:
    """The strokes of drawing `number`, from 1; None where the file holds only one. Raises SketchError naming the stroke."""
    lines = [line for line in data.removeprefix(b"\xef\xbb\xbf").splitlines() if line.strip()]
    if number is None and len(lines) > 1:
        raise SketchError(
            f"{name} holds {len(lines)} drawings, one a line; a sketch is one.",
            remedy=f"Say which: {name}#1 to {name}#{len(lines)}.",
        )
    line = lines[check_number(number or 1, len(lines), name) - 1]
    return quickdraw_sketch(parse_json(line, name), name, max_strokes=max_strokes)


def quickdraw_sketch(document: Any, name: str, *, max_strokes: int = MAX_STROKES) -> Sketch:
    """The strokes of one parsed drawing; as `read_quickdraw`."""
    drawing = document.get("drawing") if isinstance(document, dict) else None
    if not isinstance(drawing, list):
        raise SketchError(f"{name} has no list 'drawing'.", remedy=_REMEDY)
    check_strokes(len(drawing), name, max_strokes)
    check_points(sum(len(row) for rows in drawing if isinstance(rows, list) for row in rows[:1] if isinstance(row, list)), name)
    return Sketch(tuple(_stroke(rows, k, name) for k, rows in enumerate(drawing, 1)), name=name, units="px")


def _stroke(rows: Any, k: int, name: str) -> Stroke:
    lengths = {len(row) for row in rows if isinstance(row, list)} if isinstance(rows, list) else set()
    columns = number_rows(rows, lengths.pop()) if len(lengths) == 1 and 2 <= len(rows) <= 3 else None
    if columns is None or not columns.size:
        raise SketchError(
            f"in {name}, it is not [[x, …], [y, …]] (or with [t, …]): finite numbers, as many of each and at least one.",
            stroke=k,
            remedy=_REMEDY,
        )
    return Stroke(f"stroke-{k}", np.column_stack([columns[0], -columns[1]]), time=columns[2] if len(columns) > 2 else None)
