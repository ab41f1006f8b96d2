"""What did the user mark as tree, and what as anything else? Two sets of lines over a photo, from a JSON or SVG file.

    {"foreground": [[[x, y], ...], ...], "background": [...], "brush": px, "order": ["foreground", "background", ...]}

Pixels, x right, y DOWN; the middle of the pixel in row r and column c is (c + ½, r + ½). A brush is round and `brush` pixels across. In a drawing every line has its own width. An SVG says by layer or id which is
which, and its page (viewBox) is the photo. Where lines of both sides lie over each other the newer counts: lines of a drawing are in its order, those of a JSON file in that of `order`, a side's name a line (without it
the background's lie over the foreground's).
"""

import os
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.errors import SketchError
from sketchtree.photo.page_over import page_over
from sketchtree.photo.photo import Photo, turned_over
from sketchtree.sketch.files.json_text import parse_json
from sketchtree.sketch.files.limits import MAX_MB, inflate, read_bytes
from sketchtree.sketch.formats import read_sketch
from sketchtree.sketch.strokes import SCRIBBLES, Stroke, StrokeKind

BRUSH = 3.0  # pixels across, where a file doesn't say
SIDES = ("foreground", "background")
_MOST = 100_000  # points of all lines
_AGAIN = "Draw the scribbles again over this photo."


@dataclass(frozen=True, eq=False)
class Scribbles:
    """Lines on the tree and lines beside it. Requirements, checked at construction: every line has a point, all are finite, the brush is a positive number."""

    foreground: tuple[Float[np.ndarray, "point 2"], ...]
    background: tuple[Float[np.ndarray, "point 2"], ...]
    brush: float = BRUSH  # pixels across
    name: str = "scribbles"
    warnings: tuple[str, ...] = field(default=())
    brushes: tuple[tuple[float, ...], tuple[float, ...]] | None = None  # of each line of either side, pixels across; None: all are `brush`
    order: tuple[int, ...] | None = None  # the side (0 foreground, 1 background) of every line as they were drawn; None: the foreground's first

    def __post_init__(self):
        for brush in (self.brush, *(one for side in self.brushes or () for one in side)):
            if not (np.isfinite(brush) and brush > 0):
                raise SketchError(f"{self.name} has a brush of {brush:g} pixels.", remedy="Give `brush` as the line's width in pixels, above 0.")
        assert self.brushes is None or [len(side) for side in self.brushes] == [len(self.foreground), len(self.background)], "a brush a line"
        counts = [len(self.foreground), len(self.background)]
        assert self.order is None or [self.order.count(k) for k in (0, 1)] == counts and len(self.order) == sum(counts), "every line once in the order"
        for side in SIDES:
            lines = tuple(np.array(line, np.float64).reshape(-1, 2) for line in getattr(self, side))
            for k, line in enumerate(lines):
                if len(line) == 0 or not np.isfinite(line).all():
                    what = "has no points" if len(line) == 0 else "has a coordinate that is not a finite number"
                    raise SketchError(f"{self.name}: {side} line {k + 1} {what}.", remedy="Delete it or draw it again.")
                line.flags.writeable = False
            object.__setattr__(self, side, lines)

    def masks(self, photo: Photo) -> tuple[Bool[np.ndarray, "row column"], Bool[np.ndarray, "row column"]]:
        """The pixels under the foreground's and under the background's lines; under both, the newer line's. Raises SketchError where a side has none in the photo, or the other's lie over all of it."""
        if not self.foreground and not self.background:
            raise SketchError(f"{self.name} is empty.", remedy="Draw one line along the trunk (foreground) and one beside the tree (background).")
        masks, seen = self._drawn(photo)
        for side, mask, marks in zip(SIDES, masks, seen, strict=True):
            if not getattr(self, side):
                raise SketchError(f"{self.name} has no {side} line.", remedy=_wanted(side))
            if not marks.any():
                raise SketchError(f"The {side} lines of {self.name} lie outside the photo ({photo.width} × {photo.height} pixels).", remedy=_AGAIN)
            if not mask.any():
                other = SIDES[1 - SIDES.index(side)]
                raise SketchError(f"{self.name}: its {other} lines lie over all of its {side} lines.", remedy=f"{_wanted(side)} Where lines lie over each other, the newer counts.")
        return masks

    def overlapping(self, photo: Photo) -> tuple[str, ...]:
        """A warning where lines of both sides lie over each other."""
        fore, back = self._drawn(photo)[1]
        both = fore & back
        if not both.any():
            return ()
        row, column = np.argwhere(both)[0]
        pixels = "1 pixel" if both.sum() == 1 else f"{both.sum()} pixels"
        return (f"{self.name} marks {pixels} as foreground and as background, the first at ({column}, {row}); the newer line counts.",)

    def _drawn(self, photo: Photo):
        """(pixels of either side, the newer lines over the older; pixels under either side's lines)."""
        shape = (photo.height, photo.width)
        masks, seen = ([np.zeros(shape, bool), np.zeros(shape, bool)] for _ in range(2))
        first = [0, 0]
        for side, run in groupby(self.order or (0,) * len(self.foreground) + (1,) * len(self.background)):
            rows = slice(first[side], first[side] + len(list(run)))
            first[side] = rows.stop
            marks = painted(getattr(self, SIDES[side])[rows], self.brush if self.brushes is None else self.brushes[side][rows], shape)
            seen[side] |= marks
            masks[side] |= marks
            masks[1 - side] &= ~marks
        return tuple(masks), tuple(seen)

    def scaled(self, along: Float[np.ndarray, " 2"], scale: float) -> "Scribbles":
        """The same on a photo of another size: x and y times `along`, brushes times `scale`."""
        lines = (tuple(line * along for line in getattr(self, side)) for side in SIDES)
        brushes = None if self.brushes is None else tuple(tuple(scale * brush for brush in side) for side in self.brushes)
        return Scribbles(*lines, scale * self.brush, self.name, self.warnings, brushes, self.order)

    def leaving(self, photo: Photo) -> tuple[str, ...]:
        """A warning for every line that leaves the photo: only what lies inside counts."""
        told = []
        for side in SIDES:
            for k, line in enumerate(getattr(self, side)):
                if (line < -1).any() or (line > [photo.width + 1, photo.height + 1]).any():
                    told.append(f"{self.name}: {side} line {k + 1} leaves the photo; what is outside was left out.")
        return tuple(told)


