"""What does a PLY file say it holds? Elements, each a number of records, each record some properties; a property may be a list."""

import re
from dataclasses import dataclass
from typing import BinaryIO

import numpy as np

from sketchtree.clouds.files.limits import HEADER
from sketchtree.clouds.files.pieces import Axis
from sketchtree.clouds.files.refused import AGAIN
from sketchtree.errors import SketchError

_TYPES = {
    **{"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4", "double": "f8"},
    **{"int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8"},
}
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_UP = re.compile(r"\b(?:up|vertical)(?: axis)?\s*[:=]\s*\+?([yz])\b", re.IGNORECASE)


@dataclass(frozen=True)
class Property:
    """One number of a record, or a list of them."""

    name: str
    type: np.dtype
    length: np.dtype | None = None  # of a list: what its length is written as


@dataclass(frozen=True)
class Element:
    """A table of the file."""

    name: str
    count: int
    properties: tuple[Property, ...]

    @property
    def lists(self) -> bool:
        """Whether its records differ in length."""
        return any(one.length is not None for one in self.properties)

    def where(self, *names: str) -> int | None:
        """The place of the property that has one of these names; None where none has."""
        return next((k for k, one in enumerate(self.properties) if one.name.lower() in names and one.length is None), None)


@dataclass(frozen=True)
class PlyHeader:
    """All that stands before the records."""

    text: bool
    elements: tuple[Element, ...]
    up: Axis | None  # as a comment says
    lines: int  # that the header has


def ply_header(file: BinaryIO, name: str) -> PlyHeader:
    """The header; the file stands at the first record afterwards. Raises SketchError for one that makes no sense."""
    order, elements, up, number, size = None, [], None, 0, 0
    while True:
        raw = file.readline(HEADER)
        number, size = number + 1, size + len(raw)
        line = raw.decode("latin-1").strip()
        words = line.split()
        if not raw or size > HEADER:
            raise SketchError(f"{name} is a PLY file whose header has no end.", remedy=AGAIN)
        if words[:1] == ["comment"] or words[:1] == ["obj_info"]:
            said = _UP.search(line)
            up = said.group(1).lower() if said else up
        elif words[:1] == ["format"] and len(words) > 1 and words[1] in _ORDERS:
            order = _ORDERS[words[1]]
        elif words[:1] == ["element"] and len(words) == 3 and words[2].isdigit():
            elements.append((words[1], int(words[2]), []))
        elif words[:1] == ["property"] and elements and order is not None:
            elements[-1][2].append(_property(words, order, name, number))
        elif words == ["end_header"]:
            break
        elif words and (number > 1 or words != ["ply"]):
            raise SketchError(f"Line {number} of {name} is `{line[:60]}`, which no PLY header has.", remedy=AGAIN)
    if order is None:
        raise SketchError(f"{name} is a PLY file that doesn't say how its numbers are written (`format`).", remedy=AGAIN)
    return PlyHeader(order == "", tuple(Element(what, count, tuple(held)) for what, count, held in elements), up, number)


def _property(words: list[str], order: str, name: str, number: int) -> Property:
    try:
        if words[1] == "list":
            return Property(words[4], np.dtype(order + _TYPES[words[3]]), np.dtype(order + _TYPES[words[2]]))
        return Property(words[2], np.dtype(order + _TYPES[words[1]]))
    except (KeyError, IndexError):
        raise SketchError(f"Line {number} of {name} is `{' '.join(words)[:60]}`, which no PLY header has.", remedy=AGAIN) from None
