"""Which files may the page name? Those of one folder, by their names alone: no path, no link that leads out, nothing hidden, nothing that is no plain file."""

import os
import stat
from dataclasses import dataclass
from pathlib import Path

from sketchtree.errors import ExportError, SketchError
from sketchtree.export.files import write_whole
from sketchtree.studio.cloud_files import PLAINLY
from sketchtree.studio.messages import MAX_UPLOAD

PROJECT = ".sketchtree"
LISTED = 500  # files that the page is told of at most
_DEVICES = frozenset({"con", "prn", "aux", "nul", *(f"{kind}{number}" for kind in ("com", "lpt") for number in range(1, 10))})

Signature = tuple[int, int]  # of a file: when it was written (ns), bytes


@dataclass(frozen=True)
class Folder:
    """The chosen folder."""

    path: Path

    @property
    def name(self) -> str:
        """Its own name, without the way to it."""
        return self.path.resolve().name or "/"

    def files(self) -> list[str]:
        """Names of the drawings, projects and point clouds in it, the newest first."""
        from sketchtree.sketch.formats import READABLE  # every reader comes with it; the page is there before

        found = []
        try:
            with os.scandir(self.path) as entries:
                for entry in entries:
                    if is_name(entry.name) and Path(entry.name).suffix.lower() in (*READABLE, PROJECT, *PLAINLY) and entry.is_file(follow_symlinks=False):
                        found.append((entry.stat().st_mtime_ns, entry.name))
        except OSError:
            return []
        return [name for _, name in sorted(found, reverse=True)[:LISTED]]

    def read(self, name: str) -> bytes:
        """The bytes of a file of the folder. Raises SketchError."""
        path = self._inside(name)
        try:
            descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0))
            with open(descriptor, "rb") as file:
                found = os.fstat(descriptor)
                if not stat.S_ISREG(found.st_mode):
                    raise SketchError(f"{name} is no plain file.", remedy="Choose another one.")
                if found.st_size > MAX_UPLOAD:
                    raise SketchError(f"{name} has {found.st_size / 1e6:.0f} MB; {MAX_UPLOAD / 1e6:.0f} MB is the most.", remedy="Choose a smaller file.")
                return file.read(MAX_UPLOAD + 1)
        except OSError as error:
            raise SketchError(f"{name} can't be read: {(error.strerror or 'it fails').lower()}.", remedy="Choose another file.") from error

    def signature(self, name: str) -> Signature | None:
        """By which a file is told from what it was or will be; None: there is none of that name. Raises SketchError."""
        try:
            found = self._inside(name).stat()
        except OSError:
            return None
        return found.st_mtime_ns, found.st_size

    def write(self, name: str, data: bytes) -> Signature | None:
        """The file, whole or not at all. Raises SketchTreeError."""
        path = self._inside(name)
        try:
            write_whole(path, data)
        except ExportError as error:
            raise ExportError(error.message, remedy="Put that right and save again, or download the project.") from error
        return self.signature(name)

    def path_of(self, name: str) -> Path:
        """Where a file of that name is, or would be. Raises SketchError."""
        return self._inside(name)

    def _inside(self, name: str) -> Path:
        if not is_name(name):
            raise SketchError("That is no name of a file here.", remedy="Give a name without a path, a colon, or a dot at its start or end.")
        home = os.path.realpath(self.path)
        path = os.path.realpath(os.path.join(home, name))
        if os.path.dirname(path) != home:
            raise SketchError(f"{name} leads out of the folder {self.name}.", remedy="Choose a file of the folder itself.")
        return Path(path)


def is_name(name: str) -> bool:
    """Can a file be called so, here and on other systems, and is it not hidden?"""
    if not name or name[0] == "." or name[-1] in ". " or len(name.encode("utf-8", "surrogatepass")) > 240:
        return False
    if any(letter in '/\\:*?"<>|' or ord(letter) < 32 or ord(letter) == 127 or 0xD800 <= ord(letter) < 0xE000 for letter in name):
        return False
    return name.split(".")[0].strip().lower() not in _DEVICES


def project_name(name: str) -> str:
    """The name of the project file of a drawing that is called so. Raises ExportError."""
    stem = name[: -len(PROJECT)] if name.lower().endswith(PROJECT) else name
    if not is_name(stem + PROJECT) or not stem:
        raise ExportError("That is no name for a file.", remedy="Give one without a path, a colon, or a dot at its start.")
    return stem + PROJECT
