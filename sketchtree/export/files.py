"""Can this file be written, and is it there whole or not at all?

A file is written under a temporary name beside its target, flushed, and renamed over it; whatever stops the
program, the target holds either what it held before or the whole new file. Files that belong together are all written
under temporary names first; should a rename fail after that, those before it are undone.
"""

import os
import secrets
import shutil
import stat
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path

from sketchtree.errors import ExportError

MESHES = (".glb", ".gltf", ".usd", ".usda", ".usdc", ".usdz", ".obj", ".ply", ".stl", ".3mf")
SKELETONS = (".swc", ".mtg", ".json", ".h5")
PROJECTS = (".sketchtree",)
_DEVICES = ("/dev", "/dev/fd")
_ELSEWHERE = {".fbx": "write .glb, which the same programs open", ".blend": "write .glb and open it in Blender", ".xml": "write .usda or .glb"}


def check_extension(path: str | os.PathLike, allowed: tuple[str, ...] = MESHES + SKELETONS) -> str:
    """The lower-case extension of the path. Raises `ExportError` unless it is one of `allowed`."""
    suffix = Path(path).suffix.lower()
    if suffix in allowed:
        return suffix
    said = f"`{suffix}` files are not written" if suffix else "it has no extension to tell the format"
    hint = _ELSEWHERE.get(suffix, "") if ".glb" in allowed else ""
    raise ExportError(
        f"Can't write {path}: {said}. This version writes {', '.join(allowed)} here.",
        remedy=f"{hint[0].upper()}{hint[1:]}." if hint else "Choose one of these extensions.",
    )


def check_program(path: str | os.PathLike, verb: str = "write") -> None:
    """Raises `ExportError` where the format needs a package that is not installed. Call it before long work."""
    if Path(path).suffix.lower() in (".usd", ".usda", ".usdc", ".usdz") and find_spec("pxr") is None:
        raise ExportError(f"Can't {verb} {path}: USD needs the package `usd-core`.", remedy="Install it: pip install 'sketchtree[usd]'.")


def check_writable(path: str | os.PathLike) -> Path:
    """The path, if a file can be written there; of a link, the path of what it links to. Nothing is left behind; call it before long work.

    Raises `ExportError` where the folder is missing or read-only, or the path is itself a folder, a read-only file, or no file at all (a device, a pipe).
    """
    if os.path.dirname(os.path.abspath(path)) in _DEVICES:  # links there, such as /dev/stdout, name what is open elsewhere
        raise _no_file(path)
    path = Path(os.path.realpath(path)) if os.path.islink(path) else Path(path)
    folder = path.parent
    if os.path.isdir(path):
        raise ExportError(f"Can't write {path}: it is a folder.", remedy="Add a file name to the path.")
    if not folder.is_dir():
        raise ExportError(f"Can't write {path}: the folder {folder} does not exist.", remedy="Create it, or choose another path.")
    _check_held(path)
    probe = _beside(path)
    try:
        probe.touch(exist_ok=False)
        probe.unlink()
    except OSError as error:
        raise ExportError(f"Can't write {path}: {_why(error)}.", remedy="Choose a folder you may write to.") from error
    return path


def _check_held(path: Path) -> None:
    """Raises `ExportError` where what stands there may not be replaced."""
    try:
        mode = path.stat().st_mode
    except FileNotFoundError:
        return
    except OSError as error:
        raise ExportError(f"Can't write {path}: {_why(error)}.", remedy="Choose another name.") from error
    if not stat.S_ISREG(mode):
        raise _no_file(path)
    if not mode & (stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH):
        raise ExportError(f"Can't write {path}: it is read-only.", remedy="Make it writable, or choose another name.")


def _no_file(path) -> ExportError:
    return ExportError(f"Can't write {path}: it is a device or a pipe, and files are written whole.", remedy="Name an ordinary file.")


@contextmanager
def whole_file(path: str | os.PathLike) -> Iterator[Path]:
    """A temporary path beside `path`, moved over it when the block ends without an error, else removed."""
    path = check_writable(path)
    temporary = _beside(path)
    try:
        yield temporary
        os.replace(temporary, path)
    except OSError as error:
        raise _cannot(path, error) from error
    finally:
        temporary.unlink(missing_ok=True)


def write_whole(path: str | os.PathLike, data: bytes) -> None:
    """Write the bytes, all or nothing."""
    with whole_file(path) as temporary:
        _write(temporary, data)


def write_set(files: Mapping[Path, bytes]) -> None:
    """Write files that belong together: afterwards all are new or, where one can't be written, all as they were.

    Folders that are named and missing are made, one level deep. Raises `ExportError` naming the file at fault.
    """
    made = _made_folders(files)
    temporary = {}
    try:
        for named, data in files.items():
            path = check_writable(named)
            temporary[path] = _beside(path)
            try:
                _write(temporary[path], data)
            except OSError as error:
                raise _cannot(path, error) from error
        _exchange(temporary)
        made = []
    finally:
        for path in temporary.values():
            path.unlink(missing_ok=True)
        for folder in made:
            folder.rmdir()


def _made_folders(files: Mapping[Path, bytes]) -> list[Path]:
    """Folders in the one that the files share, which were missing and are there now."""
    home, made = min((path.parent for path in files), key=lambda folder: len(folder.parts)), []
    for folder in dict.fromkeys(path.parent for path in files):
        if folder.parent == home and folder != home and not folder.exists():
            try:
                folder.mkdir()
            except OSError as error:
                raise _cannot(folder, error) from error
            made.append(folder)
    return made


def _exchange(temporary: Mapping[Path, Path]) -> None:
    """Every temporary file over its target; what was there comes back if one can't be moved."""
    kept, moved, path = {}, [], None
    try:
        for path, new in temporary.items():
            if path.exists() and len(temporary) > 1:
                kept[path] = _twin(path)
            os.replace(new, path)
            moved.append(path)
    except BaseException as error:
        for done in moved:
            if done in kept:
                os.replace(kept.pop(done), done)
            else:
                done.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise _cannot(path, error) from error
        raise
    finally:
        for old in kept.values():
            old.unlink(missing_ok=True)


def _twin(path: Path) -> Path:
    """A second name of the same file; where the disk has no such thing, a copy."""
    twin = _beside(path)
    try:
        os.link(path, twin)
    except OSError:
        shutil.copyfile(path, twin)
    return twin


def _write(path: Path, data: bytes) -> None:
    with open(path, "wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())


def _cannot(path: Path, error: OSError) -> ExportError:
    return ExportError(f"Can't write {path}: {_why(error)}.", remedy="Free some space or choose another folder.")


def _beside(path: Path) -> Path:
    return path.with_name(f".{path.stem[:40]}-{os.getpid()}-{secrets.token_hex(4)}{path.suffix}")


def _why(error: OSError) -> str:
    return (error.strerror or type(error).__name__).lower()
