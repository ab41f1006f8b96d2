"""Which files is a numbered series of trees? NAME_0000.glb, NAME_0001.glb … in one folder: all of them or none."""

import glob
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from sketchtree.errors import ExportError

FRAMES = 24
"""Trees of a series, unless said otherwise."""


def series_files(folder: Path, stem: str, frames: int | None) -> list[Path]:
    """In order."""
    return [folder / f"{stem}_{k:04d}.glb" for k in range(frames or FRAMES)]


def check_series(folder: Path, stems: list[str], frames: int | None) -> None:
    """Refuse, before any work, a folder that can't be had, and one that holds a longer series. Raises ExportError."""
    if folder.exists() and not folder.is_dir():
        raise ExportError(f"`--series {folder}` is a file, not a folder.", remedy="Name a folder; it is made if it is missing.")
    if not folder.parent.is_dir():
        raise ExportError(f"Can't write {folder}: the folder {folder.parent} does not exist.", remedy="Create it, or choose another path.")
    for stem in stems:
        ours = {path.name for path in series_files(folder, stem, frames)}
        others = sorted(path.name for path in folder.glob(f"{glob.escape(stem)}_[0-9][0-9][0-9][0-9].glb") if path.name not in ours) if folder.exists() else []
        if others:
            raise ExportError(f"{folder} holds {others[0]} of a longer series, which would stand among the new one.", remedy="Choose another folder, or clear this one.")


def write_series(paths: list[Path], make: Callable[[Path, int], bytes], on_part: Callable[[float], None]) -> None:
    """All of them, or none; the folder is made if it is missing. `make`: the bytes of a file and its number."""
    from sketchtree.export.files import write_set

    folder, last = paths[0].parent, max(len(paths) - 1, 1)

    def frame(path: Path, number: int) -> bytes:
        on_part(number / last)
        return make(path, number)

    made = not folder.exists()
    folder.mkdir(exist_ok=True)
    try:
        write_set(_Frames(paths, frame))
    except BaseException:
        if made:
            folder.rmdir()
        raise


class _Frames(Mapping):
    """Path → bytes, each made when it is asked for: a long series need not fit into memory."""

    def __init__(self, paths: list[Path], make):
        self._number, self._make = {path: k for k, path in enumerate(paths)}, make

    def __getitem__(self, path: Path) -> bytes:
        return self._make(path, self._number[path])

    def __iter__(self) -> Iterator[Path]:
        return iter(self._number)

    def __len__(self) -> int:
        return len(self._number)
