"""What did a person paint in or out? Branches added to or erased from the matte by sketching (§III); the skeleton follows.

- A **drawing** (SVG, or any format that strokes are read from), its page the picture: strokes in layers, or with ids, named `add` are wood from now on, those named `erase` are none, each as wide as it was drawn (`BRUSH`
  pixels where it has no width). Later strokes lie over earlier ones. Edges are smooth: a pixel's middle half a pixel within a stroke's edge is covered wholly, one half a pixel without not at all.
- A **grey picture** of the matte's size: white adds, black erases, middle grey leaves alone; between them it does so in part. Where it is transparent nothing is changed.
"""

import os
import re
from pathlib import Path

import numpy as np
from jaxtyping import Float, Float32
from PIL import Image

from sketchtree.errors import SketchError
from sketchtree.photo.page_over import page_over
from sketchtree.photo.photo import turned_over
from sketchtree.photo.read_photo import read_photo
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import Sketch, Stroke, StrokeKind

BRUSH = 4.0  # pixels
_PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".webp", ".bmp")
_NAMED = re.compile(r"(?<![a-z])(add|erase)(?![a-z])", re.IGNORECASE)
_KINDS = {StrokeKind.MATTE_ADD: "add", StrokeKind.MATTE_ERASE: "erase"}  # as the studio draws them
_LEAVES = 4  # of 255, off middle grey: still grey
_REMEDY = "Draw strokes over the picture in layers named `add` and `erase`."


def edit_matte(alpha: Float[np.ndarray, "row column"], path: str | os.PathLike) -> Float32[np.ndarray, "row column"]:
    """The matte after the edits in a file. Raises SketchError for a file that edits nothing or has another shape."""
    path = Path(path)
    if path.suffix.lower() in _PICTURES:
        return painted(alpha, _grey(path, np.shape(alpha)))
    return sketched(alpha, read_sketch(path))


def painted(alpha: Float[np.ndarray, "row column"], grey: Float[np.ndarray, "row column"]) -> Float32[np.ndarray, "row column"]:
    """The matte after a grey picture: −1 erases, 0 leaves, 1 adds."""
    alpha = np.asarray(alpha, np.float64)
    return np.where(grey >= 0, alpha + (1.0 - alpha) * grey, alpha * (1.0 + grey)).astype(np.float32)


def sketched(alpha: Float[np.ndarray, "row column"], sketch: Sketch) -> Float32[np.ndarray, "row column"]:
    """The matte after strokes named `add` and `erase`."""
    rows, columns = np.shape(alpha)
    scale, shift = _placed(sketch, rows, columns)
    result, did = np.array(alpha, np.float64), False
    for stroke in sketch.strokes:
        if stroke.kind in (StrokeKind.FOREGROUND, StrokeKind.BACKGROUND):
            continue  # the matte was found by those (`matting.scribbles`)
        what = _KINDS.get(stroke.kind) or _named(stroke)
        if what is None:
            raise SketchError("it says neither `add` nor `erase`.", stroke=stroke.id, remedy=_REMEDY)
        width = stroke.width * scale if stroke.width else BRUSH
        window, cover = covered(turned_over(stroke.points) * scale + shift, float(width), (rows, columns))
        before = result[window]
        result[window] = np.maximum(before, cover) if what == "add" else np.minimum(before, 1.0 - cover)
        did |= bool((cover > 0).any())
    if not did:
        raise SketchError(f"{sketch.name} has no stroke on the picture of {columns} × {rows} pixels.", remedy=_REMEDY)
    return result.astype(np.float32)


def covered(line: Float[np.ndarray, "point 2"], width: float, size: tuple[int, int]) -> tuple[tuple[slice, slice], Float[np.ndarray, "row column"]]:
    """(a window of the picture, how far a round brush of this width along the line covers each pixel of it)."""
    reach = width / 2.0 + 1.0
    low, high = np.floor(line.min(axis=0) - reach).astype(int), np.ceil(line.max(axis=0) + reach).astype(int)
    columns, rows = (slice(min(max(low[k], 0), size[1 - k]), min(max(high[k], 0), size[1 - k])) for k in (0, 1))
    y, x = np.mgrid[rows, columns] + 0.5
    distance = np.full(x.shape, np.inf)
    for (ax, ay), (bx, by) in zip(line[:-1], line[1:], strict=True) if len(line) > 1 else [(line[0], line[0])]:
        length = (bx - ax) ** 2 + (by - ay) ** 2
        t = np.clip(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length, 0.0, 1.0) if length > 0 else 0.0
        np.minimum(distance, np.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay)), out=distance)
    return (rows, columns), np.clip(width / 2.0 + 0.5 - distance, 0.0, 1.0)


def _named(stroke: Stroke) -> str | None:
    """`add`, `erase`, or None: the layer's word before the id's."""
    for name in (stroke.layer, stroke.id):
        found = _NAMED.search(name or "")
        if found:
            return found[1].lower()
    return None


def _placed(sketch: Sketch, rows: int, columns: int) -> tuple[float, Float[np.ndarray, " 2"]]:
    """(pixels a user unit, shift) from the sketch's page to the picture."""
    placed = page_over(sketch.page, columns, rows)
    if placed is None:
        left, bottom, right, top = sketch.page
        raise SketchError(f"{sketch.name} is drawn on a page of {right - left:g} × {top - bottom:g}, but the matte has {columns} × {rows} pixels.", remedy="Draw over the picture, with its size as the page's.")
    return placed


def _grey(path: Path, size: tuple[int, int]) -> Float[np.ndarray, "row column"]:
    """A picture of edits, −1 … 1."""
    photo = read_photo(path)
    if photo.rgb.shape[:2] != size:
        raise SketchError(
            f"{path.name} has {photo.width} × {photo.height} pixels, but the matte has {size[1]} × {size[0]}.", remedy="Save the edits at the picture's size: white adds, black erases, grey leaves alone."
        )
    grey = np.asarray(Image.fromarray(photo.rgb).convert("L"), np.float64)
    level = np.where(np.abs(grey - 127.5) <= _LEAVES, 0.0, (grey - 127.5) / 127.5)
    level = level if photo.alpha is None else level * (photo.alpha / 255.0)
    if not level.any():
        raise SketchError(f"{path.name} is grey all over: it edits nothing.", remedy="Paint white where there is wood, and black where there is none.")
    return level
