"""How does a film become an animated PNG without holding all its pictures in memory?

Of a picture only the box in which it differs from the one before is written; one that doesn't differ makes that one stay longer. Pillow packs the
pixels; the file round them is put together here, a picture at a time.
"""

import io
import struct
import zlib
from collections.abc import Iterator, Sequence

from PIL import Image, ImageChops

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_MOST = 65535  # the most that a delay counts


def apng_bytes(pictures: Sequence[Image.Image], milliseconds: Sequence[int]) -> bytes:
    """An APNG of all pictures, each shown so long, that runs again and again."""
    drawn: list[tuple[bytes, tuple[int, int, int, int], int]] = []
    shown = None
    for k, time in enumerate(milliseconds):
        wanted = pictures[k].convert("RGB")
        box = (0, 0, *wanted.size) if shown is None else ImageChops.difference(wanted, shown).getbbox()
        if box is None:
            drawn[-1] = (*drawn[-1][:2], drawn[-1][2] + time)
            continue
        drawn.append((_pixels(wanted.crop(box)), box, time))
        shown = wanted
    width, height = shown.size
    out = [_SIGNATURE, _chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)), _chunk(b"acTL", struct.pack(">II", len(drawn), 0))]
    number = 0
    for packed, (left, top, right, bottom), time in drawn:
        tenths = -(-time // _MOST)  # 1 up to 65 s, a few above
        place = struct.pack(">IIIIIHHBB", number, right - left, bottom - top, left, top, round(time / tenths), round(1000 / tenths), 0, 0)
        out.append(_chunk(b"fcTL", place))
        out.append(_chunk(b"IDAT", packed) if number == 0 else _chunk(b"fdAT", struct.pack(">I", number + 1) + packed))
        number += 1 if number == 0 else 2
    return b"".join([*out, _chunk(b"IEND", b"")])


def _pixels(picture: Image.Image) -> bytes:
    """The packed pixels of a picture, as a PNG of it alone has them."""
    whole = io.BytesIO()
    picture.save(whole, "PNG")
    return b"".join(data for kind, data in _chunks(whole.getvalue()) if kind == b"IDAT")


def _chunks(png: bytes) -> Iterator[tuple[bytes, bytes]]:
    at = len(_SIGNATURE)
    while at < len(png):
        (length,) = struct.unpack_from(">I", png, at)
        yield png[at + 4 : at + 8], png[at + 8 : at + 8 + length]
        at += 12 + length


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
