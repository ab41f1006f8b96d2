"""What need not be made again at the next start? Pictures and the first tree, in the user's cache folder (`SKETCHTREE_CACHE` names another).

Each is known by what it is and by all that it was made with: the program's sources, the packages that count, the database of templates. One that is torn or foreign is as
none. The folder has a bound; what was not used for longest goes first. Nothing here can fail: where it can't be kept it is made again.
"""

import hashlib
import importlib.util
import os
import platform
import sys
from collections.abc import Iterator
from contextlib import suppress
from functools import cached_property
from pathlib import Path

from platformdirs import user_cache_dir

from sketchtree.errors import SketchTreeError
from sketchtree.export.files import write_whole
from sketchtree.templates.store.place import default_path
from sketchtree.version import __version__

MOST = 200_000_000  # bytes of all that is kept
LARGEST = 64_000_000  # bytes of one
_PACKAGES = ("jax", "jaxlib", "numpy", "scipy", "PIL", "shapely")  # that bear on what is made
_CHECK = 16  # bytes before each, by which it is known to be whole


class Stock:
    """The folder. `made_with`: all that what is kept hangs on beside its name."""

    def __init__(self, folder: Path, made_with: str):
        self._folder, self._made_with = folder, made_with

    @classmethod
    def of_user(cls, database: Path | None = None) -> "Stock":
        """The user's own, of what is made by this program with that database."""
        folder = Path(os.environ.get("SKETCHTREE_CACHE") or user_cache_dir("sketchtree", appauthor=False)) / "studio"
        return cls(folder, _made_with(default_path() if database is None else database))

    def get(self, what: str) -> bytes | None:
        """The bytes that are kept of it; None: there are none, or they are not whole."""
        path = self._path(what)
        try:
            data = path.read_bytes()
            os.utime(path)  # used now
        except OSError:
            return None
        return data[_CHECK:] if data[:_CHECK] == _check(path.name, data[_CHECK:]) else None

    def drop(self, what: str) -> None:
        """Keep nothing of it."""
        with suppress(OSError):
            self._path(what).unlink(missing_ok=True)

    def put(self, what: str, data: bytes) -> None:
        """Keep these bytes, if they can be kept."""
        path = self._path(what)
        if len(data) > LARGEST:
            return
        with suppress(OSError, SketchTreeError):
            self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            write_whole(path, _check(path.name, data) + data)
            self._clear()

    def _clear(self) -> None:
        """What was not used for longest goes, until the rest is within the bound."""
        with os.scandir(self._folder) as entries:
            found = sorted(((entry.stat().st_mtime_ns, entry.stat().st_size, entry.path) for entry in entries if entry.is_file(follow_symlinks=False)), reverse=True)
        total = 0
        for _, size, path in found:
            total += size
            if total > MOST:
                os.unlink(path)

    def _path(self, what: str) -> Path:
        return self._folder / hashlib.blake2b(f"{what}\0{self._known_by}".encode(), digest_size=20).hexdigest()

    @cached_property
    def _known_by(self) -> str:
        return hashlib.blake2b(self._made_with.encode(), digest_size=20).hexdigest()


def _check(name: str, data: bytes) -> bytes:
    told = hashlib.blake2b(name.encode(), digest_size=_CHECK)
    told.update(data)
    return told.digest()


def _made_with(database: Path) -> str:
    """When every source of the program and every package that counts was written, and how large it is; of the database too."""
    home = Path(__file__).parents[1]
    found = [f"{os.path.relpath(path, home)} {_written(path)}" for path in sorted(_sources(home))]
    packages = [_written(getattr(importlib.util.find_spec(name), "origin", None)) for name in _PACKAGES]
    return "\n".join([__version__, sys.version, platform.machine(), *packages, f"{os.path.abspath(database)} {_written(database)}", *found])


def _sources(home: Path) -> Iterator[str]:
    """All files but the page's: what the browser runs bears on nothing that is made here."""
    for folder, inner, names in os.walk(home):
        inner[:] = [name for name in inner if name not in ("page", "__pycache__")]
        yield from (os.path.join(folder, name) for name in names)


def _written(path: str | os.PathLike | None) -> str:
    try:
        found = os.stat(path)
    except (OSError, TypeError):
        return "none"
    return f"{found.st_mtime_ns} {found.st_size}"
