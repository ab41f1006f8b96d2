"""What of an interrupted build need not be made again?

Every finished exemplar is kept as one small file in a folder beside the target, `.NAME.parts`, under a hash of its recipe's text, its name and
seed, and the program that grew it. A later build takes up what it finds there and removes the folder when the database is
written. A part is written under another name first; one that is torn all the same (its CRCs tell) is made anew.
"""

import hashlib
import io
import os
import secrets
import shutil
import zipfile
import zlib
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from sketchtree.errors import TemplateError
from sketchtree.templates.store.columns import COLUMNS, SCHEMA
from sketchtree.templates.making.fingerprint import fingerprint
from sketchtree.templates.making.order import Block, Order

_TORN = (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error, NotImplementedError)


class Journal:
    """The finished exemplars of a build that writes `target`."""

    def __init__(self, target: Path):
        self.folder = Path(target).with_name(f".{Path(target).name}.parts")

    def key(self, order: Order) -> str:
        """Name of the part of one exemplar."""
        said = (order.text, order.name, str(order.seed), str(SCHEMA), fingerprint())
        return hashlib.sha256("\0".join(said).encode("utf-8")).hexdigest()[:40]

    def has(self, order: Order) -> bool:
        """Whether there is a part, torn or not."""
        return self._path(order).exists()

    def take(self, order: Order) -> Block | None:
        """The part of an exemplar; None where it is torn or gone."""
        try:
            with open(self._path(order), "rb") as part, np.load(part, allow_pickle=False) as file:
                block = {name: file[name] for name in COLUMNS}
        except _TORN:
            return None
        return block if block["exemplar/name"].tolist() == [order.name.encode()] else None

    def keep(self, order: Order, block: Block) -> None:
        """Keeps a finished exemplar."""
        packed = io.BytesIO()
        np.savez(packed, **block)
        path = self._path(order)
        temporary = path.with_name(f"{path.stem}-{secrets.token_hex(4)}.tmp")
        try:
            self.folder.mkdir(exist_ok=True)
            temporary.write_bytes(packed.getbuffer())
            os.replace(temporary, path)
        except OSError as error:
            raise TemplateError(
                f"{self.folder}: finished exemplars can't be kept there ({error.strerror or error}).",
                remedy="Write the database to a folder that is writable and has room.",
            ) from error

    def count(self, wanted: Iterable[Order]) -> int:
        """How many of the exemplars there are."""
        return sum(map(self.has, wanted)) if self.folder.is_dir() else 0

    def drop(self) -> None:
        """Removes the folder."""
        shutil.rmtree(self.folder, ignore_errors=True)

    def _path(self, order: Order) -> Path:
        return self.folder / f"{self.key(order)}.npz"
