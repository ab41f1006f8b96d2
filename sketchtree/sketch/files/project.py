"""The drawing inside a SketchTree project (`.sketchtree`, HDF5): sketch JSON in the dataset `sketch`."""

import io

SIGNATURE = b"\x89HDF\r\n\x1a\n"


def drawing_in_project(data: bytes) -> bytes | None:
    """The sketch JSON that a project holds. None for any other file, another HDF5 file too."""
    if not data.startswith(SIGNATURE):
        return None
    import h5py

    try:
        with h5py.File(io.BytesIO(data), "r") as file:
            return file["sketch"][()].tobytes() if "sketch" in file else None
    except (OSError, RuntimeError, ValueError, TypeError, KeyError, AttributeError):
        return None
