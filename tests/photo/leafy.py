"""A leafy tree of 240 × 260 pixels, painted for the tests, with the strokes over it."""

import numpy as np
from PIL import Image, ImageDraw

from sketchtree.photo.marked import Marked
from sketchtree.photo.photo import Photo

WIDE, HIGH = 240, 260
SKY, MEADOW, BARK = (120, 170, 230), (205, 190, 140), (70, 52, 40)
GREEN, RUSTY = (62, 120, 44), (196, 92, 32)
TRUNK, LIMB = [(120, 240), (121, 190), (119, 130), (122, 70)], [(120, 180), (150, 140), (185, 110)]


def leafy_photo(leaf=GREEN, *, at=(0,), seed: int = 0) -> Photo:
    """Trees with round crowns, moved aside by `at` pixels; leaves are spots of about the colour `leaf`."""
    draw, width = np.random.default_rng(seed), WIDE + max(at)
    image = Image.new("RGB", (width, HIGH), SKY)
    pen = ImageDraw.Draw(image)
    pen.rectangle((0, 225, width, HIGH), fill=MEADOW)
    for aside in at:
        for line, thick in ((TRUNK, 14), (LIMB, 6)):
            pen.line([(x + aside, y) for x, y in line], fill=BARK, width=thick)
        for angle, far in zip(draw.uniform(0, 2 * np.pi, 2600), np.sqrt(draw.uniform(0, 1, 2600)), strict=True):
            x, y = 120 + aside + 88 * far * np.cos(angle), 105 + 85 * far * np.sin(angle)
            light = draw.uniform(0.75, 1.25)
            pen.ellipse((x - 3, y - 3, x + 3, y + 3), fill=tuple(int(min(light * v, 255)) for v in leaf))
    noise = draw.normal(0, 3, (HIGH, width, 1))
    return Photo(np.clip(np.asarray(image) + noise, 0, 255).astype(np.uint8), name="leafy.png")


def crown(aside: int = 0) -> np.ndarray:
    """A careful hand's stroke round the crown."""
    turn = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    return np.column_stack([120 + aside + 93 * np.cos(turn), 105 + 90 * np.sin(turn)])


def leafy_marks(aside: int = 0) -> Marked:
    """The strokes of one tree."""
    return Marked(crown(aside), tuple(np.array(line, float) + [aside, 0.0] for line in (TRUNK, LIMB)), ("trunk", "limb"))


def strokes_svg(size=(WIDE, HIGH), crown_at=None, limbs=(TRUNK, LIMB)) -> str:
    """The same strokes as an SVG file."""
    line = lambda points: " ".join(f"{x:.1f},{y:.1f}" for x, y in points)  # noqa: E731
    rim = crown() if crown_at is None else crown_at
    limbs = "".join(f'<polyline id="limb{k}" points="{line(points)}"/>' for k, points in enumerate(limbs))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size[0]} {size[1]}" fill="none" stroke="red">'
        f'<g id="crown"><polygon points="{line(rim)}"/></g><g id="branches">{limbs}</g></svg>'
    )
