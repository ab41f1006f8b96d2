"""Which picture is it? Any picture file, as a `Photo`: upright, sRGB, eight bits a channel.

PNG, JPEG, WebP, TIFF, GIF and BMP; grey, palette, colour, CMYK or CIELAB; 1 to 16 bits. The EXIF orientation is obeyed, an embedded colour profile too (`srgb`). Where the file
has alpha it is kept, and what shows through is white. Of several frames the first is read, and a warning says so. The size is checked before anything is decoded. Nothing is
scaled: strokes, masks and traces keep the file's pixels.
"""

import os
from pathlib import Path

import numpy as np
from PIL import Image, ImageOps

from sketchtree.errors import SketchError
from sketchtree.photo.photo import Photo
from sketchtree.photo.srgb import in_srgb
from sketchtree.sketch.files.limits import MAX_MB, read_bytes
from sketchtree.sketch.files.recognise import Unreadable, recognise
from sketchtree.sketch.raster.opening import EXPORT, check_size, decoding, opened

MAX_MEGAPIXELS = 64.0  # 10⁶ pixels: a photo is worked on as a whole, some thirty bytes a pixel
_RAW = (".arw", ".cr2", ".dng", ".nef", ".nrw", ".orf", ".pef", ".raf", ".rw2", ".sr2", ".srw")
_DNG = 50706  # TIFF tag DNGVersion
NARROWEST = 16  # pixels: the shorter side of a photo


def read_photo(path: str | os.PathLike, *, max_mb: float = MAX_MB, max_megapixels: float = MAX_MEGAPIXELS) -> Photo:
    """The photo in a file. Raises SketchError, naming the file, for what is no picture, is damaged, or is larger than `max_mb` (10⁶ bytes) or `max_megapixels`."""
    path = Path(path)
    if path.is_dir():
        raise SketchError(f"{path} is a folder, not a photo.", remedy="Give the photo inside it.")
    return photo_in(read_bytes(path, max_mb=max_mb), path.name, max_megapixels=max_megapixels)


def photo_in(data: bytes, name: str, *, max_megapixels: float = MAX_MEGAPIXELS) -> Photo:
    """The photo in the bytes of a file called `name`. Raises SketchError as `read_photo`."""
    if not data:
        raise SketchError(f"{name} is empty.", remedy="Save the photo again.")
    with decoding(name):
        return _decoded(data, name, max_megapixels)


def _decoded(data: bytes, name: str, max_megapixels: float) -> Photo:
    image = opened(data)
    if image is not None and image.format == "TIFF" and _is_raw(image, name):
        raise SketchError(f"{name} is a camera's raw file, of which only a preview could be read.", remedy="Develop it in a photo program, and export it as PNG or JPEG.")
    if image is None:
        what = recognise(data)
        says = f"{what.what}, which can't be read" if isinstance(what, Unreadable) else "no picture that can be read"
        raise SketchError(f"{name} is {says}.", remedy=EXPORT)
    check_size(image.size, name, max_megapixels, narrowest=NARROWEST, shows="a tree")
    frames = 1 if image.format == "MPO" else getattr(image, "n_frames", 1)  # a phone's second picture is a preview or a map of depths
    kept = image.info.get("icc_profile")
    upright = ImageOps.exif_transpose(image)
    if kept is not None:
        upright.info["icc_profile"] = kept
    rgb, alpha, remarks = in_srgb(upright)
    notes = [f"{name} has {frames} pages or frames; only the first was read."] if frames > 1 else []
    notes += [f"{name}: {remark}" for remark in remarks]
    if alpha is not None and not alpha.any():
        raise SketchError(f"{name} is transparent everywhere.", remedy=EXPORT)
    return Photo(rgb, alpha, name, tuple(notes))


def _is_raw(image: Image.Image, name: str) -> bool:
    """Is it one of the raw formats that begin as a TIFF does? Then its first picture is a thumbnail."""
    return Path(name).suffix.lower() in _RAW or _DNG in getattr(image, "tag_v2", {})


def as_photo(picture: np.ndarray | Image.Image, *, name: str = "photo") -> Photo:
    """A photo of pixels in memory: rows × columns (grey), × 3 (RGB) or × 4 (RGBA) of eight bits, or a Pillow image."""
    image = picture if isinstance(picture, Image.Image) else Image.fromarray(np.asarray(picture, np.uint8))
    rgb, alpha, remarks = in_srgb(image)
    return Photo(rgb, alpha, name, remarks)
