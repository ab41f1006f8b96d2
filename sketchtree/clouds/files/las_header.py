"""What does a LAS or LAZ file say it holds? (ASPRS LAS 1.0 to 1.4, public header block and point data records 0 to 10.)"""

import struct
from dataclasses import dataclass
from typing import BinaryIO

import numpy as np
from jaxtyping import Float, Shaped

from sketchtree.clouds.files.refused import AGAIN
from sketchtree.errors import SketchError

_LEAST = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)  # bytes of a record, by its format
_RGB = {2: 20, 3: 28, 5: 28, 7: 30, 8: 30, 10: 30}  # where three words of colour begin
_NOISE = (7, 18)  # classes: low and high noise
_LASZIP = (b"laszip encoded", 22204)  # the record in which a LAZ file says how it was packed


@dataclass(frozen=True, eq=False)
class LasHeader:
    """Where its records are, and what their whole numbers mean."""

    version: str
    format: int
    size: int  # bytes of a record
    count: int
    begins: int  # byte of the first record
    scale: Float[np.ndarray, "3"]
    offset: Float[np.ndarray, "3"]
    packed: bytes | None  # how, where it is a LAZ file

    @property
    def coloured(self) -> bool:
        """Whether its records have a colour."""
        return self.format in _RGB

    def xyz(self, records: Shaped[np.ndarray, "point byte"]) -> Float[np.ndarray, "point 3"]:
        """Places, in the file's coordinates."""
        with np.errstate(over="ignore"):  # what is nowhere is left out later
            return np.ascontiguousarray(records[:, :12]).view("<i4") * self.scale + self.offset

    def colour(self, records: Shaped[np.ndarray, "point byte"]) -> Float[np.ndarray, "point 3"]:
        """Colours, 16 bits each as they should be; some writers use 8."""
        at = _RGB[self.format]
        return np.ascontiguousarray(records[:, at : at + 6]).view("<u2").astype(np.float64)

    def meant(self, records: Shaped[np.ndarray, "point byte"]) -> Shaped[np.ndarray, " point"]:
        """Points that are neither withheld nor of a class of noise."""
        if self.format >= 6:
            kind, withheld = records[:, 16], records[:, 15] & 4
        else:
            kind, withheld = records[:, 15] & 31, records[:, 15] & 128
        return ~(np.isin(kind, _NOISE) | (withheld > 0))


def las_header(file: BinaryIO, name: str) -> LasHeader:
    """The header; the file stands at the first record afterwards. Raises SketchError for one that makes no sense."""
    head = file.read(375)
    if len(head) < 227:
        raise SketchError(f"{name} is a LAS file that ends in its header.", remedy="The file was cut off: copy or export it again.")
    version = (head[24], head[25])
    length, begins, notes, kind, size, count = struct.unpack_from("<HIIBHI", head, 94)
    scale, offset = np.frombuffer(head, "<f8", 3, 131).copy(), np.frombuffer(head, "<f8", 3, 155).copy()
    if version >= (1, 4) and len(head) >= 255:
        count = struct.unpack_from("<Q", head, 247)[0] or count
    form, packed = kind & 63, bool(kind & 128)
    if version[0] != 1 or form >= len(_LEAST) or size < _LEAST[form] or not np.isfinite([scale, offset]).all() or (scale == 0).any() or begins < length:
        raise SketchError(f"{name} is a LAS file (version {version[0]}.{version[1]}, point format {form}) whose header makes no sense.", remedy=AGAIN)
    how = _packing(file, length, notes, name) if packed else None
    file.seek(begins)
    return LasHeader(f"{version[0]}.{version[1]}", form, size, count, begins, scale, offset, how)


def _packing(file: BinaryIO, length: int, notes: int, name: str) -> bytes:
    """The record that says how a LAZ file was packed."""
    file.seek(length)
    for _ in range(notes):
        head = file.read(54)
        if len(head) < 54:
            break
        user, number, size = struct.unpack_from("<16sHH", head, 2)
        held = file.read(size)
        if (user.rstrip(b"\x00"), number) == _LASZIP:
            return held
    raise SketchError(f"{name} is a LAZ file that doesn't say how it was packed.", remedy=AGAIN)
