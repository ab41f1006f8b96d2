"""The drawing inside a SketchTree project (`.sketchtree`, HDF5): sketch JSON in the dataset `sketch`."""

import io
import json
from collections.abc import Callable

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.skeleton_hdf5 import SCHEMA
from sketchtree.sketch.files.limits import MAX_MB

TRUNK = "trunk"  # among a project's options: how a tree is taken from scribbles on its picture (`trunk.wanted.TrunkChoices`)
POINTS = "points"  # likewise: how points of a scan behind the drawing are seen, and used (`editing.laid_cloud.CloudChoices`)
SIGNATURE = b"\x89HDF\r\n\x1a\n"


def drawing_in_project(data: bytes, name: str) -> bytes | None:
    """The sketch JSON that a project holds. None for any other file, another HDF5 file too. Raises SketchError for a project of a newer version of this program."""
    if not data.startswith(SIGNATURE):
        return None
    import h5py

    try:
        with h5py.File(io.BytesIO(data), "r") as file:
            if "sketch" not in file:
                return None
            check_schema(file, name)
            return column(file, "sketch").tobytes()
    except (OSError, RuntimeError, ValueError, TypeError, KeyError, AttributeError):
        return None


def holds_photo(path) -> bool:
    """Is it a project whose strokes mark the tree in a photo?"""
    return _is(path, lambda file: "underlay" in file and bool(file["underlay"].attrs.get("photo", False)))


def holds_scribbles(path) -> bool:
    """Is it a project whose tree is taken from scribbles on its photo?"""
    return holds_photo(path) and _is(path, lambda file: _says(file, TRUNK, "on"))


def holds_cloud(path) -> bool:
    """Is it a project with points of a scan behind the drawing?"""
    return _is(path, lambda file: "cloud" in file)


def holds_traced(path) -> bool:
    """Is it a project whose tree is the one that stands in its points?"""
    return holds_cloud(path) and _is(path, lambda file: _says(file, POINTS, "traced"))


def _is(path, asked: Callable) -> bool:
    """Is a file a project of which this is true? `asked` gets it open."""
    try:
        with open(path, "rb") as file:
            if file.read(8) != SIGNATURE:
                return False
        import h5py

        with h5py.File(path, "r") as file:
            return asked(file)
    except (OSError, RuntimeError, ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return False  # whoever reads the strokes says so


def _says(file, what: str, name: str) -> bool:
    """Do the options of a project say so?"""
    return "options" in file and bool((json.loads(column(file, "options").tobytes()).get(what) or {}).get(name))


def check_schema(file, name: str) -> None:
    """Raise SketchError for an open project that a newer version wrote: what it holds may mean something else there."""
    try:
        schema = int(file.attrs.get("schema", SCHEMA))
    except (ValueError, TypeError) as error:
        raise SketchError(f"{name} is damaged ({error}).", remedy="Open an older copy of it.") from error
    if schema > SCHEMA:
        raise SketchError(f"{name} has project schema {schema}; this version reads {SCHEMA}.", remedy="Update sketchtree.")


def column(file, name: str) -> np.ndarray:
    """A column of an HDF5 file; a small file may say that it holds more than any machine does. Raises ValueError for more than MAX_MB, KeyError where there is none."""
    found = file[name]
    size = getattr(found, "size", None)
    if size is None:
        raise ValueError(f"`{name}` is no column")
    if size * found.dtype.itemsize > MAX_MB * 1e6:
        raise ValueError(f"`{name}` says that it holds {size * found.dtype.itemsize / 1e6:.3g} MB; {MAX_MB:g} MB is the most")
    return found[()]
