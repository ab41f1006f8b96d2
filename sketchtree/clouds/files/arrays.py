"""Which points are in this file of numpy's? NPY: one table, or one with named columns; NPZ: tables by name."""

import struct
import tokenize
import zipfile
import zlib
from collections.abc import Iterator
from typing import BinaryIO

import numpy as np

from sketchtree.clouds.files.limits import UNPACKED
from sketchtree.clouds.files.pieces import PIECE, Piece, Source
from sketchtree.clouds.files.refused import CUT_OFF, no_points
from sketchtree.errors import SketchError

_PLACE = ("xyz", "points", "point", "positions", "position", "pos", "coords", "coordinates", "vertices")
_COLOUR = ("rgb", "colours", "colors", "colour", "color")
_NORMAL = ("normals", "normal")
_DAMAGED = (ValueError, OSError, EOFError, KeyError, SyntaxError, tokenize.TokenError, zipfile.BadZipFile, zlib.error, struct.error, MemoryError, NotImplementedError, RuntimeError)
_SAVE = "Save the points as `xyz`, an array of three columns; colours as `rgb`."


def read_npy(file: BinaryIO, name: str) -> Source:
    """The points of an NPY file: the first three columns of a table, or columns named x, y, z."""
    table = _loaded(lambda: np.load(file, allow_pickle=False), name)
    if table.dtype.names:
        named = {word.lower(): word for word in table.dtype.names}
        groups = [np.stack([table[named[k]] for k in keys], axis=1) if set(keys) <= set(named) else None for keys in ("xyz", ("red", "green", "blue"))]
        if groups[0] is None:
            raise SketchError(f"The columns of {name} are {', '.join(table.dtype.names)}; none are x, y and z.", remedy=_SAVE)
        return _source(groups[0], groups[1], None, name, "NPY")
    if table.ndim == 2 and table.shape[1] > 3 and table.dtype.kind in "fiu":
        table = table[:, :3]
    return _source(table, None, None, name, "NPY")


def read_npz(file: BinaryIO, name: str) -> Source:
    """The points of an NPZ file: `xyz` or `points`, with `rgb` or `colours` and `normals`."""
    if not zipfile.is_zipfile(file):
        raise SketchError(f"{name} is an archive that was cut off.", remedy=CUT_OFF)
    held = _loaded(lambda: {entry.filename: entry.file_size for entry in zipfile.ZipFile(file).infolist()}, name)
    if not held or any(not entry.endswith(".npy") for entry in held):
        raise SketchError(f"{name} is an archive, not a point cloud.", remedy="Unpack it, and give the cloud inside.")
    if sum(held.values()) > UNPACKED:
        raise SketchError(f"{name} unpacks to {sum(held.values()) / 1e9:.1f} GB, more than {UNPACKED / 1e9:g} GB.", remedy="Save it as LAZ, LAS or PLY.")
    file.seek(0)
    names = [entry.removesuffix(".npy") for entry in held]
    if "parent" in names:
        raise SketchError(f"{name} is a skeleton, not a point cloud.", remedy="Give the scan it was made from.")
    place, colour, normal = (next((word for word in group if word in names), None) for group in (_PLACE, _COLOUR, _NORMAL))
    if place is None:
        raise SketchError(f"{name} holds {', '.join(sorted(names)[:6])}; none is `xyz` or `points`.", remedy=_SAVE)
    with _loaded(lambda: np.load(file, allow_pickle=False), name) as archive:
        found = [None if key is None else _loaded(lambda key=key: archive[key], name) for key in (place, colour, normal)]
    if found[1] is not None and found[1].ndim == 2 and found[1].shape[1] == 4:
        found[1] = found[1][:, :3]  # without alpha
    return _source(*found, name, "NPZ")


def _loaded(load, name: str):
    """What `load` gives. Raises SketchError, naming the file, where it is damaged."""
    try:
        return load()
    except _DAMAGED as error:
        raise SketchError(f"{name} can't be read ({str(error).splitlines()[0] if str(error) else type(error).__name__}).", remedy="Save it again.") from None


def _source(xyz, colour, normal, name: str, what: str) -> Source:
    for column, says in ((xyz, "points"), (colour, "colours"), (normal, "normals")):
        if column is not None and (column.ndim != 2 or column.shape[1] != 3 or column.dtype.kind not in "fiu" or len(column) != len(xyz)):
            raise SketchError(f"The {says} of {name} are a table of shape {column.shape}.", remedy=_SAVE)
    if not len(xyz):
        raise no_points(name)
    top = float(np.iinfo(colour.dtype).max) if colour is not None and colour.dtype in (np.uint8, np.uint16) else None
    return Source(what, _pieces(xyz, colour, normal), len(xyz), top)


def _pieces(*columns) -> Iterator[Piece]:
    for first in range(0, len(columns[0]), PIECE):
        with np.errstate(invalid="ignore"):  # numbers that are none are left out later
            piece = Piece(*(None if column is None else column[first : first + PIECE].astype(np.float64) for column in columns))
        yield piece
