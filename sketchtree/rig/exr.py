"""Half floats as an OpenEXR image, byte for byte as they are.

OpenEXR 2, one part of scan lines without compression ("Technical introduction to OpenEXR" and "OpenEXR file layout", openexr.com):
a magic number, a version, attributes (name, type, size, value), a table of where each line begins, then line by line its number, its
size and its channels in alphabetic order. So small a file needs no library, and no bit of a number packed into a half is touched.
"""

import struct

import numpy as np
from jaxtyping import Float16

_MAGIC, _VERSION = 20000630, 2
_HALF = 1  # pixel type
_CHANNELS = ("A", "B", "G", "R")  # as the format orders them
_OF_PIXEL = (3, 2, 1, 0)  # where each stands in R G B A


def exr_bytes(image: Float16[np.ndarray, "row column 4"]) -> bytes:
    """The bytes of an `.exr` with channels R, G, B and A."""
    rows, columns, _ = image.shape
    head = struct.pack("<II", _MAGIC, _VERSION) + b"".join(_attributes(rows, columns)) + b"\0"
    line = 8 + 2 * 4 * columns
    first = len(head) + 8 * rows
    table = struct.pack(f"<{rows}Q", *range(first, first + line * rows, line))
    planes = np.ascontiguousarray(image[:, :, _OF_PIXEL].transpose(0, 2, 1)).astype("<f2")
    lines = (struct.pack("<iI", row, line - 8) + planes[row].tobytes() for row in range(rows))
    return head + table + b"".join(lines)


def _attributes(rows: int, columns: int):
    window = struct.pack("<4i", 0, 0, columns - 1, rows - 1)
    channel = b"".join(name.encode() + b"\0" + struct.pack("<iB3xii", _HALF, 0, 1, 1) for name in _CHANNELS) + b"\0"
    yield _attribute("channels", "chlist", channel)
    yield _attribute("compression", "compression", b"\0")
    yield _attribute("dataWindow", "box2i", window)
    yield _attribute("displayWindow", "box2i", window)
    yield _attribute("lineOrder", "lineOrder", b"\0")
    yield _attribute("pixelAspectRatio", "float", struct.pack("<f", 1.0))
    yield _attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0.0, 0.0))
    yield _attribute("screenWindowWidth", "float", struct.pack("<f", 1.0))


def _attribute(name: str, kind: str, value: bytes) -> bytes:
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
