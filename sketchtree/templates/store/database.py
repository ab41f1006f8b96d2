"""Where are the exemplars kept? One HDF5 file of columns.

The file (`writer` writes it, whole or not at all) holds no date, host
or path, and is the same byte for byte whenever the columns are. Every dataset carries a Fletcher-32
checksum a chunk, which HDF5 checks whenever it reads, and a SHA-256 of all its values; the root carries
a SHA-256 over those. A file that is damaged, cut off, foreign or of a newer schema is refused with a `TemplateError`
and left as it is; one of an older schema is read (`migrate`). Columns are read when they are asked for. Any number of readers may
have the file open while another program replaces it: each sees the old file or the new one, and one that saw the old is told so.
"""

import difflib
import os
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np

from sketchtree.errors import TemplateError
from sketchtree.templates.seen.branching import Branching
from sketchtree.templates.store.columns import SCHEMA, block_at, exemplar_at
from sketchtree.templates.store.digest import digest_of, root_digest
from sketchtree.templates.exemplar import Exemplar, Views
from sketchtree.templates.store.migrate import SOURCE, filled, stored
from sketchtree.templates.store.place import default_path
from sketchtree.templates.store.writer import FORMAT

KEPT = 8  # exemplars that stay in memory once read
SLAB = 2**24  # bytes read at a time while a checksum is compared
_REBUILD = "Rebuild it with `sketchtree templates build`, or name another file with --db."


class Database:
    """An open database: names at once, everything else on demand. Holds no open file."""

    def __init__(self, path: Path | str):
        self.path = Path(path)
        self._digest, self._root, self.schema = {}, None, 0
        self._read: dict[str, tuple[object, Exemplar]] = {}  # with what the file was then
        with _Guarded(self.path) as file:
            self._check_head(file)
            self.names = tuple(name.decode("utf-8") for name in self._whole(file, "exemplar/name"))

    @classmethod
    def open(cls, path: Path | str | None = None) -> "Database":
        """The database at `path`; by default $SKETCHTREE_DB, else the packaged file, else the checkout's."""
        return cls(default_path() if path is None else path)

    def __len__(self) -> int:
        return len(self.names)

    def index(self, name: str) -> int:
        """Place of the exemplar called `name`."""
        if name in self.names:
            return self.names.index(name)
        near = difflib.get_close_matches(name, self.names, n=3, cutoff=0.4)
        raise TemplateError(
            f"There is no exemplar called {name!r} in {self.path.name}.",
            remedy=f"Did you mean {' or '.join(near)}?" if near else f"Use one of: {', '.join(self.names)}.",
        )

    def exemplar(self, name: str) -> Exemplar:
        """One exemplar, read when it is first asked for; the last few are kept."""
        index, file_now = self.index(name), _signature(self.path)
        if self._read.get(name, (None,))[0] != file_now:
            with self._file() as file:
                found = exemplar_at(lambda column, first, last: self._part(file, column, first, last), index)
            self._read = dict([*self._read.items()][1 - KEPT :]) | {name: (file_now, found)}
        return self._read[name][1]

    def blocks(self) -> Iterator[dict[str, np.ndarray]]:
        """The columns of one exemplar after another, for writing them again."""
        with self._file() as file:
            for index in range(len(self)):
                yield block_at(lambda column, first, last: self._part(file, column, first, last), index)

    def width(self, name: str) -> int:
        """How many bytes the longest text of a column has, at most."""
        if name not in self._digest:
            return max(1, self.column(name).dtype.itemsize)
        with self._file() as file:
            return file[name].dtype.itemsize

    def column(self, name: str) -> np.ndarray:
        """One whole column, its checksum compared."""
        with self._file() as file:
            return self._whole(file, name)

    @cached_property
    def titles(self) -> tuple[str, ...]:
        """Names for people, in the order of `names`."""
        return self._texts("exemplar/title")

    @cached_property
    def species(self) -> tuple[str, ...]:
        """Botanical names, in the order of `names`; "" where unknown."""
        return self._texts("exemplar/species")

    @cached_property
    def growth_habits(self) -> tuple[str, ...]:
        """Growth habits, in the order of `names`; "" where unknown."""
        return self._texts("exemplar/growth_habit")

    @cached_property
    def azimuths(self) -> np.ndarray:
        """Azimuth of every view, degrees."""
        return self.column("views/azimuth")

    @cached_property
    def views(self) -> Views:
        """What matching compares: arrays over exemplar and view, as they are stored. Read slab by slab: they may be a gigabyte."""

        def read(dataset) -> np.ndarray:
            whole = np.empty(dataset.shape, dataset.dtype)

            def slabs():
                row = 0
                for slab in _slabs(dataset):
                    whole[row : row + len(slab)] = slab
                    row += len(slab)
                    yield slab

            self._check(dataset.name.lstrip("/"), dataset, slabs())
            return whole

        with self._file() as file:
            part = {k: read(file[f"views/{k}"]) for k in _VIEWS}
        moments = Branching(part["branching_mean"], part["branching_sd"], part["branching_count"])
        return Views(part["footprint"], moments, part["posture"])

    def verify(self) -> None:
        """Compares every checksum, a slab at a time."""
        with self._file() as file:
            for name in self._digest:
                self._check(name, file[name], _slabs(file[name]))

    def _texts(self, name: str) -> tuple[str, ...]:
        return tuple(text.decode("utf-8") for text in self.column(name))

    def _file(self):
        return _Guarded(self.path, self._root)

    def _check_head(self, file) -> None:
        if file.attrs.get("format") != FORMAT:
            raise TemplateError(f"{self.path}: it is an HDF5 file, but no SketchTree database.", remedy=_REBUILD)
        self.schema = int(file.attrs["schema"])
        if self.schema > SCHEMA:
            raise TemplateError(
                f"{self.path}: it has schema {self.schema}, and this version of SketchTree reads up to {SCHEMA}.",
                remedy="Update SketchTree, or name another file with --db.",
            )
        self._digest = {name: str(file[name].attrs["sha256"]) for name in stored(self.schema)}
        self._root = str(file.attrs["sha256"])
        if self._root != root_digest(self._digest):
            raise _damaged(self.path, "its checksums don't agree")

    def _whole(self, file, name: str) -> np.ndarray:
        if name not in self._digest:
            return filled(name, self._whole(file, SOURCE))
        values = file[name][()]
        self._check(name, file[name], (values,))
        return values

    def _part(self, file, name: str, first: int, last: int | None) -> np.ndarray:
        return filled(name, file[SOURCE][first:last]) if name not in self._digest else file[name][first:last]

    def _check(self, name: str, dataset, pieces) -> None:
        if digest_of(name, pieces, dataset.dtype, dataset.shape, schema=self.schema) != self._digest[name]:
            raise _damaged(self.path, f"the checksum of `{name}` is wrong")


