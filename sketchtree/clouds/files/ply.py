"""Which points are in this PLY file? Text or binary, in either byte order; what a vertex has besides place, colour and normal is passed over, and so are faces."""

from collections.abc import Iterator
from itertools import islice
from typing import BinaryIO

import numpy as np

from sketchtree.clouds.files.numbers import numbers
from sketchtree.clouds.files.pieces import PIECE, Piece, Source
from sketchtree.clouds.files.ply_header import Element, ply_header
from sketchtree.clouds.files.records import left, records
from sketchtree.clouds.files.refused import CUT_OFF, no_points, truncated
from sketchtree.errors import SketchError

_COLOUR = (("red", "diffuse_red", "r"), ("green", "diffuse_green", "g"), ("blue", "diffuse_blue", "b"))
_NORMAL = (("nx", "normal_x"), ("ny", "normal_y"), ("nz", "normal_z"))


def read_ply(file: BinaryIO, name: str) -> Source:
    """The points of a PLY file that is open at its beginning."""
    header = ply_header(file, name)
    names = [element.name for element in header.elements]
    if "vertex" not in names:
        raise SketchError(f"{name} is a PLY file without vertices.", remedy="Export the cloud again, with its points.")
    at = names.index("vertex")
    vertex = header.elements[at]
    place = [vertex.where(axis) for axis in "xyz"]
    if None in place:
        raise SketchError(f"The vertices of {name} have no {', '.join(a for a, k in zip('xyz', place, strict=True) if k is None)}.", remedy="Export it again.")
    if not vertex.count:
        raise no_points(name)
    groups = [place, *([k for k in (vertex.where(*names) for names in group)] for group in (_COLOUR, _NORMAL))]
    groups = [None if None in group else group for group in groups]
    if header.text:
        table = _text(file, name, header.elements[:at], vertex, header.lines)
    else:
        for element in header.elements[:at]:
            _pass_over(file, element, name)
        table = _binary(file, name, vertex)
    whole = groups[1] is not None and vertex.properties[groups[1][0]].type.kind in "ui"
    top = float(np.iinfo(vertex.properties[groups[1][0]].type).max) if whole else None
    source = Source("PLY", _pieces(table, groups), vertex.count, top, header.up)
    faces = next((element.count for element in header.elements if element.name == "face"), 0)
    if faces:
        source.remarks.append(f"{name} is a mesh; its {vertex.count:,} vertices were taken as points, its {faces:,} faces were not.")
    return source


def _pieces(table: Iterator[list], groups) -> Iterator[Piece]:
    for columns in table:
        with np.errstate(invalid="ignore"):  # numbers that are none are left out later
            piece = Piece(*(None if group is None else np.stack([columns[k] for k in group], axis=1).astype(np.float64) for group in groups))
        yield piece


def _text(file: BinaryIO, name: str, before: tuple[Element, ...], vertex: Element, lines: int) -> Iterator[dict]:
    """Columns of vertices, by place, of lines."""
    skipped = sum(element.count for element in before)
    rest = islice(file, skipped, skipped + vertex.count)
    if vertex.lists:
        rest = (_flat(line, vertex) for line in rest)
    wanted, done = [k for k, one in enumerate(vertex.properties) if one.length is None], 0
    while done < vertex.count:
        some = [line.decode("latin-1") if isinstance(line, bytes) else line for line in islice(rest, PIECE)]
        if not some:
            raise truncated(name, done, vertex.count)
        values = numbers(some, wanted, name, first=lines + skipped + done + 1, separator=None)
        done += len(some)
        yield dict(zip(wanted, values.T, strict=True))


def _flat(line: bytes, vertex: Element) -> str:
    """A line whose lists are one word each."""
    words, at, out = line.decode("latin-1").split(), 0, []
    for one in vertex.properties:
        out.append(words[at] if at < len(words) else "")
        at += 1 + (int(words[at]) if one.length is not None and at < len(words) and words[at].isdigit() else 0)
    return " ".join(out)


def _binary(file: BinaryIO, name: str, vertex: Element) -> Iterator[dict]:
    """Columns of vertices, by place, of records."""
    if vertex.lists:
        yield _walked(file, name, vertex)
        return
    record = np.dtype([(f"p{k}", one.type) for k, one in enumerate(vertex.properties)])
    for data in records(file, record.itemsize, vertex.count, name):
        rows = np.frombuffer(data, record)
        yield {k: rows[f"p{k}"] for k in range(len(vertex.properties))}


def _walked(file: BinaryIO, name: str, vertex: Element) -> dict:
    """Columns of records that differ in length: one by one."""
    least = sum((one.type if one.length is None else one.length).itemsize for one in vertex.properties)
    there = left(file) // least
    if there < vertex.count:
        raise truncated(name, there, vertex.count)
    columns = {k: np.empty(vertex.count) for k, one in enumerate(vertex.properties) if one.length is None}
    for row in range(vertex.count):
        for k, one in enumerate(vertex.properties):
            value = _number(file, one.type if one.length is None else one.length)
            if value is None or (one.length is not None and not _skip(file, int(value) * one.type.itemsize)):
                raise truncated(name, row, vertex.count)
            if one.length is None:
                columns[k][row] = value
    return columns


def _pass_over(file: BinaryIO, element: Element, name: str) -> None:
    """Leave an element's records behind."""
    if not element.lists:
        file.seek(element.count * sum(one.type.itemsize for one in element.properties), 1)
        return
    for row in range(element.count):
        for one in element.properties:
            value = _number(file, one.type if one.length is None else one.length)
            if value is None or (one.length is not None and not _skip(file, int(value) * one.type.itemsize)):
                raise SketchError(f"{name} ends in its {element.name}s, after {row:,} of {element.count:,}.", remedy=CUT_OFF)


def _number(file: BinaryIO, kind: np.dtype):
    data = file.read(kind.itemsize)
    return np.frombuffer(data, kind)[0] if len(data) == kind.itemsize else None


def _skip(file: BinaryIO, size: int) -> bool:
    return size >= 0 and len(file.read(size)) == size
