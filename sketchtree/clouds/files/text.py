"""Which points are in this text? Lines of x y z, with or without colour and normal: XYZ, TXT, CSV, PTS, ASC."""

from collections.abc import Iterator
from itertools import islice
from typing import BinaryIO

import numpy as np

from sketchtree.clouds.files.numbers import numbers
from sketchtree.clouds.files.pieces import PIECE, Piece, Source
from sketchtree.clouds.files.text_columns import LOOKED_AT, Layout, layout

_LINE = 100_000  # characters: no line of points is longer


def read_text(file: BinaryIO, name: str) -> Source:
    """The points of a text that is open at its beginning."""
    lines = _lines(file)
    head = list(islice(lines, LOOKED_AT))
    held = layout(head, name)
    source = Source("text", _pieces(head, lines, held, name))
    if held.decimal_comma:
        source.remarks.append(f"{name} writes decimals with a comma; they were read so.")
    return source


def _lines(file: BinaryIO) -> Iterator[str]:
    """The lines, one by one; a byte order mark is left out."""
    first = file.readline(_LINE).removeprefix(b"\xef\xbb\xbf")
    yield first.decode("utf-8", "replace")
    while line := file.readline(_LINE):
        yield line.decode("utf-8", "replace")


def _pieces(head: list[str], lines: Iterator[str], held: Layout, name: str) -> Iterator[Piece]:
    wanted = [column for group in held.groups if group is not None for column in group]
    some, number = head[held.skipped :], held.skipped + 1
    while some:
        if held.decimal_comma:
            some = [line.replace(",", ".") for line in some]
        values = numbers(some, wanted, name, first=number, separator=held.separator)
        number += len(some)
        place = {column: values[:, k] for k, column in enumerate(wanted)}
        yield Piece(*(None if group is None else np.stack([place[column] for column in group], axis=1) for group in held.groups))
        some = list(islice(lines, PIECE))
