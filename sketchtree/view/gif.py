"""How does a film become a small GIF that doesn't flicker?

All pictures share one palette, and none is dithered by chance: a colour becomes the same index in every picture. Of a picture only what differs from
the one before is written. A pixel keeps the colour that is shown while its own is no farther than `_NEAR_SMOOTH` from it, or among leaves, where the
eye misses more, `_NEAR_BUSY`. Pillow packs the pixels; the file round them is put together here, a picture at a time.
"""

import io
import struct
from collections.abc import Sequence

import numpy as np
from jaxtyping import UInt8
from PIL import Image
from scipy.ndimage import maximum_filter, minimum_filter

_COLOURS = 191  # one more leaves a pixel as it is; with 255 leaves look no better, and files are a tenth larger
_LEAVE = 255
_NEAR_SMOOTH, _NEAR_BUSY = 2.0, 18.0  # steps of 255, of the channel that differs most
_BUSY = 24  # steps of 255 that neighbours differ by
_LOOKED_AT = 8  # pictures that the palette is made from
_BAYER = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]], float) / 16 - 15 / 32  # mean 0
_GRAIN = 6.0  # steps of 255: a fixed grain, the same in all pictures, that keeps skies from showing bands


def gif_bytes(pictures: Sequence[Image.Image], milliseconds: Sequence[int]) -> bytes:
    """A GIF of all pictures, each shown so long, that runs again and again."""
    palette = _palette(pictures)
    table = np.array(palette.getpalette(), np.uint8).reshape(-1, 3)
    width, height = pictures[0].size
    out = [b"GIF89a", struct.pack("<HHBBB", width, height, 0xF7, 0, 0), table.tobytes(), b"\x21\xff\x0bNETSCAPE2.0\x03\x01\x00\x00\x00"]
    drawn: list[tuple[bytes, int]] = []
    shown = None
    for k, time in enumerate(milliseconds):
        wanted = np.asarray(pictures[k].convert("RGB"))
        index = _indexed(wanted, palette)
        changed = np.ones(index.shape, bool) if shown is None else _changed(wanted, table[index], shown)
        if not changed.any():
            drawn[-1] = (drawn[-1][0], drawn[-1][1] + time)
            continue
        shown = table[index] if shown is None else np.where(changed[..., None], table[index], shown)
        rows, columns = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
        box = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
        drawn.append((_image(np.where(changed, index, _LEAVE)[box], (columns[0], rows[0]), palette), time))
    for image, time in drawn:
        out += [struct.pack("<BBBBHBB", 0x21, 0xF9, 4, 0x05, time // 10, _LEAVE, 0), image]
    return b"".join([*out, b"\x3b"])


def _changed(wanted, coloured, shown):
    """Which pixels are to be drawn again."""
    green = wanted[..., 1]
    busy = maximum_filter(green, 3).astype(np.int16) - minimum_filter(green, 3) > _BUSY
    off = np.abs(wanted.astype(np.int16) - shown).max(axis=2)
    return (off > np.where(busy, _NEAR_BUSY, _NEAR_SMOOTH) + _GRAIN / 2) & (coloured != shown).any(axis=2)


def _palette(pictures: Sequence[Image.Image]) -> Image.Image:
    """One for all, from some of them."""
    places = np.unique(np.round(np.linspace(0, len(pictures) - 1, min(_LOOKED_AT, len(pictures)))).astype(int))
    few = [pictures[int(k)].convert("RGB") for k in places]
    strip = Image.new("RGB", (few[0].width, few[0].height * len(few)))
    for k, picture in enumerate(few):
        strip.paste(picture, (0, k * picture.height))
    found = strip.quantize(_COLOURS, method=Image.Quantize.MEDIANCUT, kmeans=1)
    colours = (found.getpalette() or [])[: 3 * _COLOURS]
    whole = Image.new("P", (1, 1))
    whole.putpalette(colours + [0] * (768 - len(colours)))
    return whole


def _indexed(rgb: UInt8[np.ndarray, "row column 3"], palette: Image.Image) -> UInt8[np.ndarray, "row column"]:
    """The nearest colours, under a grain that stays where it is."""
    high, wide = rgb.shape[:2]
    grain = _GRAIN * np.tile(_BAYER, (-(-high // 4), -(-wide // 4)))[:high, :wide, None]
    moved = np.clip(np.round(rgb + grain), 0, 255).astype(np.uint8)
    index = np.asarray(Image.fromarray(moved).quantize(palette=palette, dither=Image.Dither.NONE))
    return np.where(index == _LEAVE, 0, index).astype(np.uint8)


def _image(index, corner: tuple[int, int], palette: Image.Image) -> bytes:
    """The block of a GIF that holds these pixels, its top left corner there."""
    high, wide = index.shape
    image = Image.frombytes("P", (wide, high), np.ascontiguousarray(index, np.uint8).tobytes())
    image.putpalette(palette.getpalette())
    packed = io.BytesIO()
    image.save(packed, "GIF", optimize=False, interlace=0)
    return struct.pack("<BHHHHB", 0x2C, *map(int, corner), wide, high, 0) + _pixels(packed.getvalue())


def _pixels(gif: bytes) -> bytes:
    """The packed pixels of a GIF with one picture."""
    at = 13 + (3 << (gif[10] & 7) + 1 if gif[10] & 0x80 else 0)
    while gif[at] == 0x21:  # remarks and the like
        at += 2
        while gif[at]:
            at += gif[at] + 1
        at += 1
    own = gif[at + 9]
    at += 10 + (3 << (own & 7) + 1 if own & 0x80 else 0)
    end = at + 1
    while gif[end]:
        end += gif[end] + 1
    return gif[at : end + 1]
