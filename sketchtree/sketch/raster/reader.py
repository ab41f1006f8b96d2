"""Which strokes does a picture of a line drawing hold?

    picture → darkness against the paper → ink → dots and specks apart → outlined limbs filled
            → skeleton → web of lines → whole lines → strokes

Points are in pixels of the file's picture, upright: x to the right from its left edge, y UP from its top edge, so
that all y are negative and the middle of the top left pixel is (0.5, −0.5). `Sketch.page` is the picture's edge.
"""

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.errors import SketchError
from sketchtree.sketch.raster.colours import Painted, painted_areas, without_edges
from sketchtree.sketch.raster.crossing import link
from sketchtree.sketch.raster.dots import Dotted, dotted_curves
from sketchtree.sketch.raster.ends import bridged, drawn_on
from sketchtree.sketch.raster.foliage import without_foliage
from sketchtree.sketch.raster.hollow import filled_outlines
from sketchtree.sketch.raster.ink import Ink, extent, find_ink
from sketchtree.sketch.raster.judging import check_ink, check_lines, no_ink
from sketchtree.sketch.raster.lines_of import Traced, whole_lines
from sketchtree.sketch.raster.paper import darkness
from sketchtree.sketch.raster.picture import Picture, read_picture
from sketchtree.sketch.raster.speckle import swept
from sketchtree.sketch.raster.strokes_of import strokes_of
from sketchtree.sketch.raster.thinning import half_widths, thinned
from sketchtree.sketch.raster.tracing import trace
from sketchtree.sketch.strokes import Sketch

LARGEST = 200.0  # megapixels read at most, unless told otherwise


@dataclass(frozen=True, eq=False)
class Read:
    """What the ink of a picture shows. Pixels of the ink, (x, y), y DOWN."""

    lines: list[Traced]
    dotted: list[Dotted]
    crowns: list[Float[np.ndarray, "point 2"]]  # outlines of foliage
    filled: Bool[np.ndarray, "row col"] | None  # paper within limbs drawn by their outlines
    warnings: list[str]


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
    ink, painted, table = _ink(picture, name)
    tell(0.5)
    read = _lines(ink, name)
    notes = read.warnings
    if table:
        notes.append("What lies around the page, far darker than it, was left out.")
    tell(0.9)
    if len(read.lines) > max_strokes:
        raise SketchError(
            f"{name} holds {len(read.lines):,} lines; at most {max_strokes:,} are read.",
            remedy="Simplify it, or raise the limit with --max-strokes.",
        )
    scale = ink.scale * picture.scale
    crowns = [outline * scale for outline in read.crowns]
    lines = read.lines
    if painted is not None and painted.crowns:
        crowns += [outline * picture.scale for outline in painted.crowns]
        lines = without_edges(lines, [outline / ink.scale for outline in painted.crowns], ink.pen)
    strokes = strokes_of(lines, read.dotted, crowns, read.filled, ink, scale)
    if painted and painted.shadow:
        notes.append("A grey area under the tree was taken for its shadow and left out.")
    width, height = picture.size
    tell(1.0)
    page = (0.0, -float(height), float(width), 0.0)
    return Sketch(strokes, name=name, units="px", page=page, warnings=(*picture.warnings, *notes))


def _ink(picture: Picture, name: str) -> tuple[Ink, Painted | None, bool]:
    """(the ink of a picture, what of it is painted area instead, whether something around the page was left out)."""
    painted = painted_areas(picture.rgb) if picture.rgb is not None else None
    dark = darkness(picture.grey)
    if painted is not None:
        dark = dataclasses.replace(dark, d=np.where(painted.ground, np.float32(0), dark.d))
    ink = find_ink(dark)
    if ink is None:
        raise no_ink(name)
    check_ink(ink, name)
    return ink, painted, dark.outside


def _lines(ink: Ink, name: str) -> Read:
    """What the ink shows."""
    dotted, mask = dotted_curves(ink.mask, half_widths(ink.mask))
    clean = swept(mask, ink.pen)
    web = trace(*thinned(clean.mask), ink.pen)
    filled = filled_outlines(clean.mask, web, ink.pen)
    mask = clean.mask if filled is None else filled.mask
    if filled is not None:
        web = trace(*thinned(mask), ink.pen)
    lines = whole_lines(web, link(web, ink.pen), ink)
    check_lines(lines, len(dotted), clean.specks, extent(ink.mask), name)
    foliage = without_foliage(bridged(lines, ink.pen, ink=ink), ink.pen)
    drawn_on(foliage.wood, mask, ink.pen)
    notes = []
    if foliage.leaves:
        what = "its outline was taken for the crown" if foliage.crowns else "it was left out"
        notes.append(f"{foliage.leaves:,} small lines were taken for foliage: {what}.")
    if foliage.hatching:
        notes.append(f"{foliage.hatching:,} short parallel lines were taken for hatching and left out.")
    if clean.specks:
        notes.append(f"{clean.specks:,} specks were left out as dust or grain of the paper.")
    if clean.edges:
        notes.append("A dark edge of the picture was left out.")
    return Read(foliage.wood, dotted, foliage.crowns, None if filled is None else filled.inside, notes)
