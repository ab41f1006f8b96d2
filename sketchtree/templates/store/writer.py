"""How is the database written without ever holding it? Exemplar by exemplar, chunk by chunk.

A *block* is the columns of one exemplar (`columns.to_columns` of one). The writer keeps a chunk of every column
in memory, writes it when it is full and hashes as it goes, so memory doesn't grow with the number of exemplars. All goes to
a temporary file beside the target, which is flushed to disk and renamed over it at the very end: whatever stops the
program, the target is what it was or what it shall be. The bytes depend on the blocks and their order alone.
"""

import os
import tempfile
from pathlib import Path

import h5py
import numpy as np

from sketchtree.errors import TemplateError
from sketchtree.templates.store.columns import COLUMNS, ONCE, ROWS, SCHEMA, START, split
from sketchtree.templates.store.digest import Digest, root_digest

FORMAT = "SketchTree exemplars"
CHUNK = 2**18  # bytes a chunk, about: whole rows, so that one exemplar is read without the rest


class Writer:
    """A database in the making, used in a `with`; it is in its place when the block ends without an error.

    `count` exemplars will be added; `widths` is the longest text of every text column, bytes.
    """

    def __init__(self, path: Path | str, count: int, widths: dict[str, int]):
        self.path, self._count, self._widths = Path(path), count, widths
        self._file, self._columns, self._names, self._row, self._temporary = None, {}, set(), 0, None

    def __enter__(self) -> "Writer":
        if self.path.is_dir():
            raise _unwritable(self.path, "Is a directory")
        try:
            handle, name = tempfile.mkstemp(dir=self.path.parent, prefix=f".{self.path.name}.", suffix=".part")
            os.close(handle)
            self._temporary = Path(name)
            self._file = h5py.File(name, "w", libver=("v110", "v110"), rdcc_nbytes=0)  # whole chunks only: nothing to cache
        except OSError as error:
            raise _unwritable(self.path, error) from error
        return self

    def add(self, block: dict[str, np.ndarray]) -> None:
        """The next exemplar."""
        name = bytes(block["exemplar/name"][0])
        if name in self._names:
            raise TemplateError(f"{self.path}: two exemplars are called {name.decode()!r}.", remedy="Give each a name of its own.")
        if not self._columns:
            self._begin(block)
        self._names.add(name)
        self._row += len(block["skeleton/parent"])
        for column, store in self._columns.items():
            if column == START:
                store.add(np.array([self._row], store.dtype))
            elif column not in ONCE:
                store.add(block[column])

    def __exit__(self, kind, error, trace):
        try:
            if kind is None:
                self._finish()
                os.chmod(self._temporary, 0o644)
                os.replace(self._temporary, self.path)
        except OSError as failure:
            raise _unwritable(self.path, failure) from failure
        finally:
            if self._file:
                self._file.close()
            self._temporary.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise _unwritable(self.path, error) from error
        return False

    def _begin(self, block) -> None:
        for name in COLUMNS:
            first = block[name]
            dtype = np.dtype(f"S{self._widths[name]}") if first.dtype.kind == "S" else first.dtype
            length = None if name in ROWS else len(first) if name in ONCE else self._count + (name == START)
            self._columns[name] = _Column(self._file, name, dtype, first.shape[1:], length)
        self._columns[START].add(np.zeros(1, block[START].dtype))
        for name in ONCE:
            self._columns[name].add(block[name])

    def _finish(self) -> None:
        if len(self._names) != self._count:
            raise ValueError(f"{len(self._names)} exemplars were added of {self._count}")
        digests = {name: column.finish() for name, column in self._columns.items()}
        for name, (_, unit, meaning) in COLUMNS.items():
            attributes = self._file[name].attrs
            attributes["unit"], attributes["meaning"], attributes["sha256"] = unit, meaning, digests[name]
        root = self._file.attrs
        root["format"], root["schema"], root["sha256"] = FORMAT, SCHEMA, root_digest(digests)
        self._file.close()
        with open(self._temporary, "rb+") as file:
            os.fsync(file.fileno())


class _Column:
    """One column: the chunk that is being filled, and the dataset it goes to."""

    def __init__(self, file: h5py.File, name: str, dtype: np.dtype, tail: tuple[int, ...], length: int | None):
        row = max(1, dtype.itemsize * int(np.prod(tail)))
        rows = int(np.clip(CHUNK // row, 1, max(1, length) if length is not None else CHUNK))
        self.dtype, self._buffer, self._filled, self._written = dtype, np.zeros((rows, *tail), dtype), 0, 0
        self._digest = Digest(name, dtype, schema=SCHEMA)
        self._dataset = file.create_dataset(
            name, (length or 0, *tail), dtype, maxshape=(length, *tail), chunks=self._buffer.shape, compression="gzip",
            compression_opts=6, shuffle=dtype.kind != "S", fletcher32=True, track_times=False,
        )  # fmt: skip

    def add(self, values: np.ndarray) -> None:
        if values.dtype.itemsize > self.dtype.itemsize:
            raise ValueError(f"a value of {self._dataset.name} is longer than was said")
        values = values.astype(self.dtype, copy=False)
        self._digest.update(values)
        while len(values):
            taken = min(len(values), len(self._buffer) - self._filled)
            self._buffer[self._filled : self._filled + taken] = values[:taken]
            self._filled, values = self._filled + taken, values[taken:]
            if self._filled == len(self._buffer):
                self._flush()

    def finish(self) -> str:
        """Writes what is left; the column's hash."""
        self._flush()
        return self._digest.result(self._dataset.shape)

    def _flush(self) -> None:
        if self._filled == 0:
            return
        end = self._written + self._filled
        if self._dataset.maxshape[0] is None:
            self._dataset.resize(end, axis=0)
        self._dataset[self._written : end] = self._buffer[: self._filled]
        self._written, self._filled = end, 0


def write_database(path: Path | str, columns: dict[str, np.ndarray]) -> None:
    """Writes a database whose columns are all there; whatever stood at `path` is replaced only when all is on disk."""
    columns = {name: columns[name] for name in COLUMNS}
    widths = {name: values.dtype.itemsize for name, values in columns.items() if values.dtype.kind == "S"}
    with Writer(path, len(columns["exemplar/name"]), widths) as writer:
        for block in split(columns):
            writer.add(block)


def _unwritable(path: Path, why) -> TemplateError:
    why = getattr(why, "strerror", None) or why
    return TemplateError(f"{path}: it can't be written ({why}).", remedy="Choose a folder that exists, is writable and has room.")
