"""The scanned drawing itself, to lie under its overlay."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import UInt8

from sketchtree.sketch.strokes import Sketch

LARGEST = 1600  # pixels: a larger scan is shown at this size


@dataclass(frozen=True, eq=False)
class Scan:
    """A picture whose own pixels are the sketch's units; what is shown of it may be smaller."""

    pixels: UInt8[np.ndarray, "row column 3"]
    width: float  # of the picture, sketch units
    height: float


def scan(path: Path, sketch: Sketch) -> Scan | None:
    """The picture in a file as it is seen, on white; None where the file is none, or holds the strokes beside the picture."""
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        with Image.open(path) as image:
            shown = ImageOps.exif_transpose(image)
            width, height = shown.size
            shown.thumbnail((LARGEST, LARGEST))
            shown = shown.convert("RGBA")
    except (UnidentifiedImageError, OSError):
        return None
    if sketch.page != (0.0, -float(height), float(width), 0.0):
        return None
    paper = Image.new("RGBA", shown.size, "#ffffff")
    return Scan(np.array(Image.alpha_composite(paper, shown).convert("RGB")), float(width), float(height))
