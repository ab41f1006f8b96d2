"""Which points are in this LAS or LAZ file? A LAZ file is unpacked first (`laz`), record for record the same.

Points that are withheld or classed as noise are left out, and that is said.
"""

from collections.abc import Iterator
from typing import BinaryIO

import numpy as np

from sketchtree.clouds.files.las_header import LasHeader, las_header
from sketchtree.clouds.files.laz import unpacked
from sketchtree.clouds.files.pieces import Piece, Source
from sketchtree.clouds.files.records import records
from sketchtree.clouds.files.refused import no_points


def read_las(file: BinaryIO, name: str) -> Source:
    """The points of a LAS or LAZ file that is open at its beginning."""
    header = las_header(file, name)
    if not header.count:
        raise no_points(name)
    found = _plain(file, header, name) if header.packed is None else unpacked(file, header, name)
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
