"""What does a picture file hold? Any of its many kinds, as tones of grey and of colour, upright, on a plain ground.

PNG, JPEG, WebP, TIFF, GIF and BMP, of 1 to 32 bits, grey, palette, colour or CMYK, with or without alpha. The EXIF
orientation is obeyed. A transparent ground becomes the one that shows the ink: white under dark ink, black under pale.
Of several pages or frames the first is read, and a warning says so. The size is checked before anything is decoded;
pictures over ROOM megapixels are decoded whole but brought down by a whole factor before they are worked on.
"""

import io
import struct
import warnings
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, UInt8
from PIL import Image, ImageOps

from sketchtree.errors import SketchError

FORMATS = ("PNG", "JPEG", "MPO", "WEBP", "TIFF", "GIF", "BMP")
ROOM = 16.0  # megapixels that are worked on at most
NARROWEST = 4  # pixels: the shorter side of a picture
PALE = 0.6  # lightness of the ink above which a transparent ground is taken for black
TINTED = 24  # least difference of a pixel's channels, of 255, that is colour
COLOURED = 0.002  # least part of the picture that is tinted in a coloured drawing
_EXPORT = "Export the picture again as PNG or JPEG."


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture as it is worked on. Row 0 is the top; pixel (row, col) covers [col, col + 1] × [row, row + 1] times `scale`."""

    grey: Float[np.ndarray, "row col"]  # lightness, 0 black to 1 white
    rgb: UInt8[np.ndarray, "row col 3"] | None  # None where it has no colour
    size: tuple[int, int]  # width and height of the file's picture, upright, pixels
    scale: float  # pixels of the file in one of these
    warnings: tuple[str, ...] = ()


def read_picture(data: bytes, name: str, *, max_megapixels: float) -> Picture:
    """Decode a picture file. Raises SketchError for what is no picture, is damaged, or is larger than `max_megapixels`."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Pillow remarks on odd metadata; damage to the picture itself is an error
        try:
            image = _opened(data)
            if image is None:
                raise SketchError(f"{name} is no picture that can be read.", remedy=_EXPORT)
            _check_size(image.size, name, max_megapixels)
            frames = getattr(image, "n_frames", 1)
            factor = max(1, int(np.ceil(np.sqrt(image.size[0] * image.size[1] / (ROOM * 1e6)))))
            upright = ImageOps.exif_transpose(image)
            size = upright.size
            small = _smaller(_plain(upright), factor)
        except SketchError:
            raise
        except MemoryError:
            raise SketchError(f"{name} needs more memory than there is.", remedy="Scale the picture down and try again.") from None
        except (OSError, SyntaxError, ValueError, TypeError, EOFError, IndexError, KeyError, struct.error, Image.DecompressionBombError):
            raise SketchError(f"{name} is damaged: its picture can't be decoded.", remedy=_EXPORT) from None
    grey, rgb = _tones(small)
    notes = (f"{name} has {frames} pages or frames; only the first was read.",) if frames > 1 else ()
    return Picture(grey, rgb, size, factor, notes)


def _opened(data: bytes) -> Image.Image | None:
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


def _check_size(size: tuple[int, int], name: str, limit: float) -> None:
    megapixels = size[0] * size[1] / 1e6
    if megapixels > limit:
        raise SketchError(
            f"{name} has {size[0]} × {size[1]} pixels ({megapixels:,.4g} megapixels); at most {limit:g} megapixels are read.",
            remedy="Scale the picture down, or raise the limit with --max-megapixels.",
        )
    if min(size) < NARROWEST:
        raise SketchError(f"{name} has {size[0]} × {size[1]} pixels, too few to show a drawing.", remedy="Give the picture in its full size.")


def _plain(image: Image.Image) -> Image.Image:
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


def _smaller(image: Image.Image, factor: int) -> Image.Image:
    return image.reduce(factor) if factor > 1 else image


def _tones(image: Image.Image) -> tuple[Float[np.ndarray, "row col"], UInt8[np.ndarray, "row col 3"] | None]:
    """(lightness 0-1, colours or None) of a plain picture, its ground filled in."""
    if image.mode == "F":
        return np.clip(np.asarray(image, np.float32) / np.float32(255.0), 0.0, 1.0), None
    if image.mode in ("LA", "RGBA"):
        image = _on_ground(image)
    if image.mode == "L":
        return np.asarray(image, np.float32) / np.float32(255.0), None
    rgb = np.asarray(image)
    spread = rgb.max(2) - rgb.min(2)
    grey = np.asarray(image.convert("L"), np.float32)
    if np.mean(spread > TINTED) < COLOURED:
        return grey / np.float32(255.0), None
    return _contrast(rgb, grey) / np.float32(255.0), rgb


def _contrast(rgb: UInt8[np.ndarray, "row col 3"], grey: Float[np.ndarray, "row col"]) -> Float[np.ndarray, "row col"]:
    """Lightness in which coloured lines stand out as well: half of it the channel that is farthest from the ground."""
    far = rgb.min(2) if np.median(grey[::4, ::4]) >= 128 else rgb.max(2)
    grey += far
    grey *= np.float32(0.5)
    return grey


def _on_ground(image: Image.Image) -> Image.Image:
    """A picture with alpha on the ground that shows its ink."""
    alpha = image.getchannel("A")
    cover = np.asarray(alpha, np.float32)
    base = "L" if image.mode == "LA" else "RGB"
    lightness = np.asarray(image.convert("RGBA").convert("L"), np.float32)
    shown = float((lightness * cover).sum() / max(float(cover.sum()), 1e-9)) / 255.0
    pale = cover.min() < 255 and shown > PALE and np.mean(cover < 128) > 0.05
    ground = Image.new(base, image.size, 0 if pale else "white")
    ground.paste(image.convert(base), mask=alpha)
    return ground
