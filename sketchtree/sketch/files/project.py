"""The drawing inside a SketchTree project (`.sketchtree`, HDF5): sketch JSON in the dataset `sketch`."""

import io

import numpy as np

from sketchtree.sketch.files.limits import MAX_MB

SIGNATURE = b"\x89HDF\r\n\x1a\n"


def drawing_in_project(data: bytes) -> bytes | None:
    """The sketch JSON that a project holds. None for any other file, another HDF5 file too."""
    if not data.startswith(SIGNATURE):
        return None
    import h5py

    try:
        with h5py.File(io.BytesIO(data), "r") as file:
            return column(file, "sketch").tobytes() if "sketch" in file else None
    except (OSError, RuntimeError, ValueError, TypeError, KeyError, AttributeError):
        return None


def column(file, name: str) -> np.ndarray:
    """A column of an HDF5 file; a small file may say that it holds more than any machine does. Raises ValueError for more than MAX_MB, KeyError where there is none."""
    found = file[name]
    size = getattr(found, "size", None)
    if size is None:
        raise ValueError(f"`{name}` is no column")
    if size * found.dtype.itemsize > MAX_MB * 1e6:
        raise ValueError(f"`{name}` says that it holds {size * found.dtype.itemsize / 1e6:.3g} MB; {MAX_MB:g} MB is the most")
    return found[()]
