"""Which SHA-256 stands beside a column, and which over all of them?

Of a column's name, type, shape and values. Schema 1 hashed the head (name, type, shape) before the values; schema 2 hashes it
after them, so that a column can be hashed while it grows and nobody yet knows how long it will be.
"""

import hashlib
from collections.abc import Iterable

import numpy as np


class Digest:
    """The hash of one column, fed with its values piece by piece."""

    def __init__(self, name: str, dtype: np.dtype, *, schema: int, shape: tuple[int, ...] | None = None):
        self._name, self._dtype, self._schema = name, dtype, schema
        self._hash = hashlib.sha256(b"" if schema > 1 else self._head(shape))

    def update(self, values: np.ndarray) -> None:
        """The next values."""
        self._hash.update(np.ascontiguousarray(values).tobytes())

    def result(self, shape: tuple[int, ...]) -> str:
        """The hash in hexadecimal figures; `shape` is that of the whole column."""
        whole = self._hash.copy()
        if self._schema > 1:
            whole.update(self._head(shape))
        return whole.hexdigest()

    def _head(self, shape) -> bytes:
        return f"{self._name} {self._dtype.str} {tuple(shape)}".encode()


def digest_of(name: str, pieces: Iterable[np.ndarray], dtype: np.dtype, shape: tuple[int, ...], *, schema: int) -> str:
    """The hash of a column given in `pieces`."""
    digest = Digest(name, dtype, schema=schema, shape=shape)
    for piece in pieces:
        digest.update(piece)
    return digest.result(shape)


def root_digest(digests: dict[str, str]) -> str:
    """The hash over the hashes of all columns."""
    return hashlib.sha256("\n".join(f"{name} {digests[name]}" for name in sorted(digests)).encode()).hexdigest()
