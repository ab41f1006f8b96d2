"""How do arrays come to the page? Behind their head, in one binary frame (`studio.messages`)."""

import struct

import msgspec
import numpy as np

from sketchtree.studio import messages

_KINDS = {"f4": np.float32, "u4": np.uint32, "u2": np.uint16, "u1": np.uint8, "i2": np.int16, "i1": np.int8}
_ALIGN = 8


class Arrays:
    """Arrays that go into one frame, by name."""

    def __init__(self) -> None:
        self.heads: list[messages.Array] = []
        self._parts: list[bytes] = []
        self._end = 0

    def put(self, name: str, dtype: str, values) -> None:
        """One more, as `dtype` says."""
        column = np.ascontiguousarray(values, _KINDS[dtype])
        self.heads.append(messages.Array(name=name, dtype=dtype, shape=list(column.shape), offset=self._end))
        data = column.tobytes()
        padding = -len(data) % _ALIGN
        self._parts += [data, b"\0" * padding]
        self._end += len(data) + padding

    def frame(self, head: messages.Tree | messages.Ghost) -> bytes:
        """The bytes of the frame; the head's `arrays` are these."""
        return headed(msgspec.structs.replace(head, arrays=self.heads), *self._parts)


def headed(head: messages.Tree | messages.Ghost, *body: bytes) -> bytes:
    """The bytes of a frame whose arrays are there."""
    text = msgspec.json.encode(head, enc_hook=_plain)
    padding = b"\0" * (-(4 + len(text)) % _ALIGN)
    return b"".join([struct.pack("<I", len(text)), text, padding, *body])


def beheaded(frame: bytes) -> tuple[messages.Tree | messages.Ghost, memoryview]:
    """(head, the bytes of its arrays) of a frame."""
    (length,) = struct.unpack_from("<I", frame)
    head = msgspec.json.decode(frame[4 : 4 + length], type=messages.Tree | messages.Ghost)
    return head, memoryview(frame)[4 + length + -(4 + length) % _ALIGN :]


def _plain(value: object) -> object:
    """A number of numpy's as one of Python's."""
    if isinstance(value, np.generic):
        return value.item()
    raise NotImplementedError(type(value))


def opened(frame: bytes) -> tuple[messages.Tree | messages.Ghost, dict[str, np.ndarray]]:
    """(head, arrays by name) of a frame."""
    head, body = beheaded(frame)
    found = {}
    for one in head.arrays:
        count = int(np.prod(one.shape))
        found[one.name] = np.frombuffer(body, _KINDS[one.dtype], count, one.offset).reshape(one.shape)
    return head, found
