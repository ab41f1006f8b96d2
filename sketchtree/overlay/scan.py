"""The scanned drawing itself, to lie under its overlay."""

from pathlib import Path

import numpy as np
from jaxtyping import UInt8

LARGEST = 1600  # pixels: a larger scan is shown at this size


def scan(path: Path) -> UInt8[np.ndarray, "row column 3"] | None:
    """The picture in a file as it is seen, on white; None where the file is none."""
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        with Image.open(path) as image:
            shown = ImageOps.exif_transpose(image).convert("RGBA")
    except (UnidentifiedImageError, OSError):
        return None
    paper = Image.new("RGBA", shown.size, "#ffffff")
    return np.array(Image.alpha_composite(paper, shown).convert("RGB"))
