"""How is a picture file opened? By its content, with its size checked before anything is decoded, and brought to one of a few modes."""

import io
import struct
import warnings
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from PIL import Image

from sketchtree.errors import SketchError

FORMATS = ("PNG", "JPEG", "MPO", "WEBP", "TIFF", "GIF", "BMP")
EXPORT = "Export the picture again as PNG or JPEG."
DAMAGED = (OSError, SyntaxError, ValueError, TypeError, EOFError, IndexError, KeyError, struct.error, Image.DecompressionBombError)  # what Pillow raises on a damaged file


def opened(data: bytes) -> Image.Image | None:
    """The file by the first format that takes it, its pixels not yet decoded. The size is checked by the caller, by
    its own limit, so Pillow's check, which is one for the whole process, is passed by."""
    Image.init()
    failure: Exception | None = None
    for kind in FORMATS:
        factory, accepts = Image.OPEN.get(kind, (None, None))
        if factory is None or (accepts is not None and accepts(data[:16]) is not True):
            continue
        try:
            return factory(io.BytesIO(data), "")
        except SyntaxError as error:  # Pillow's word for another format
            failure = error
    if failure is not None:
        raise failure
    return None


@contextmanager
def decoding(name: str) -> Iterator[None]:
    """What Pillow raises while the file called `name` is opened and decoded becomes a SketchError that says what to do."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Pillow remarks on odd metadata; damage to the picture itself is an error
        try:
            yield
        except SketchError:
            raise
        except MemoryError:
            raise SketchError(f"{name} needs more memory than there is.", remedy="Scale the picture down and try again.") from None
        except DAMAGED:
            raise SketchError(f"{name} is damaged: its picture can't be decoded.", remedy=EXPORT) from None


def check_size(size: tuple[int, int], name: str, limit: float, *, narrowest: int, shows: str = "a drawing") -> None:
    """Raise SketchError for more than `limit` megapixels, or a shorter side under `narrowest` pixels."""
    megapixels = size[0] * size[1] / 1e6
    if megapixels > limit:
        raise SketchError(
            f"{name} has {size[0]} × {size[1]} pixels ({megapixels:,.4g} megapixels); at most {limit:g} megapixels are read.",
            remedy="Scale the picture down, or raise the limit with --max-megapixels.",
        )
    if min(size) < narrowest:
        raise SketchError(f"{name} has {size[0]} × {size[1]} pixels, too few to show {shows}.", remedy="Give the picture in its full size.")


def plain(image: Image.Image) -> Image.Image:
    """The picture in one of the modes L, RGB, LA, RGBA or F (0-255)."""
    if image.mode in ("L", "RGB", "LA", "RGBA"):
        return image if "transparency" not in image.info else image.convert("RGBA")
    if image.mode in ("I;16", "I;16B", "I;16L", "I;16N", "I", "F"):
        tones = np.asarray(image, np.float32)
        top = 255.0 if image.mode in ("I", "F") and tones.max(initial=0.0) <= 255 else 65535.0
        if image.mode == "F" and tones.max(initial=0.0) <= 1.0:
            top = 1.0
        return Image.fromarray(np.nan_to_num(tones) * np.float32(255.0 / top))
    if image.mode == "LAB":
        return image.getchannel(0)
    if image.mode == "1":
        return image.convert("L")
    has_alpha = image.mode in ("PA", "La", "RGBa") or "transparency" in image.info
    return image.convert("RGBA" if has_alpha else "RGB")
