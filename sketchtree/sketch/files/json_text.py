"""Is this text one well-formed JSON document, and are its numbers numbers?

Files come from strangers: nesting deeper than the parser's stack, numbers beyond any float, and text in another
encoding are all refused in one sentence.
"""

import json
from typing import Any

import numpy as np
from jaxtyping import Float

from sketchtree.errors import SketchError
from sketchtree.sketch.files.limits import check_points

AGAIN = "Save the drawing again."


def parse_json(data: bytes | str, name: str) -> Any:
    """The document. UTF-8, -16 and -32 are told apart by their first bytes. Raises SketchError, for more lists than points are allowed too."""
    check_points(data.count(b"[" if isinstance(data, bytes) else "["), name)
    try:
        return json.loads(data)
    except UnicodeDecodeError as error:
        raise SketchError(f"{name} is not Unicode text (byte {error.start} is no {error.encoding}).", remedy="Save it as UTF-8.") from None
    except RecursionError:
        raise SketchError(f"{name} nests its lists or objects too deep.", remedy=AGAIN) from None
    except ValueError as error:
        raise SketchError(f"{name} is not one well-formed JSON document ({error}); it may be cut short.", remedy=AGAIN) from None


def is_number(value: Any) -> bool:
    """Whether a JSON value is a finite number (true and false are none)."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) <= 1.7e308


def number_rows(rows: Any, size: int) -> Float[np.ndarray, "row column"] | None:
    """A list of lists as (row, size), what follows in each row left out; None if it is no such list of finite numbers."""
    if not isinstance(rows, list) or not set(map(type, rows)) <= {list} or min(map(len, rows), default=size) < size:
        return None
    flat = [value for row in rows for value in row[:size]]
    if not set(map(type, flat)) <= {int, float}:
        return None
    try:
        table = np.array(flat, float).reshape(len(rows), size)
    except OverflowError:
        return None
    return table if np.isfinite(table).all() else None
