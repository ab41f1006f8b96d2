"""A file → a cloud, by what the file holds: PLY, LAS, LAZ, text with x, y, z, NPZ or NPY; never more points than asked for, and all that was done is said."""

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.arrays import read_npy, read_npz
from sketchtree.clouds.files.gathering import Columns, Gathering
from sketchtree.clouds.files.las import read_las
from sketchtree.clouds.files.limits import MAX_POINTS, check_limit, opened
from sketchtree.clouds.files.pieces import Source
from sketchtree.clouds.files.placed import Placed, Placement
from sketchtree.clouds.files.ply import read_ply
from sketchtree.clouds.files.recognise import HEAD, LAS, NPY, NPZ, PLY, TEXT, recognise
from sketchtree.clouds.files.refused import no_points
from sketchtree.clouds.files.text import read_text
from sketchtree.errors import OptionError, SketchError
from sketchtree.similarity import Similarity

Progress = Callable[[float], None]  # told the part done, 0 to 1
_READERS = {PLY: read_ply, LAS: read_las, NPY: read_npy, NPZ: read_npz, TEXT: read_text}
_TOPS = (1.0, 255.0, 65535.0)  # what full colour may be written as
_LEAST, _MOST = 1e-6, 1e4  # metres that a unit may be
_NO_UNIT = 1e-9  # a normal shorter than this has no direction


def read_cloud(path: str | os.PathLike, *, unit: float = 1.0, max_points: int = MAX_POINTS, progress: Progress | None = None) -> PointCloud:
    """The points of a file, in metres; its axes are the file's (`clouds.prepared` turns them). See `read_placed`."""
    return read_placed(path, unit=unit, max_points=max_points, progress=progress).cloud


def read_placed(path: str | os.PathLike, *, unit: float = 1.0, max_points: int = MAX_POINTS, progress: Progress | None = None) -> Placed:
    """The points of a file and what was done to them. `unit`: metres that 1 in the file means; `max_points`: a larger cloud is thinned while it is read.

    Raises SketchError, naming the file (and the line), for one that holds no cloud, ends too early or can't be read; OptionError for a limit or a unit that makes no sense.
    """
    check_limit(max_points)
    if not _LEAST <= unit <= _MOST:
        raise OptionError(f"`unit` is {unit}.", remedy="Say how many metres 1 in the file means: 0.001 for millimetres.")
    path = Path(path)
    with opened(path) as file:
        head = file.read(HEAD)
        file.seek(0)
        source = _READERS[recognise(head, path.name)](file, path.name)
        columns = _gathered(source, max_points, progress)
    if columns is None:
        raise _nothing(path.name, source)
    cloud = PointCloud(columns.xyz * unit, _colours(columns, source), _normals(columns))
    similarity = Similarity(unit, tuple(0.0 - unit * shift for shift in columns.offset))
    return Placed(cloud, Placement("y", similarity), source.what, source.up, columns.read, columns.voxel * unit, _remarks(path.name, source, columns, unit))


def _gathered(source: Source, max_points: int, progress: Progress | None) -> Columns | None:
    gathering, done = Gathering(max_points), 0
    for piece in source.pieces:
        gathering.add(piece)
        done += len(piece.xyz)
        if progress is not None and source.points:
            progress(min(done / source.points, 1.0))
    return gathering.columns()


def _nothing(name: str, source: Source) -> SketchError:
    if source.points:
        return SketchError(f"None of the {source.points:,} points of {name} is a place.", remedy="Export the cloud again: all its numbers are missing, infinite or marked as noise.")
    return no_points(name)


def _colours(columns: Columns, source: Source) -> np.ndarray | None:
    """Colours as 0-1. Where the file doesn't say what full colour is, the least of 1, 255 and 65535 that no colour exceeds."""
    if columns.colour is None:
        return None
    most = float(np.nanmax(columns.colour, initial=0.0))
    top = source.colour_top or next((top for top in _TOPS if most <= top), most)
    return np.clip(np.nan_to_num(columns.colour.astype(np.float64) / top), 0.0, 1.0)


def _normals(columns: Columns) -> np.ndarray | None:
    """Normals of length 1; none where some of the file's have no direction."""
    if columns.normal is None:
        return None
    normal = columns.normal.astype(np.float64)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    return normal / length if (np.isfinite(length) & (length > _NO_UNIT)).all() else None


def _remarks(name: str, source: Source, columns: Columns, unit: float) -> tuple[str, ...]:
    remarks = list(source.remarks)
    if columns.nowhere:
        remarks.append(f"{columns.nowhere:,} of {columns.read:,} points of {name} are not finite, or nowhere near the rest; they were left out.")
    if columns.voxel:
        kept, size = len(columns.xyz), columns.voxel * unit
        remarks.append(f"{name} holds {columns.read:,} points; {kept:,} were kept, one in each voxel of {1000 * size:.3g} mm.")
    if any(columns.offset):
        remarks.append(f"The points of {name} lie far from the origin; they were moved by {', '.join(f'{0.0 - shift:,.0f}' for shift in columns.offset)}.")
    if columns.normal is not None and _normals(columns) is None:
        remarks.append(f"Some normals of {name} have no direction; all were passed over.")
    return tuple(remarks)
