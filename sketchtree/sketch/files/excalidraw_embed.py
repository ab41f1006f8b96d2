"""Does this picture carry the Excalidraw drawing it was exported from? The scene in a PNG's text chunk, or in an SVG's comments.

    PNG   tEXt "application/vnd.excalidraw+json" = packed
    SVG   <!-- payload-type:application/vnd.excalidraw+json --> <!-- payload-start --> base64(packed) <!-- payload-end -->

`packed` is a scene, or {"encoded": byte string, "compressed": bool} around one: characters stand for bytes, zlib inside.
"""

import base64
import binascii
import json
import struct
import zlib
from typing import Any

from sketchtree.sketch.files.limits import MAX_MB

TYPE = b"application/vnd.excalidraw+json"
_START, _END = b"<!-- payload-start -->", b"<!-- payload-end -->"
_PNG = b"\x89PNG\r\n\x1a\n"


def embedded_scene(data: bytes, *, max_mb: float = MAX_MB) -> Any | None:
    """The Excalidraw document that a PNG or SVG file carries; None where there is none that can be read."""
    packed = _png_text(data) if data.startswith(_PNG) else _svg_payload(data) if TYPE in data else None
    if packed is None:
        return None
    try:
        return _unpacked(packed, int(max_mb * 1e6))
    except (ValueError, RecursionError, TypeError, zlib.error):
        return None


def _png_text(data: bytes) -> bytes | None:
    at = len(_PNG)
    while at + 8 <= len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8 : at + 8 + size] if kind == b"tEXt" else b""
        if body.startswith(TYPE + b"\0"):
            return body[len(TYPE) + 1 :]
        if kind == b"IEND":
            return None
        at += 12 + size
    return None


def _svg_payload(data: bytes) -> bytes | None:
    start = data.find(_START)
    end = data.find(_END, start)
    if start < 0 or end < 0:
        return None
    try:
        return base64.b64decode(b"".join(data[start + len(_START) : end].split()), validate=True)
    except (binascii.Error, ValueError):
        return None


def _unpacked(packed: bytes, most: int) -> Any | None:
    """The document inside; `most` bytes at most. Text is Latin-1 where characters stand for bytes, else UTF-8."""
    try:
        outer = json.loads(packed.decode("utf-8"))
    except UnicodeDecodeError:
        outer = json.loads(packed.decode("latin-1"))
    if not isinstance(outer, dict) or "encoded" not in outer:
        return outer
    inner = outer["encoded"].encode("latin-1") if isinstance(outer["encoded"], str) else b""
    if outer.get("compressed"):
        inflater = zlib.decompressobj()
        inner = inflater.decompress(inner, most)
        if inflater.unconsumed_tail:
            return None
    return json.loads(inner)
