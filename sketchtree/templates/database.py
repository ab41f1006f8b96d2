"""Where are the exemplars kept? One HDF5 file of columns.

The file is written in one go (a temporary file beside it, flushed to disk, then renamed), holds no date, host
or path, and is the same byte for byte whenever the columns are. Every dataset carries a Fletcher-32
checksum a chunk, which HDF5 checks whenever it reads, and a SHA-256 of all its values; the root carries
a SHA-256 over those. A file that is damaged, cut off, foreign or of a newer schema is refused with a `TemplateError`
and left as it is. Columns are read when they are asked for.
"""

import difflib
import hashlib
import os
import tempfile
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np

from sketchtree.errors import TemplateError
from sketchtree.templates.branching import Branching
from sketchtree.templates.columns import COLUMNS, SCHEMA, exemplar_at
from sketchtree.templates.exemplar import Exemplar, Views

FORMAT = "SketchTree exemplars"
ENVIRONMENT = "SKETCHTREE_DB"
_REBUILD = "Rebuild it with `sketchtree templates build`, or name another file with --db."


class Database:
    """An open database: names at once, everything else on demand. Holds no open file."""

    def __init__(self, path: Path | str):
        self.path = Path(path)
        self._digest = {}
        with self._file() as file:
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
        """One exemplar, read now."""
        index = self.index(name)
        with self._file() as file:
            return exemplar_at(lambda column, first, last: self._part(file, column, first, last), index)

    def column(self, name: str) -> np.ndarray:
        """One whole column, its checksum compared."""
        with self._file() as file:
            return self._whole(file, name)

    @cached_property
    def titles(self) -> tuple[str, ...]:
        """Names for people, in the order of `names`."""
        return tuple(title.decode("utf-8") for title in self.column("exemplar/title"))

    @cached_property
    def azimuths(self) -> np.ndarray:
        """Azimuth of every view, degrees."""
        return self.column("views/azimuth")

    @cached_property
    def views(self) -> Views:
        """What matching compares: arrays over exemplar and view."""
        part = {k: self.column(f"views/{k}").astype(float) for k in _VIEWS}
        moments = Branching(part["branching_mean"], part["branching_sd"], part["branching_count"])
        return Views(part["footprint"], moments, part["posture"])

    def verify(self) -> None:
        """Reads every column and compares every checksum."""
        for name in COLUMNS:
            self.column(name)

    def _file(self):
        return _Guarded(self.path)

    def _check_head(self, file) -> None:
        if file.attrs.get("format") != FORMAT:
            raise TemplateError(f"{self.path}: it is an HDF5 file, but no SketchTree database.", remedy=_REBUILD)
        schema = int(file.attrs["schema"])
        if schema > SCHEMA:
            raise TemplateError(
                f"{self.path}: it has schema {schema}, and this version of SketchTree reads up to {SCHEMA}.",
                remedy="Update SketchTree, or name another file with --db.",
            )
        self._digest = {name: str(file[name].attrs["sha256"]) for name in COLUMNS}
        if file.attrs["sha256"] != _root_digest(self._digest):
            raise _damaged(self.path, "its checksums don't agree")

    def _whole(self, file, name: str) -> np.ndarray:
        values = file[name][()]
        if _sha256(name, values) != self._digest[name]:
            raise _damaged(self.path, f"the checksum of `{name}` is wrong")
        return values

    def _part(self, file, name: str, first: int, last: int) -> np.ndarray:
        return file[name][first:last]


_VIEWS = ("footprint", "branching_mean", "branching_sd", "branching_count", "posture")


def default_path() -> Path:
    """$SKETCHTREE_DB, else the file in the package, else `template_db/exemplars.h5` of a checkout."""
    if os.environ.get(ENVIRONMENT):
        return Path(os.environ[ENVIRONMENT])
    here = Path(__file__).resolve()
    packaged = here.parent / "data" / "exemplars.h5"
    return packaged if packaged.exists() else here.parents[2] / "template_db" / "exemplars.h5"


def write_database(path: Path | str, columns: dict[str, np.ndarray]) -> None:
    """Writes the file in one go; whatever stood at `path` is replaced only when all is on disk."""
    path = Path(path)
    temporary = None
    try:
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".part")
        os.close(handle)
        _write(temporary, columns)
        with open(temporary, "rb+") as file:
            os.fsync(file.fileno())
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException as error:
        if temporary is not None:
            Path(temporary).unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise TemplateError(
                f"{path}: it can't be written ({error.strerror or error}).",
                remedy="Choose a folder that exists, is writable and has room.",
            ) from error
        raise


def _write(path: str, columns: dict[str, np.ndarray]) -> None:
    digest = {name: _sha256(name, columns[name]) for name in COLUMNS}
    with h5py.File(path, "w", libver=("v110", "v110")) as file:
        file.attrs["format"] = FORMAT
        file.attrs["schema"] = SCHEMA
        file.attrs["sha256"] = _root_digest(digest)
        for name, (_, unit, meaning) in COLUMNS.items():
            column = columns[name]
            dataset = file.create_dataset(
                name, data=column, chunks=_chunks(column), compression="gzip", compression_opts=6,
                shuffle=column.dtype.kind != "S", fletcher32=True, track_times=False,
            )  # fmt: skip
            dataset.attrs["unit"] = unit
            dataset.attrs["meaning"] = meaning
            dataset.attrs["sha256"] = digest[name]


def _chunks(column: np.ndarray) -> tuple[int, ...]:
    """Whole rows, at most about 256 kB a chunk, so that one exemplar is read without the rest."""
    row = max(1, column[:1].nbytes)
    return (int(np.clip(2**18 // row, 1, max(1, len(column)))), *column.shape[1:])


def _sha256(name: str, values: np.ndarray) -> str:
    head = f"{name} {values.dtype.str} {values.shape}".encode()
    return hashlib.sha256(head + np.ascontiguousarray(values).tobytes()).hexdigest()


def _root_digest(digest: dict[str, str]) -> str:
    return hashlib.sha256("\n".join(f"{name} {digest[name]}" for name in sorted(digest)).encode()).hexdigest()


def _damaged(path: Path, how: str) -> TemplateError:
    return TemplateError(f"{path}: the database is damaged ({how}).", remedy=_REBUILD)


class _Guarded:
    """An HDF5 file open for reading, whose own errors come out as `TemplateError`."""

    def __init__(self, path: Path):
        self.path = path

    def __enter__(self):
        if not self.path.is_file():
            raise TemplateError(f"{self.path}: there is no such database.", remedy=_REBUILD)
        if not os.access(self.path, os.R_OK):
            raise TemplateError(f"{self.path}: it can't be read.", remedy="Give yourself the right to read it.")
        try:
            self._file = h5py.File(self.path, "r")
        except OSError as error:
            raise self._unreadable() from error
        return self._file

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
