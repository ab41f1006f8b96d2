"""Pictures of trees whose every limb is known, painted for the tests: brown limbs on a blue sky over a green meadow."""

import numpy as np
from PIL import Image, ImageDraw

from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo

SKY, GRASS, BARK, LEAF = (150, 190, 235), (90, 140, 60), (70, 52, 40), (60, 120, 40)
TRUNK = [(300, 560), (300, 420), (300, 300), (305, 200), (310, 120)]
LIMBS = {  # name → (points, from its foot; width)
    "left": ([(300, 380), (220, 310), (150, 270), (90, 250)], 12),
    "right": ([(301, 330), (370, 260), (450, 215)], 10),
    "twig": ([(220, 310), (200, 240), (190, 180)], 7),
}
CROWN = [(300, 60), (480, 120), (540, 260), (480, 400), (300, 420), (120, 400), (50, 260), (120, 120)]


def bare_tree(grain: float = 4.0, *, seed: int = 0) -> Photo:
    """A tree without leaves, 600 × 600, with grain (standard deviation of every channel)."""
    image = Image.new("RGB", (600, 600), SKY)
    draw = ImageDraw.Draw(image)
    draw.rectangle((0, 540, 600, 600), fill=GRASS)
    draw.line(TRUNK, fill=BARK, width=24, joint="curve")
    for points, width in LIMBS.values():
        draw.line(points, fill=BARK, width=width, joint="curve")
    noise = np.random.default_rng(seed).normal(0.0, grain, (600, 600, 3))
    return Photo(np.clip(np.asarray(image) + noise, 0, 255).astype(np.uint8), name="painted")


def marked(*limbs: str) -> Marked:
    """The crown, the trunk, and strokes along the limbs named."""
    strokes = [TRUNK, *(LIMBS[name][0] for name in limbs)]
    return Marked(np.array(CROWN, float), tuple(np.array(line, float) for line in strokes), ("trunk", *limbs))


def walked(points, step: float = 2.0) -> np.ndarray:
    """Points along a polyline, about `step` apart."""
    points = np.asarray(points, float)
    pieces = [np.linspace(a, b, max(int(np.hypot(*(b - a)) / step), 2)) for a, b in zip(points[:-1], points[1:], strict=True)]
    return np.concatenate(pieces)


def distance(from_points, to_points) -> np.ndarray:
    """From each of some points to the nearest of others."""
    from scipy.spatial import cKDTree

    return cKDTree(np.asarray(to_points)).query(np.asarray(from_points))[0]
