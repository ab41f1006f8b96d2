"""Which column of a text is what? As its header says; without one, by what the numbers look like.

The first three columns are x, y, z. Of the others, three that are whole numbers from 0 to 255 are a colour, three whose squares add up to 1 a normal; the rest is passed over.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sketchtree.clouds.files.numbers import COMMENTS
from sketchtree.clouds.files.refused import CONVERT
from sketchtree.errors import SketchError

_NAMES = (
    (("x", "easting", "east", "pos_x", "px"), ("y", "northing", "north", "pos_y", "py"), ("z", "elevation", "height", "altitude", "pos_z", "pz")),
    (("r", "red"), ("g", "green"), ("b", "blue")),
    (("nx", "normal_x", "normalx", "xn"), ("ny", "normal_y", "normaly", "yn"), ("nz", "normal_z", "normalz", "zn")),
)
_DECIMAL_COMMA = re.compile(r"[-+]?\d+(,\d+)?([eE][-+]?\d+)?")
LOOKED_AT = 200  # lines


@dataclass(frozen=True)
class Layout:
    """How a text holds its points."""

    skipped: int  # lines before the first point
    separator: str | None  # None: blanks
    decimal_comma: bool
    groups: tuple[list[int] | None, list[int] | None, list[int] | None]  # columns of place, colour, normal


def layout(lines: Sequence[str], name: str) -> Layout:
    """How the text holds points, from its first lines. Raises SketchError for one that holds none."""
    at = next((k for k, line in enumerate(lines) if _numeric(line)), None)
    if at is None:
        raise SketchError(f"{name} is text without points.", remedy="Give lines of x y z, with or without colours.")
    if _is_ptx(lines, at):
        raise SketchError(f"{name} is a PTX scan, which is not read.", remedy=CONVERT)
    separator, comma = _separator(lines[at])
    body = [words for words in (_words(line, separator, comma) for line in lines[at:]) if len(words) >= 3]
    header = next((words for words in (_header(line) for line in reversed(lines[:at])) if words), None)
    if header is not None and len(header) >= 3 and any(word in ("x", "y", "z", "easting", "northing") for word in header):
        return Layout(at, separator, comma, _by_header(header, name))
    if header is not None and not any(lines[k].lstrip().startswith(COMMENTS) for k in range(at)):
        raise SketchError(f"The columns of {name} are named {', '.join(header[:6])}; none are x, y and z.", remedy="Name three of them x, y and z.")
    return Layout(at, separator, comma, _by_look(body))


def _numeric(line: str) -> bool:
    """Whether the line is a point: three numbers or more, and nothing else in the first three columns."""
    separator, comma = _separator(line)
    words = _words(line, separator, comma)
    try:
        return len(words) >= 3 and all(float(word) is not None for word in words[:3])
    except ValueError:
        return False


def _separator(line: str) -> tuple[str | None, bool]:
    """What stands between columns (None: blanks), and whether decimals are written with a comma."""
    if ";" in line:
        return ";", "," in line and "." not in line
    if "," not in line:
        return None, False
    words = line.split()
    decimal = len(words) >= 3 and all(_DECIMAL_COMMA.fullmatch(word) for word in words)
    return (None, True) if decimal else (",", False)


def _words(line: str, separator: str | None, comma: bool) -> list[str]:
    if line.lstrip().startswith(COMMENTS):
        return []
    words = [word.strip() for word in (line.replace(",", ".") if comma else line).split(separator)]
    return words[:-1] if words and not words[-1] else words


def _header(line: str) -> list[str]:
    """Names of columns, as a line may give them."""
    plain = re.sub(r"[\[(][^\])]*[\])]", "", line.strip().lstrip("#/%!").replace('"', ""))
    words = [word.strip().lower() for word in re.split(r"[;,\s]+", plain) if word.strip()]
    return words if any(re.search("[a-z]", word) for word in words) else []


def _by_header(header: list[str], name: str) -> tuple:
    groups = []
    for group in _NAMES:
        found = [next((header.index(word) for word in names if word in header), None) for names in group]
        groups.append(None if None in found else found)
    if groups[0] is None:
        raise SketchError(f"The columns of {name} are named {', '.join(header[:6])}; none are x, y and z.", remedy="Name three of them x, y and z.")
    return tuple(groups)


def _by_look(body: list[list[str]]) -> tuple:
    width = min(len(words) for words in body)
    try:
        table = np.array([[float(word) for word in words[:width]] for words in body])
    except ValueError:  # text in some column: the line is named when it is read
        return [0, 1, 2], None, None
    colour = normal = None
    k = 3
    while k + 3 <= width:
        three = table[:, k : k + 3]
        if normal is None and (np.abs(three) < 2.0).all() and (np.abs((three**2).sum(axis=1) - 1.0) < 0.02).all():
            normal = [k, k + 1, k + 2]
        elif colour is None and (three == np.round(three)).all() and three.min() >= 0 and 2 <= three.max() <= 255:
            colour = [k, k + 1, k + 2]
        else:
            k += 1
            continue
        k += 3
    return [0, 1, 2], colour, normal


def _is_ptx(lines: Sequence[str], at: int) -> bool:
    """Two lines of one whole number each, then the scanner's place: three numbers a line."""
    return at == 2 and all(line.strip().isdigit() for line in lines[:2])
