"""A small picture of a bare tree: a trunk that forks twice, before a light sky, with a little noise."""

import io

import numpy as np
from PIL import Image, ImageDraw

SIZE = (80, 100)
_WOOD = (([(40, 96), (40, 10)], 8), ([(40, 60), (14, 30)], 5), ([(40, 50), (66, 26)], 5))


def painted_tree() -> bytes:
    """The picture as PNG."""
    image = Image.new("RGB", SIZE, (170, 200, 235))
    for line, width in _WOOD:
        ImageDraw.Draw(image).line(line, fill=(60, 45, 38), width=width)
    noisy = np.asarray(image) + np.random.default_rng(2).normal(0.0, 3.0, (*SIZE[::-1], 3))
    whole = io.BytesIO()
    Image.fromarray(np.clip(noisy, 0, 255).astype(np.uint8)).save(whole, "PNG")
    return whole.getvalue()
