"""Small drawings as pictures, with what was drawn known to a fraction of a pixel.

Lines are drawn FINER times as large and averaged down, so that their edges fall between pixels as a pen's do.
"""

import io

import numpy as np
import shapely
from PIL import Image, ImageDraw

from sketchtree.sketch.raster.reader import read_raster
from sketchtree.sketch.strokes import Sketch, StrokeKind

FINER = 4
SIZE = (300, 360)  # width, height of the little tree's page


def _arc(start, turn, end, count=24) -> np.ndarray:
    """A bent line from `start` to `end` that leaves towards `turn`."""
    t = np.linspace(0.0, 1.0, count)[:, None]
    a, b, c = (np.asarray(p, float) for p in (start, turn, end))
    return (1 - t) ** 2 * a + 2 * t * (1 - t) * b + t**2 * c


# pixels from the top left corner, y down; every limb starts on the trunk
TREE = (
    _arc((150, 345), (156, 200), (146, 20)),
    _arc((153, 230), (110, 190), (45, 175)),
    _arc((152, 190), (200, 170), (262, 100)),
    _arc((151.5, 140), (120, 110), (70, 60)),
)


def cover(lines=TREE, width=4.0, size=SIZE, *, closed=False) -> np.ndarray:
    """How much of every pixel is ink, 0 to 1. `width`: of all lines, or one for each."""
    image = Image.new("L", (size[0] * FINER, size[1] * FINER))
    brush = ImageDraw.Draw(image)
    for line, pen in zip(lines, np.broadcast_to(width, len(lines)), strict=True):
        at = np.asarray(line, float)
        at = np.vstack([at, at[:1]]) if closed else at
        dense = shapely.get_coordinates(shapely.segmentize(shapely.LineString(at), 0.25))
        for x, y in dense * FINER:
            half = pen * FINER / 2
            brush.ellipse([x - half - 0.5, y - half - 0.5, x + half - 0.5, y + half - 0.5], fill=255)
    return np.asarray(image.reduce(FINER), float) / 255.0


def area(outline, size=SIZE) -> np.ndarray:
    """How much of every pixel lies within an outline."""
    image = Image.new("L", (size[0] * FINER, size[1] * FINER))
    ImageDraw.Draw(image).polygon([tuple(p) for p in np.asarray(outline, float) * FINER - 0.5], fill=255)
    return np.asarray(image.reduce(FINER), float) / 255.0


def image_of(ink, paper=1.0, tone=0.0) -> Image.Image:
    """A grey picture: `ink` cover of lightness `tone` on `paper`, a number or one a pixel."""
    return Image.fromarray(np.clip(np.round(255 * (ink * tone + (1 - ink) * paper)), 0, 255).astype(np.uint8))


def file_of(image: Image.Image, kind: str = "PNG", **options) -> bytes:
    """An image as a file."""
    out = io.BytesIO()
    image.save(out, kind, **options)
    return out.getvalue()


def read(image, **options) -> Sketch:
    """What is read from a file, an image, or the cover of black ink on white."""
    if isinstance(image, np.ndarray):
        image = image_of(image)
    return read_raster(file_of(image) if isinstance(image, Image.Image) else image, "sheet.png", **options)


def curves(sketch: Sketch, *kinds: StrokeKind) -> list[np.ndarray]:
    """The strokes of these kinds (branches) in pixels, y down."""
    chosen = [s for s in sketch.strokes if s.kind in (kinds or (StrokeKind.BRANCH,))]
    return [np.vstack([s.points, s.points[:1]]) * (1, -1) if s.closed else s.points * (1, -1) for s in chosen]


def farthest(lines, others) -> float:
    """How far the points of some lines lie from other lines at most."""
    others = shapely.union_all([shapely.LineString(line) for line in others])
    dense = shapely.segmentize([shapely.LineString(line) for line in lines], 0.5)
    return float(shapely.distance(shapely.points(shapely.get_coordinates(dense)), others).max())


def apart(sketch: Sketch, lines=TREE) -> float:
    """The greatest distance between what was drawn and what was read, either way, pixels."""
    found = curves(sketch)
    return max(farthest(found, lines), farthest(lines, found))


def widths(stroke) -> np.ndarray:
    """Width of a stroke at each of its points, pixels."""
    return np.full(len(stroke.points), stroke.width) if stroke.pressure is None else stroke.pressure * stroke.width
