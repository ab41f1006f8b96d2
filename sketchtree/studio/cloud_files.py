"""Which files are point clouds? By their first bytes where those say it, else by the name: text with x, y, z looks like any other."""

from pathlib import Path

_BEGIN = (b"ply\n", b"ply\r\n", b"LASF", b"\x93NUMPY")
NAMES = (".ply", ".las", ".laz", ".xyz", ".txt", ".csv", ".pts", ".asc", ".npz", ".npy")

PLAINLY = (".ply", ".las", ".laz", ".xyz", ".pts")  # of them, those that hold hardly anything else: a folder shows them


def is_cloud(data: bytes, name: str) -> bool:
    """Is it to be read as points? Whether it holds any, its reader says."""
    return data.startswith(_BEGIN) or Path(name).suffix.lower() in NAMES
