"""Where does a picture to trace over lie at first? On the ground below the drawing's foot, as high as the drawing; on an empty page, as high as the page."""

import io
import warnings

import numpy as np

from sketchtree.editing.document import Document, Underlay
from sketchtree.errors import SketchError

_ORIENTATION, _LYING = 0x0112, (5, 6, 7, 8)  # of EXIF: the page shows the picture turned by a quarter
_EMPTY = 800.0  # height on an empty page, sketch units
_KINDS = ((b"\x89PNG\r\n\x1a\n", "image/png"), (b"\xff\xd8\xff", "image/jpeg"))


def kind_of(picture: bytes) -> str | None:
    """What kind of picture the page can show: its media type; None: none that it can."""
    if picture[:4] == b"RIFF" and picture[8:12] == b"WEBP":
        return "image/webp"
    return next((kind for start, kind in _KINDS if picture.startswith(start)), None)


def suffix_of(picture: bytes) -> str:
    """What the name of a file with this picture ends in."""
    return {"image/png": ".png", "image/jpeg": ".jpg", "image/webp": ".webp"}.get(kind_of(picture), ".png")


def placed(picture: bytes, name: str, document: Document) -> Underlay:
    """The picture under the drawing. Raises SketchError for what is no PNG, JPEG or WebP."""
    from PIL import Image

    if kind_of(picture) is None:
        raise SketchError(f"{name} is no picture that can be traced over.", remedy="Give a PNG, JPEG or WebP.")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            with Image.open(io.BytesIO(picture)) as image:
                lies = "exif" in image.info and image.getexif().get(_ORIENTATION) in _LYING
                width, height = image.size[::-1] if lies else image.size
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        raise SketchError(f"{name} can't be read as a picture.", remedy="Save it again, or choose a smaller one.") from error
    points = [stroke.points for stroke in document.strokes.values()]
    low, high = (np.vstack(points).min(axis=0), np.vstack(points).max(axis=0)) if points else (np.zeros(2), np.array([0.0, _EMPTY]))
    tall = float(high[1] - low[1]) or _EMPTY
    wide = tall * width / height
    return Underlay(picture, float(low[0] + high[0] - wide) / 2, float(low[1]) + tall, wide, tall)
