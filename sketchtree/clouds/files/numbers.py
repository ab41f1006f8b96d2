"""Which numbers stand in these lines? Columns by place; the first line that has none is named."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float

from sketchtree.errors import SketchError

COMMENTS = ("#", "//", "%", "!")


def numbers(lines: Sequence[str], columns: Sequence[int], name: str, *, first: int, separator: str | None) -> Float[np.ndarray, "line column"]:
    """Columns of the lines; empty lines and comments are passed over. `first`: the number of the first line. Raises SketchError, naming a line."""
    there = [mark for mark in COMMENTS if any(mark in line for line in lines)]
    if there:
        lines, kept = _without_comments(lines), lines
    else:
        kept = lines
    if not any(line.strip() for line in lines):
        return np.empty((0, len(columns)))
    try:
        return np.loadtxt(lines, usecols=columns, delimiter=separator, comments=None, ndmin=2)
    except (ValueError, IndexError):
        raise _wrong(kept, columns, name, first, separator) from None


def _without_comments(lines: Sequence[str]) -> list[str]:
    for mark in COMMENTS:
        lines = [line.split(mark, 1)[0] for line in lines]
    return list(lines)


def _wrong(lines: Sequence[str], columns: Sequence[int], name: str, first: int, separator: str | None) -> SketchError:
    """The error that names the first line at fault."""
    for number, line in enumerate(_without_comments(lines), first):
        if not line.strip():
            continue
        words = [word.strip() for word in line.split(separator)]
        if max(columns) >= len(words):
            return SketchError(f"Line {number} of {name} has {len(words)} columns; those before it have {max(columns) + 1} or more.", remedy="Mend that line.")
        for k in columns:
            try:
                float(words[k])
            except ValueError:
                return SketchError(f"Line {number} of {name} has `{words[k][:40]}` where a number should stand.", remedy="Mend that line, or take it out.")
    return SketchError(f"The numbers of {name} can't be read.", remedy="Export the cloud again.")
