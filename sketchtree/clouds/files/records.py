"""How are records that are all as long read? Some at a time, so that a file may be larger than memory."""

from collections.abc import Iterator
from typing import BinaryIO

from sketchtree.clouds.files.pieces import PIECE
from sketchtree.clouds.files.refused import truncated


def records(file: BinaryIO, size: int, count: int, name: str) -> Iterator[bytes]:
    """The bytes of so many records from here on, a piece at a time. Raises SketchError where the file ends before the last."""
    done = 0
    while done < count:
        wanted = min(PIECE, count - done)
        data = file.read(wanted * size)
        if len(data) < wanted * size:
            raise truncated(name, done + len(data) // size, count)
        done += wanted
        yield data


def left(file: BinaryIO) -> int:
    """Bytes from here to the end; the file stays where it is."""
    here = file.tell()
    end = file.seek(0, 2)
    file.seek(here)
    return end - here
