"""Which points are in this LAS or LAZ file? LAS is read here; LAZ is unpacked by lazrs (the extra `multiview`), record for record the same.

Points that are withheld or classed as noise are left out, and that is said.
"""

from collections.abc import Iterator
from typing import BinaryIO

import numpy as np

from sketchtree.clouds.files.las_header import LasHeader, las_header
from sketchtree.clouds.files.limits import no_points, truncated
from sketchtree.clouds.files.pieces import PIECE, Piece, Source
from sketchtree.errors import SketchError


def read_las(file: BinaryIO, name: str) -> Source:
    """The points of a LAS or LAZ file that is open at its beginning."""
    header = las_header(file, name)
    if not header.count:
        raise no_points(name)
    records = _plain(file, header, name) if header.packed is None else _unpacked(file, header, name)
    source = Source("LAS" if header.packed is None else "LAZ", iter(()), header.count, None, "z")
    source.pieces = _pieces(records, header, source, name)
    return source


def _pieces(records: Iterator[np.ndarray], header: LasHeader, source: Source, name: str) -> Iterator[Piece]:
    noise = 0
    for some in records:
        kept = header.meant(some)
        noise += int((~kept).sum())
        some = some[kept]
        yield Piece(header.xyz(some), header.colour(some) if header.coloured else None)
    if noise:
        source.remarks.append(f"{noise:,} points of {name} are marked as noise or withheld; they were left out.")


def _plain(file: BinaryIO, header: LasHeader, name: str) -> Iterator[np.ndarray]:
    done = 0
    while done < header.count:
        wanted = min(PIECE, header.count - done)
        data = file.read(wanted * header.size)
        if len(data) < wanted * header.size:
            raise truncated(name, done + len(data) // header.size, header.count)
        done += wanted
        yield np.frombuffer(data, np.uint8).reshape(wanted, header.size)


def _unpacked(file: BinaryIO, header: LasHeader, name: str) -> Iterator[np.ndarray]:
    try:
        import lazrs
    except ImportError:
        raise SketchError(f"{name} is a LAZ file, which needs the package `lazrs`.", remedy="Install it: pip install 'sketchtree[multiview]'.") from None
    done = 0
    try:
        unpacker = lazrs.LasZipDecompressor(file, header.packed)
        while done < header.count:
            wanted = min(PIECE, header.count - done)
            data = bytearray(wanted * header.size)
            unpacker.decompress_many(data)
            done += wanted
            yield np.frombuffer(data, np.uint8).reshape(wanted, header.size)
    except lazrs.LazrsError as error:
        raise SketchError(f"{name} can't be unpacked after {done:,} of its {header.count:,} points ({error}).", remedy="Copy or export it again.") from None