def _wanted(side: str) -> str:
    return "Draw a line along the trunk." if side == "foreground" else "Draw a line beside the tree, over what is behind it."


def painted(lines, brush: float | Sequence[float], shape: tuple[int, int]) -> Bool[np.ndarray, "row column"]:
    """The pixels whose middle lies within half a brush of a line, and those that hold one of its points. `brush`: of all lines, or of each."""
    mask = np.zeros(shape, bool)
    for line, width in zip(lines, np.broadcast_to(np.asarray(brush, np.float64), len(lines)), strict=True):
        _paint(mask, line, width / 2)
        column, row = np.floor(line).astype(np.int64).T if np.abs(line).max() < 1e9 else np.full((2, len(line)), -1)
        inside = (row >= 0) & (row < shape[0]) & (column >= 0) & (column < shape[1])
        mask[row[inside], column[inside]] = True
    return mask


def _paint(mask: Bool[np.ndarray, "row column"], line: Float[np.ndarray, "point 2"], half: float) -> None:
    ends = line if len(line) > 1 else np.repeat(line, 2, axis=0)
    for start, end in zip(ends[:-1], ends[1:], strict=True):
        low = np.clip(np.floor(np.minimum(start, end) - half).astype(np.float64), 0, mask.shape[::-1]).astype(int)
        high = np.clip(np.ceil(np.maximum(start, end) + half).astype(np.float64), 0, mask.shape[::-1]).astype(int)
        if (high <= low).any():
            continue
        x, y = np.meshgrid(np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1]) + 0.5)
        along = end - start
        at = np.clip(((x - start[0]) * along[0] + (y - start[1]) * along[1]) / max(along @ along, 1e-12), 0.0, 1.0)
        near = np.hypot(x - start[0] - at * along[0], y - start[1] - at * along[1]) <= half
        mask[low[1] : high[1], low[0] : high[0]] |= near


def read_scribbles(path: str | os.PathLike, photo: Photo, *, max_mb: float = MAX_MB) -> Scribbles:
    """The scribbles in a file, in the photo's pixels. Raises SketchError, naming the file, for what holds none."""
    path = Path(path)
    data = inflate(read_bytes(path, max_mb=max_mb), path.name, max_mb=max_mb)
    document = parse_json(data, path.name) if data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith((b"{", b"[")) else None
    drawing = document is None or isinstance(document, dict) and "sketchtree" in document
    found = _of_drawing(path, photo, max_mb) if drawing else _of_json(document, path.name)
    return replace(found, warnings=found.warnings + found.leaving(photo))


