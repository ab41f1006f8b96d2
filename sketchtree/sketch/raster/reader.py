"""Which strokes does a picture of a line drawing hold?

    picture → darkness against the paper → ink → dots and specks apart → outlined limbs filled
            → skeleton → web of lines → whole lines → strokes

Points are in pixels of the file's picture, upright: x to the right from its left edge, y UP from its top edge, so
that all y are negative and the middle of the top left pixel is (0.5, −0.5). `Sketch.page` is the picture's edge.
"""

import dataclasses
from collections.abc import Callable

import numpy as np
from jaxtyping import Bool

from sketchtree.errors import SketchError
from sketchtree.sketch.raster.colours import Painted, painted_areas
from sketchtree.sketch.raster.crossing import link
from sketchtree.sketch.raster.dots import Dotted, dotted_curves
from sketchtree.sketch.raster.ends import bridged, drawn_on
from sketchtree.sketch.raster.hollow import filled_outlines
from sketchtree.sketch.raster.ink import Ink, extent, find_ink
from sketchtree.sketch.raster.judging import check_ink, check_lines, no_ink
from sketchtree.sketch.raster.lines_of import Traced, whole_lines
from sketchtree.sketch.raster.paper import darkness
from sketchtree.sketch.raster.picture import Picture, read_picture
from sketchtree.sketch.raster.speckle import swept
from sketchtree.sketch.raster.strokes_of import strokes_of
from sketchtree.sketch.raster.thinning import thinned
from sketchtree.sketch.raster.tracing import trace
from sketchtree.sketch.strokes import Sketch

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
    ink, painted = _ink(picture, name)
    tell(0.5)
    lines, filled, dotted, notes = _lines(ink, name)
    tell(0.9)
    if len(lines) > max_strokes:
        raise SketchError(
            f"{name} holds {len(lines):,} lines; at most {max_strokes:,} are read.", remedy="Simplify it, or raise `max_strokes`."
        )
    crowns = [outline * picture.scale for outline in painted.crowns] if painted else []
    strokes = strokes_of(lines, dotted, crowns, filled, ink, ink.scale * picture.scale)
    if painted and painted.shadow:
        notes.append("A grey area under the tree was taken for its shadow and left out.")
    width, height = picture.size
    tell(1.0)
    page = (0.0, -float(height), float(width), 0.0)
    return Sketch(strokes, name=name, units="px", page=page, warnings=(*picture.warnings, *notes))


def _ink(picture: Picture, name: str) -> tuple[Ink, Painted | None]:
    """The ink of a picture, and what of it is painted area instead."""
    painted = painted_areas(picture.rgb) if picture.rgb is not None else None
    dark = darkness(picture.grey)
    if painted is not None:
        dark = dataclasses.replace(dark, d=np.where(painted.ground, np.float32(0), dark.d))
    ink = find_ink(dark)
    if ink is None:
        raise no_ink(name)
    check_ink(ink, name)
    return ink, painted


def _lines(ink: Ink, name: str) -> tuple[list[Traced], Bool[np.ndarray, "row col"] | None, list[Dotted], list[str]]:
    """(whole lines, ink and filled paper where limbs were outlines, dotted curves, warnings)."""
    dotted, mask = dotted_curves(ink.mask, thinned(ink.mask)[1])
    clean = swept(mask, ink.pen)
    web = trace(*thinned(clean.mask), ink.pen)
    filled = filled_outlines(clean.mask, web, ink.pen)
    mask = clean.mask if filled is None else filled.mask
    if filled is not None:
        web = trace(*thinned(mask), ink.pen)
    lines = bridged(whole_lines(web, link(web, ink.pen), ink), ink.pen)
    drawn_on(lines, mask, ink.pen)
    check_lines(lines, len(dotted), clean.specks, extent(mask), name)
    notes = []
    if clean.specks:
        notes.append(f"{clean.specks:,} specks were left out as dust or grain of the paper.")
    if clean.edges:
        notes.append("A dark edge of the picture was left out.")
    return lines, None if filled is None else filled.inside, dotted, notes
