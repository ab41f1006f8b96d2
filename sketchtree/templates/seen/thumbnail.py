"""What picture stands for an exemplar? A small grey drawing of its bare branches."""

import numpy as np
from jaxtyping import UInt8
from PIL import Image, ImageDraw

from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.seen.footprint import project

SIZE = 128  # pixels
_FINER = 4  # drawn so much larger, then averaged


def thumbnail(tree: TreeSkeleton, *, size: int = SIZE, azimuth_deg: float = 0.0) -> UInt8[np.ndarray, "row column"]:
    """Grey picture: 255 paper, 0 wood; the tree stands on the lower edge."""
    start, tip = project(tree.start, azimuth_deg), project(tree.tip, azimuth_deg)
    ends = np.concatenate([start, tip])
    low, high = ends.min(axis=0), ends.max(axis=0)
    pixels = size * _FINER
    scale = 0.94 * pixels / max(float((high - low).max()), 1e-9)
    shift = np.array([pixels / 2 - scale * (low[0] + high[0]) / 2, 0.03 * pixels - scale * low[1]])
    image = Image.new("L", (pixels, pixels), 255)
    draw = ImageDraw.Draw(image)
    for a, b, radius in zip(start * scale + shift, tip * scale + shift, tree.radius * scale, strict=True):
        width = max(_FINER // 2, round(2 * float(radius)))
        draw.line([(a[0], pixels - a[1]), (b[0], pixels - b[1])], fill=0, width=width)
        if width > _FINER:
            half = width / 2
            draw.ellipse([b[0] - half, pixels - b[1] - half, b[0] + half, pixels - b[1] + half], fill=0)
    fine = np.asarray(image, np.uint32).reshape(size, _FINER, size, _FINER)
    return ((fine.sum(axis=(1, 3)) + _FINER**2 // 2) // _FINER**2).astype(np.uint8)
