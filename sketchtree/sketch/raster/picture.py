"""What does a picture file hold? Any of its many kinds, as tones of grey and of colour, upright, on a plain ground.

PNG, JPEG, WebP, TIFF, GIF and BMP, of 1 to 32 bits, grey, palette, colour or CMYK, with or without alpha. The EXIF
orientation is obeyed. A transparent ground becomes the one that shows the ink: white under dark ink, black under pale.
Of several pages or frames the first is read, and a warning says so. The size is checked before anything is decoded;
pictures over ROOM megapixels are decoded whole but brought down by a whole factor before they are worked on.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, UInt8
from PIL import Image, ImageOps

from sketchtree.errors import SketchError
from sketchtree.sketch.raster.opening import EXPORT, check_size, decoding, opened, plain

ROOM = 16.0  # megapixels that are worked on at most
NARROWEST = 4  # pixels: the shorter side of a picture
PALE = 0.6  # lightness of the ink above which a transparent ground is taken for black
TINTED = 24  # least difference of a pixel's channels, of 255, that is colour
COLOURED = 0.002  # least part of the picture that is tinted in a coloured drawing


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
    with decoding(name):
        image = opened(data)
        if image is None:
            raise SketchError(f"{name} is no picture that can be read.", remedy=EXPORT)
        check_size(image.size, name, max_megapixels, narrowest=NARROWEST)
        frames = getattr(image, "n_frames", 1)
        factor = max(1, int(np.ceil(np.sqrt(image.size[0] * image.size[1] / (ROOM * 1e6)))))
        upright = ImageOps.exif_transpose(image)
        size = upright.size
        small = _smaller(plain(upright), factor)
    grey, rgb = _tones(small)
    notes = (f"{name} has {frames} pages or frames; only the first was read.",) if frames > 1 else ()
    return Picture(grey, rgb, size, factor, notes)


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
