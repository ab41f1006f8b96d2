"""What is kept of a whole tree, so that it can be shown again? The frame that the pages got, and what the crew and the pages know of it beside."""

import dataclasses
import struct
from collections.abc import Iterator
from dataclasses import dataclass

import msgspec
import numpy as np

from sketchtree.editing.kept import reading, settled_as_json, settled_from_json
from sketchtree.studio import messages
from sketchtree.studio.making.basis import Basis
from sketchtree.studio.making.frames import beheaded, headed


class _Record(msgspec.Struct, forbid_unknown_fields=True):
    digests: dict[str, str]
    settled: dict
    read: messages.Read | None
    matches: messages.Matches | None
    scale: float
    translate: tuple[float, float, float]
    owners: tuple[str, ...]
    height: float
    low: tuple[float, float, float]
    high: tuple[float, float, float]
    segments: int
    leaves: int
    triangles: tuple[int, int]


_ENCODER = msgspec.json.Encoder(enc_hook=lambda value: value.item() if isinstance(value, np.generic) else value.tolist())
_DECODER = msgspec.json.Decoder(_Record)


@dataclass(frozen=True, eq=False)
class KeptTree:
    """One whole tree."""

    digests: dict[str, str]  # of its chunks, by owner
    basis: Basis
    read: messages.Read | None
    matches: messages.Matches | None
    frame: bytes

    def remarks(self, revision: int) -> Iterator[messages.Event]:
        """How the drawing was read, and what it is like, as of that revision."""
        for event in (self.read, self.matches):
            if event is not None:
                yield msgspec.structs.replace(event, revision=revision)

    def framed(self, revision: int) -> bytes:
        """Its frame, as of that revision."""
        head, body = beheaded(self.frame)
        return headed(msgspec.structs.replace(head, revision=revision), body)

    def encoded(self) -> bytes:
        """As bytes; `decoded` takes them."""
        plain = {name: getattr(self.basis, name) for name in _Record.__struct_fields__ if name in _BASIS}
        record = _Record(digests=self.digests, settled=settled_as_json(self.basis.settled), read=self.read, matches=self.matches, **plain)
        text = _ENCODER.encode(record)
        return b"".join([struct.pack("<I", len(text)), text, self.frame])

    @classmethod
    def decoded(cls, data: bytes) -> "KeptTree | None":
        """None of bytes that are not that."""
        try:
            (length,) = struct.unpack_from("<I", data)
            record = _DECODER.decode(data[4 : 4 + length])
            settled = reading(settled_from_json, record.settled)
        except (msgspec.MsgspecError, struct.error, ValueError):
            return None
        basis = Basis(settled=settled, **{name: getattr(record, name) for name in _BASIS})
        return cls(record.digests, basis, record.read, record.matches, data[4 + length :])


_BASIS = tuple(field.name for field in dataclasses.fields(Basis) if field.name != "settled")


def is_whole(frame: bytes) -> bool:
    """Is every chunk of the tree in it?"""
    head, _ = beheaded(frame)
    return {chunk.owner for chunk in head.chunks} == set(head.owners)