def _of_json(document: Any, name: str) -> Scribbles:
    if not isinstance(document, dict) or not any(side in document for side in SIDES):
        raise SketchError(f"{name} is JSON, but holds no scribbles: it has neither a key 'foreground' nor 'background'.", remedy="Compare it with docs/formats.md.")
    brush = document.get("brush", BRUSH)
    if isinstance(brush, bool) or not isinstance(brush, int | float):
        raise SketchError(f"{name} has 'brush': {brush!r}; a number was expected.", remedy="Give `brush` as the line's width in pixels, above 0.")
    sides = [tuple(_line(line, name, side, k) for k, line in enumerate(_list(document.get(side, []), name, side))) for side in SIDES]
    if sum(len(line) for side in sides for line in side) > _MOST:
        raise SketchError(f"{name} has more than {_MOST:,} points.", remedy="Simplify the lines.")
    return Scribbles(sides[0], sides[1], float(brush), name, order=_order(document.get("order"), [len(side) for side in sides], name))


def _order(value: Any, counts: list[int], name: str) -> tuple[int, ...] | None:
    if value is None:
        return None
    sides = value if isinstance(value, list) else []
    if len(sides) != sum(counts) or [sides.count(side) for side in SIDES] != counts:
        raise SketchError(
            f"{name}: 'order' doesn't name a side for each of the {counts[0]} foreground and {counts[1]} background lines.",
            remedy='Give it as ["foreground", "background", ...] in the order in which they were drawn, or leave it out.',
        )
    return tuple(SIDES.index(side) for side in sides)


def _list(value: Any, name: str, side: str) -> list:
    if not isinstance(value, list):
        raise SketchError(f"{name}: '{side}' is no list of lines.", remedy="Give it as [[[x, y], ...], ...].")
    return value


def _line(line: Any, name: str, side: str, k: int) -> Float[np.ndarray, "point 2"]:
    points = line if isinstance(line, list) else [None]
    numbers = [point[:2] for point in points if isinstance(point, list) and len(point) >= 2 and all(_number(value) for value in point[:2])]
    if len(numbers) != len(points):
        raise SketchError(f"{name}: {side} line {k + 1} is no list of points.", remedy="Give every line as [[x, y], ...], in pixels.")
    return np.array(numbers, np.float64).reshape(-1, 2)


def _number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _of_drawing(path: Path, photo: Photo, max_mb: float) -> Scribbles:
    sketch = read_sketch(path, max_mb=max_mb)
    placed = page_over(sketch.page, photo.width, photo.height)
    if placed is None:
        left, bottom, right, top = sketch.page
        raise SketchError(f"{path.name} is drawn on a page of {right - left:g} × {top - bottom:g}, but the photo has {photo.width} × {photo.height} pixels.", remedy=_AGAIN)
    scale, shift = placed
    strokes = [replace(stroke, points=stroke.points * scale + shift * [1, -1], width=stroke.width and stroke.width * scale) for stroke in sketch.strokes]
    return scribbled(strokes, path.name)


def scribbled(strokes: Sequence[Stroke], name: str) -> Scribbles:
    """The scribbles among strokes over a photo, in its pixels, y UP; each line as wide as it was drawn."""
    sides: dict[str, list[Stroke]] = {side: [] for side in SIDES}
    order, nameless = [], 0
    for stroke in strokes:
        if stroke.kind in (StrokeKind.MATTE_ADD, StrokeKind.MATTE_ERASE):
            continue  # those edit the matte (`trunk.edit_matte`)
        said = stroke.kind.value if stroke.kind in SCRIBBLES else next((side for word in (stroke.id, stroke.layer) for side in SIDES if side in (word or "").lower()), None)
        nameless += said is None
        if said is not None:
            sides[said].append(stroke)
            order.append(SIDES.index(said))
    lines = (tuple(turned_over(stroke.points) for stroke in side) for side in sides.values())
    widths = [stroke.width for side in sides.values() for stroke in side if stroke.width]
    usual = float(np.median(widths)) if widths else BRUSH
    brushes = tuple(tuple(float(stroke.width or usual) for stroke in side) for side in sides.values())
    told = (f"{name}: {nameless} lines are in no layer called foreground or background; they were left out.",) if nameless else ()
    return Scribbles(*lines, usual, name, told, brushes, tuple(order))
