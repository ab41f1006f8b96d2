"""Which points are in this LAS or LAZ file? LAS is read here; LAZ is unpacked by lazrs (the extra `multiview`), record for record the same.

Points that are withheld or classed as noise are left out, and that is said.
"""

from collections.abc import Iterator
from typing import BinaryIO

import numpy as np

from sketchtree.clouds.files.las_header import LasHeader, las_header
from sketchtree.clouds.files.pieces import PIECE, Piece, Source
from sketchtree.clouds.files.records import left, records
from sketchtree.clouds.files.refused import CUT_OFF, no_points
from sketchtree.errors import SketchError


def read_las(file: BinaryIO, name: str) -> Source:
    """The points of a LAS or LAZ file that is open at its beginning."""
    header = las_header(file, name)
    if not header.count:
        raise no_points(name)
    found = _plain(file, header, name) if header.packed is None else _unpacked(file, header, name)
    source = Source("LAS" if header.packed is None else "LAZ", iter(()), header.count, None, "z")
    source.pieces = _pieces(found, header, source, name)
    return source


def _pieces(found: Iterator[np.ndarray], header: LasHeader, source: Source, name: str) -> Iterator[Piece]:
    noise = 0
    for some in found:
        kept = header.meant(some)
        noise += int((~kept).sum())
        some = some[kept]
        yield Piece(header.xyz(some), header.colour(some) if header.coloured else None)
    if noise:
        source.remarks.append(f"{noise:,} points of {name} are marked as noise or withheld; they were left out.")


def _plain(file: BinaryIO, header: LasHeader, name: str) -> Iterator[np.ndarray]:
    for data in records(file, header.size, header.count, name):
        yield np.frombuffer(data, np.uint8).reshape(-1, header.size)


def _unpacked(file: BinaryIO, header: LasHeader, name: str) -> Iterator[np.ndarray]:
    try:
        import lazrs
    except ImportError:
        raise SketchError(f"{name} is a LAZ file, which needs the package `lazrs`.", remedy="Install it: pip install 'sketchtree[multiview]'.") from None
    if not _has_table(file, header):
        raise SketchError(f"{name} is a LAZ file whose table of chunks makes no sense.", remedy=CUT_OFF)
    done = 0
    try:
        unpacker = lazrs.LasZipDecompressor(file, header.packed)
        while done < header.count:
            wanted = min(PIECE, header.count - done)
            data = bytearray(wanted * header.size)
            unpacker.decompress_many(data)
            done += wanted
            yield np.frombuffer(data, np.uint8).reshape(wanted, header.size)
    except BaseException as error:  # lazrs panics at some damage, which is no Exception
        if not isinstance(error, lazrs.LazrsError) and type(error).__name__ != "PanicException":
            raise
        raise SketchError(f"{name} can't be unpacked after {done:,} of its {header.count:,} points ({str(error)[:80]}).", remedy=CUT_OFF) from None


def _has_table(file: BinaryIO, header: LasHeader) -> bool:
    """Whether the table of chunks is in the file, and no longer than the file could hold: lazrs makes room for it unasked."""
    file.seek(header.begins)
    end = header.begins + left(file)
    at = int.from_bytes(file.read(8), "little", signed=True)
    if at == -1:  # written at the very end, by those who write without going back
        file.seek(max(end - 8, 0))
        at = int.from_bytes(file.read(8), "little", signed=True)
    there = header.begins < at <= end - 8
    if there:
        file.seek(at + 4)
        there = int.from_bytes(file.read(4), "little") <= (at - header.begins) // header.size + 1
    file.seek(header.begins)
    return there
