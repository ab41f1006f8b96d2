"""Which strokes does a picture of a line drawing hold?

    picture → darkness against the paper → ink → skeleton → web of lines → whole lines → strokes

Points are in pixels of the file's picture, upright: x to the right from its left edge, y UP from its top edge, so
that all y are negative and the middle of the top left pixel is (0.5, −0.5). `Sketch.page` is the picture's edge.
"""

from collections.abc import Callable

import numpy as np

from sketchtree.errors import SketchError
from sketchtree.sketch.raster.crossing import link
from sketchtree.sketch.raster.ink import find_ink
from sketchtree.sketch.raster.lines_of import Traced, whole_lines
from sketchtree.sketch.raster.paper import darkness
from sketchtree.sketch.raster.picture import read_picture
from sketchtree.sketch.raster.thinning import thinned
from sketchtree.sketch.raster.tracing import trace
from sketchtree.sketch.strokes import Sketch, Stroke

LARGEST = 200.0  # megapixels read at most, unless told otherwise


def read_raster(
    data: bytes,
    name: str,
    *,
    max_strokes: int = 20_000,
    max_megapixels: float = LARGEST,
    progress: Callable[[float], None] | None = None,
) -> Sketch:
    """Read a picture of a line drawing: PNG, JPEG, WebP, TIFF, GIF or BMP.

    `progress` is told the part done, 0 to 1. Raises SketchError for what is no picture, is damaged, is larger than
    `max_megapixels`, shows no line drawing, or holds more than `max_strokes` lines.
    """
    tell = progress or (lambda part: None)
    picture = read_picture(data, name, max_megapixels=max_megapixels)
    tell(0.2)
    dark = darkness(picture.grey)
    tell(0.4)
    ink = find_ink(dark)
    if ink is None:
        raise SketchError(f"{name} shows nothing: the page is blank.", remedy="Draw the tree darker, or photograph it closer.")
    tell(0.6)
    web = trace(*thinned(ink.mask))
    lines = whole_lines(web, link(web, ink.pen), ink.pen)
    tell(0.9)
    if len(lines) > max_strokes:
        raise SketchError(f"{name} holds {len(lines):,} lines; at most {max_strokes:,} are read.", remedy="Simplify it, or raise `max_strokes`.")
    width, height = picture.size
    scale = ink.scale * picture.scale
    strokes = tuple(_stroke(f"trace-{k}", line, scale) for k, line in enumerate(lines, start=1))
    tell(1.0)
    return Sketch(strokes, name=name, units="px", page=(0.0, -float(height), float(width), 0.0), warnings=picture.warnings)


def _stroke(stroke_id: str, line: Traced, scale: float) -> Stroke:
    points = line.points * (scale, -scale)
    width = line.width * scale
    return Stroke(stroke_id, points, closed=line.closed, width=float(width.max()), pressure=width / width.max())
