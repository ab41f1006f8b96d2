"""How is a LAZ file unpacked? By lazrs (the extra `multiview`), after a look at what it says of its own sizes, which lazrs believes."""

from collections.abc import Iterator
from typing import BinaryIO

import numpy as np

from sketchtree.clouds.files.las_header import LasHeader
from sketchtree.clouds.files.pieces import PIECE
from sketchtree.clouds.files.records import left
from sketchtree.clouds.files.refused import CUT_OFF
from sketchtree.errors import SketchError

_LAYERED = 6  # point formats from this on are packed in layers
_LAYERS = 9  # that every one of them has
_TABLE = 8  # bytes before the first chunk: where the table is


def unpacked(file: BinaryIO, header: LasHeader, name: str) -> Iterator[np.ndarray]:
    """The records of a LAZ file, as bytes. Raises SketchError for one that is damaged, and where lazrs isn't there."""
    try:
        import lazrs
    except ImportError:
        raise SketchError(f"{name} is a LAZ file, which needs the package `lazrs`.", remedy="Install it: pip install 'sketchtree[multiview]'.") from None
    if not _has_table(file, header):
        raise SketchError(f"{name} is a LAZ file whose table of chunks makes no sense.", remedy=CUT_OFF)
    done = 0
    try:
        if header.format >= _LAYERED and not _layers_fit(file, header, lazrs.read_chunk_table(file, lazrs.LazVlr(header.packed))):
            raise SketchError(f"{name} is a LAZ file whose layers make no sense.", remedy=CUT_OFF)
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


def _layers_fit(file: BinaryIO, header: LasHeader, chunks: list[tuple[int, int]]) -> bool:
    """Whether layers are no longer than their chunks: lazrs makes room for gigabytes if they say so. A chunk is its first record, how many points it has, how long each layer is,
    and the layers."""
    at = header.begins + _TABLE
    for _, size in chunks:
        file.seek(at + header.size + 4)
        told = np.frombuffer(file.read(4 * _LAYERS), "<u4")
        if told.sum(dtype=np.uint64) > size:
            return False
        at += size
    file.seek(header.begins)
    return True
