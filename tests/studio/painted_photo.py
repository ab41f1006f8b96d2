"""A photo of a tree, painted: a trunk, two boughs and leaves before a sky; and strokes on the page that mark them."""

import io

import numpy as np
from PIL import Image, ImageDraw

from sketchtree.editing.document import Document, Underlay
from sketchtree.sketch.strokes import Stroke, StrokeKind

SKY, GRASS, BARK, LEAF = (150, 190, 235), (112, 150, 86), (70, 52, 40), (60, 120, 40)
SIZE = (600, 600)
TRUNK = [(300, 560), (300, 420), (300, 300), (305, 200), (310, 120)]
LEFT = [(300, 380), (220, 310), (150, 270), (90, 250)]
RIGHT = [(301, 330), (370, 260), (450, 215)]
CROWN = [(300, 60), (480, 120), (540, 260), (480, 400), (300, 440), (120, 400), (50, 260), (120, 120)]
AT = (100.0, 50.0, 300.0)  # where it lies on the page: left and top (y up), and its width, half as many units as pixels


def photo(scale: float = 1.0, *, leafy: bool = False) -> bytes:
    """A PNG of it; `leafy`: its crown is full of leaves."""
    image = Image.new("RGB", SIZE, SKY)
    draw, chance = ImageDraw.Draw(image), np.random.default_rng(1)
    draw.rectangle((0, 540, *SIZE), fill=GRASS)
    for line, width in ((TRUNK, 24), (LEFT, 14), (RIGHT, 12)):
        draw.line(line, fill=BARK, width=width, joint="curve")
    for x, y in chance.uniform((60, 70), (530, 400), (400, 2)):
        if np.hypot((x - 295) / 230, (y - 235) / 165) < 1 and np.hypot(x - 300, y - 235) > 120:
            draw.ellipse((x - 7, y - 5, x + 7, y + 5), fill=LEAF)
    for x, y in chance.uniform((60, 70), (530, 400), (5000 if leafy else 0, 2)):
        if np.hypot((x - 295) / 225, (y - 235) / 160) < 1:
            light = chance.uniform(0.7, 1.3)
            draw.ellipse((x - 6, y - 4, x + 6, y + 4), fill=tuple(int(light * channel) for channel in LEAF))
    noisy = np.clip(np.asarray(image) + chance.normal(0.0, 4.0, (*SIZE[::-1], 3)), 0, 255).astype(np.uint8)
    image = Image.fromarray(noisy)
    data = io.BytesIO()
    (image if scale == 1 else image.resize((round(SIZE[0] * scale), round(SIZE[1] * scale)))).save(data, "PNG")
    return data.getvalue()


def on_page(pixels) -> np.ndarray:
    """Pixels of the photo, y down, on the page, y up."""
    left, top, width = AT
    return np.array(pixels, float) * (1.0, -1.0) * width / SIZE[0] + (left, top)


def mark(name: str, pixels, *, crown: bool = False) -> Stroke:
    """A stroke on the page along pixels of the photo."""
    return Stroke(name, on_page(pixels), StrokeKind.CROWN if crown else StrokeKind.BRANCH, labelled=True, closed=crown, width=None if crown else 3.0)


def document(*strokes: Stroke, picture: bytes | None = None, is_photo: bool = True) -> Document:
    """A page with the photo under it."""
    left, top, width = AT
    under = Underlay(photo() if picture is None else picture, left, top, width, width * SIZE[1] / SIZE[0], 1.0, photo=is_photo)
    return Document({stroke.id: stroke for stroke in strokes}, underlay=under)