def _signature(path: Path) -> object:
    """Other than before once the file has been replaced; None where there is none."""
    try:
        state = path.stat()
    except OSError:
        return None
    return state.st_mtime_ns, state.st_size, state.st_ino


def _slabs(dataset):
    """A column, whole chunks at a time."""
    row = max(1, dataset.dtype.itemsize * int(np.prod(dataset.shape[1:])))
    step = max(1, SLAB // row)
    return (dataset[first : first + step] for first in range(0, len(dataset), step))


_VIEWS = ("footprint", "branching_mean", "branching_sd", "branching_count", "posture")


def _damaged(path: Path, how: str) -> TemplateError:
    return TemplateError(f"{path}: the database is damaged ({how}).", remedy=_REBUILD)


class _Guarded:
    """An HDF5 file open for reading, whose own errors come out as `TemplateError`."""

    def __init__(self, path: Path, root: str | None = None):
        self.path, self._root = path, root

    def __enter__(self):
        if not self.path.is_file():
            raise TemplateError(f"{self.path}: there is no such database.", remedy=_REBUILD)
        if not os.access(self.path, os.R_OK):
            raise TemplateError(f"{self.path}: it can't be read.", remedy="Give yourself the right to read it.")
        try:
            self._file = h5py.File(self.path, "r")
        except OSError as error:
            raise self._unreadable() from error
        if self._root is not None and self._seal() != self._root:
            self._file.close()
            raise TemplateError(f"{self.path}: it has been replaced since it was opened.", remedy="Open it again.")
        return self._file

    def _seal(self) -> str | None:
        try:
            return self._file.attrs.get("sha256")
        except (OSError, RuntimeError):
            return None

    def __exit__(self, kind, error, trace):
        self._file.close()
        if isinstance(error, (OSError, KeyError, RuntimeError, ValueError, UnicodeDecodeError, TypeError)):
            raise _damaged(self.path, "a part of it can't be read") from error
        return False

    def _unreadable(self) -> TemplateError:
        with open(self.path, "rb") as file:
            head = file.read(8)
        if head == b"\x89HDF\r\n\x1a\n":
            return _damaged(self.path, "it is cut off or its index is broken")
        what = "it is empty" if not head else "it is no HDF5 file"
        return TemplateError(f"{self.path}: {what}, so no database.", remedy=_REBUILD)
