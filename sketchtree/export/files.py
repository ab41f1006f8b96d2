"""Can this file be written, and is it there whole or not at all?

A file is written under a temporary name beside its target, flushed, and renamed over it; whatever stops the
program, the target holds either what it held before or the whole new file.
"""

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from sketchtree.errors import ExportError

MESHES = (".glb", ".obj", ".ply", ".stl")
SKELETONS = (".swc", ".json")
_LATER = {
    ".gltf": "write .glb, the same format in one file",
    ".usd": "write .glb",
    ".usda": "write .glb",
    ".usdz": "write .glb",
    ".mtg": "write .swc",
    ".h5": "write .json",
    ".sketchtree": "write .glb, which holds the skeleton too",
}


def check_extension(path: str | os.PathLike, allowed: tuple[str, ...] = MESHES + SKELETONS) -> str:
    """The lower-case extension of the path. Raises `ExportError` unless it is one of `allowed`."""
    suffix = Path(path).suffix.lower()
    if suffix in allowed:
        return suffix
    said = f"`{suffix}` files are not written" if suffix else "it has no extension to tell the format"
    hint = _LATER.get(suffix, "")
    raise ExportError(
        f"Can't write {path}: {said}. This version writes {', '.join(allowed)} here.",
        remedy=f"{hint[0].upper()}{hint[1:]}." if hint else "Choose one of these extensions.",
    )


def check_writable(path: str | os.PathLike) -> Path:
    """The path, if a file can be written there. Nothing is left behind; call it before long work.

    Raises `ExportError` where the folder is missing or read-only, or the path is itself a folder.
    """
    path = Path(path)
    folder = path.parent
    if path.is_dir():
        raise ExportError(f"Can't write {path}: it is a folder.", remedy="Add a file name to the path.")
    if not folder.is_dir():
        raise ExportError(f"Can't write {path}: the folder {folder} does not exist.", remedy="Create it, or choose another path.")
    probe = _beside(path)
    try:
        probe.touch(exist_ok=False)
        probe.unlink()
    except OSError as error:
        raise ExportError(f"Can't write {path}: {_why(error)}.", remedy="Choose a folder you may write to.") from error
    return path


@contextmanager
def whole_file(path: str | os.PathLike) -> Iterator[Path]:
    """A temporary path beside `path`, moved over it when the block ends without an error, else removed."""
    path = check_writable(path)
    temporary = _beside(path)
    try:
        yield temporary
        os.replace(temporary, path)
    except OSError as error:
        raise ExportError(f"Can't write {path}: {_why(error)}.", remedy="Free some space or choose another folder.") from error
    finally:
        temporary.unlink(missing_ok=True)


def write_whole(path: str | os.PathLike, data: bytes) -> None:
    """Write the bytes, all or nothing."""
    with whole_file(path) as temporary, open(temporary, "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def _beside(path: Path) -> Path:
    return path.with_name(f".{path.stem[:40]}-{os.getpid()}-{secrets.token_hex(4)}{path.suffix}")


def _why(error: OSError) -> str:
    return (error.strerror or type(error).__name__).lower()
