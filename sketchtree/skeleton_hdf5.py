"""A skeleton in an HDF5 file: one dataset a column of `TreeSkeleton`, without loss.

The root's attributes are `format` ("SketchTree skeleton"), `schema` (1), `version` and what the writer adds (units, frame, seed); every column's `unit` is an attribute of it. Columns that
may be missing have the defaults of `TreeSkeleton.from_columns`; `parent`, `tip` and `radius` are needed. A project file holds the same
columns in its group `skeleton`.
"""

import os
from collections.abc import Mapping

import numpy as np

from sketchtree.errors import SkeletonError
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_files import FLOATS, INTEGERS, shaped
from sketchtree.version import __version__

FORMAT, SCHEMA = "SketchTree skeleton", 1
PROJECT = "SketchTree project"
_LENGTHS = ("tip", "radius", "depth_sd", "curve_points")  # columns in the units of length
_REMEDY = "Give an .h5 or .sketchtree file that SketchTree wrote, or another format."


def read_skeleton_hdf5(path: str | os.PathLike) -> TreeSkeleton:
    """The tree of an HDF5 file, a skeleton or a project. Raises `SkeletonError`."""
    import h5py

    try:
        with open(path, "rb"):
            pass
        with h5py.File(path, "r") as file:
            form, schema = file.attrs.get("format"), int(file.attrs.get("schema", 0))
            group = file["skeleton"] if form == PROJECT else file
            columns = {name: group[name][()] for name in INTEGERS + FLOATS if name in group}
    except (OSError, RuntimeError, ValueError, TypeError, KeyError) as error:
        if isinstance(error, OSError) and error.strerror:
            raise SkeletonError(f"Can't read {path}: {error.strerror.lower()}.", remedy="Check the path.") from error
        raise SkeletonError(f"{path} is no HDF5 file, or is damaged.", remedy=_REMEDY) from error
    if form not in (FORMAT, PROJECT):
        raise SkeletonError(f"{path} is an HDF5 file, but holds no skeleton.", remedy=_REMEDY)
    if schema > SCHEMA:
        raise SkeletonError(f"{path} has skeleton schema {schema}; this version reads {SCHEMA}.", remedy="Update sketchtree.")
    missing = [name for name in ("parent", "tip", "radius") if name not in columns]
    if missing:
        raise SkeletonError(f"{path} has no column `{missing[0]}`.", remedy=_REMEDY)
    if "curve_points" not in columns:
        columns.pop("curve_start", None)
        return TreeSkeleton.from_columns(**columns)
    return TreeSkeleton.from_columns(**shaped(columns))


def read_header(path: str | os.PathLike) -> dict:
    """Units, frame and seed that a file of ours names; it stands in metres unless it says otherwise."""
    import h5py

    with h5py.File(path, "r") as file:
        said = {name: file.attrs[name] for name in ("units", "frame", "seed") if name in file.attrs}
    return {"units": "metres", "frame": "world"} | {name: value.item() if isinstance(value, np.generic) else value for name, value in said.items()}


def write_skeleton_hdf5(path: str | os.PathLike, tree: TreeSkeleton, *, header: Mapping[str, object] | None = None) -> None:
    """Writes every column of the tree, without loss; lengths are metres unless `header["units"]` says otherwise. `path` may be a binary file that is open."""
    import h5py

    told = dict(header or {})
    units = str(told.get("units", "metres"))
    with h5py.File(path, "w", libver=("v110", "v110")) as file:
        put_columns(file, tree, "m" if units == "metres" else units)
        for name, value in told.items():
            file.attrs[name] = value
        file.attrs["format"], file.attrs["schema"], file.attrs["version"] = FORMAT, SCHEMA, __version__


def put_columns(group, tree: TreeSkeleton, length: str = "m") -> None:
    """One dataset a column into an open HDF5 group; `length` is the unit of lengths."""
    for name in INTEGERS + FLOATS:
        put(group, name, getattr(tree, name), length if name in _LENGTHS else "1")


def put(group, name: str, column, unit: str) -> None:
    """A dataset with its unit; it names no time."""
    column = np.asarray(column)
    group.create_dataset(name, data=column, compression="gzip" if column.size and column.ndim else None, track_times=False).attrs["unit"] = unit
