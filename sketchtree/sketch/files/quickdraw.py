"""What strokes does a Quick, Draw! drawing hold? One JSON object a line (`.ndjson`), as in Google's data set.

    {"word": "tree", "drawing": [[[x, …], [y, …], [t, …]?], …]}        px, y down; t in milliseconds, in the raw form only

A file of the data set holds many drawings; a sketch is one.
"""

from typing import Any

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.sketch.files.json_text import number_rows, parse_json
from sketchtree.sketch.files.limits import MAX_STROKES, check_strokes
from sketchtree.sketch.strokes import Sketch, Stroke

_REMEDY = "Save the line again as a file of its own."


def read_quickdraw(data: bytes, name: str, *, max_strokes: int = MAX_STROKES) -> Sketch:
    """The strokes of the one drawing in a file. Raises SketchError naming the stroke; also when there are several drawings."""
    lines = [line for line in data.removeprefix(b"\xef\xbb\xbf").splitlines() if line.strip()]
    if len(lines) != 1:
        raise SketchError(f"{name} holds {len(lines)} drawings, one a line; a sketch is one.", remedy="Save the line you want as a file of its own.")
    return quickdraw_sketch(parse_json(lines[0], name), name, max_strokes=max_strokes)


def is_quickdraw(document: Any) -> bool:
    """Whether a JSON document is one Quick, Draw! drawing."""
    return isinstance(document, dict) and "drawing" in document


def quickdraw_sketch(document: dict[str, Any], name: str, *, max_strokes: int = MAX_STROKES) -> Sketch:
    """The strokes of one parsed drawing; as `read_quickdraw`."""
    drawing = document.get("drawing")
    if not isinstance(drawing, list):
        raise SketchError(f"{name} has no list 'drawing'.", remedy=_REMEDY)
    check_strokes(len(drawing), name, max_strokes)
    return Sketch(tuple(_stroke(rows, k, name) for k, rows in enumerate(drawing, 1)), name=name, units="px")


def _stroke(rows: Any, k: int, name: str) -> Stroke:
    lengths = {len(row) for row in rows if isinstance(row, list)} if isinstance(rows, list) else set()
    columns = number_rows(rows, lengths.pop()) if len(lengths) == 1 and 2 <= len(rows) <= 3 else None
    if columns is None or not columns.size:
        raise SketchError(
            f"in {name}, it is not [[x, …], [y, …]] (or with [t, …]): finite numbers, as many of each and at least one.", stroke=k, remedy=_REMEDY
        )
    return Stroke(f"stroke-{k}", np.column_stack([columns[0], -columns[1]]), time=columns[2] if len(columns) > 2 else None)
