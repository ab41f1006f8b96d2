"""Which strokes are lines in their own right? Doubled points, dots, retraced and repeated strokes taken out.

Shaky hands draw a line twice, go back over it, or leave dots. A branch may also truly lie over another in
projection, so a stroke is merged only if it repeats the other from end to end, covers most of it, or never leaves its
ink. The lines come back in an order and direction of their own, so that the order of the file decides nothing.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Float, Int

from sketchtree.errors import SketchError
from sketchtree.sketch.joining.folding import AGAIN, CUSP, DOT, farthest, unfolded
from sketchtree.sketch.joining.lines import Line, corners, ends_of, extent, shapes_of, turning
from sketchtree.sketch.joining.tremor import STILL, without_tremor

INK = 0.0012  # of H: a stroke nowhere farther than this from another is part of it
MOST = 0.6  # of the other: a stroke that covers so much of it may lie off by AGAIN
REPEAT = (0.003, 0.06, 0.012)  # of H, of its length, of H: how far a repeated stroke may lie off, ends too: least, part, most
SLANT = 0.15  # never farther than this part of its own length: a twig leaves its parent at 9° or more
BATCH = 1000  # lines compared with each other at once: many may lie on one another
AGAIN_OVER = "drawn over that stroke, merged with it"


@dataclass(frozen=True, eq=False)
class Cleaned:
    """The lines that remain, and what became of the others."""

    lines: list[Line]
    merged: tuple[tuple[Line, int, str], ...]  # (line, row of the stroke it became part of, why)
    dots: tuple[str, ...]  # ids


def clean(lines: list[Line]) -> Cleaned:
    """Drop dots, cut strokes that turn back on themselves, still the tremor, merge repeated ones."""
    height = extent(lines)
    low, high = corners(lines)
    kept = [line for line, size in zip(lines, (high - low).max(1).tolist(), strict=True) if size >= DOT * height]
    if not kept:
        raise _far_apart(lines)
    kept_ids = {line.id for line in kept}
    dots = tuple(line.id for line in lines if line.id not in kept_ids)
    turns = turning(kept)
    if (turns > min(CUSP, STILL)).any():
        parts = [part for line, turn in zip(kept, turns, strict=True) for part in (unfolded(line, height) if turn > CUSP else [line])]
        kept = [without_tremor(part, height) if turn > STILL else part for part, turn in zip(parts, turning(parts), strict=True)]
    ordered = _ordered([_upward(line) for line in kept], height)
    owner = _owners(ordered, height)
    merged = [(line, ordered[o].row, AGAIN_OVER) for line, o in zip(ordered, owner, strict=True) if o >= 0]
    own = [line for line, o in zip(ordered, owner, strict=True) if o < 0]
    return Cleaned(own, tuple(merged), dots)


def _far_apart(lines: list[Line]) -> SketchError:
    """The error for strokes that are all dots beside how far apart they lie; it names the one farthest out."""
    middles = np.array([(line.points.min(0) + line.points.max(0)) / 2 for line in lines])
    farthest = lines[int(np.argmax(np.abs(middles - np.median(middles, axis=0)).max(1)))]
    return SketchError(
        "it lies so far from the others that all strokes are dots beside that distance.",
        stroke=farthest.id,
        remedy="Delete it, or move it back to the drawing.",
    )


def without_doubles(points: Float[np.ndarray, "point 2"], size: float) -> Float[np.ndarray, " point"]:
    """Mask of the points that differ from the one kept before them."""
    step = np.hypot(*np.diff(points, axis=0).T)
    if (step > 1e-9 * size).all():
        return np.ones(len(points), bool)
    mask, last = np.ones(len(points), bool), points[0]
    for k in range(1, len(points)):
        mask[k] = np.hypot(*(points[k] - last)) > 1e-9 * size
        last = points[k] if mask[k] else last
    return mask


def _upward(line: Line) -> Line:
    """The line drawn from its lower end (from the left one if they are level)."""
    first, last = line.points[0], line.points[-1]
    return line if (first[1], first[0]) <= (last[1], last[0]) else line.reversed()


def _ordered(lines: list[Line], height: float) -> list[Line]:
    """The lines in an order that depends on their shapes alone: the longest first, then by the heights of their ends."""
    ends = ends_of(lines).reshape(-1, 2, 2)
    length = np.array([line.length for line in lines])
    high = np.round(np.stack([-length, ends[:, 0, 1], ends[:, 1, 1]]) / height, 9)
    order = np.lexsort((ends[:, 1, 0], ends[:, 0, 0], high[2], high[1], high[0]))
    return [lines[k] for k in order.tolist()]


def _owners(lines: list[Line], height: float) -> Int[np.ndarray, " line"]:
    """For every line the earlier (longer) line that it repeats, else -1. An owner is no one's own."""
    owner = np.full(len(lines), -1)
    shapes = shapes_of(lines)
    for first in range(0, len(lines), BATCH):
        here, before = np.arange(first, min(first + BATCH, len(lines))), np.flatnonzero(owner[:first] < 0)
        for others in (before, here) if first else (here,):
            own = here[owner[here] < 0]
            for a, b in _beside(lines, shapes, own, others, height):
                if owner[a] < 0 and owner[b] < 0 and _repeats(lines[a], lines[b], height):
                    owner[a] = b
    return owner


def _beside(lines: list[Line], shapes, inner, outer, height: float) -> list[tuple[int, int]]:
    """(line of `inner`, earlier line of `outer` that its middle and both ends lie near to), in order."""
    near = np.minimum(REPEAT[2] * height, SLANT * np.array([lines[k].length for k in inner.tolist()]))
    middle = shapely.line_interpolate_point(shapes[inner], 0.5, normalized=True)
    row, other = shapely.STRtree(shapes[outer]).query(middle, predicate="dwithin", distance=near)
    for end in (0, -1):
        points = shapely.points(np.array([lines[k].points[end] for k in inner.tolist()]).reshape(-1, 2))
        close = (outer[other] < inner[row]) & (shapely.distance(points[row], shapes[outer[other]]) <= near[row])
        row, other = row[close], other[close]
    return sorted(zip(inner[row].tolist(), outer[other].tolist(), strict=True))


def _repeats(line: Line, other: Line, height: float) -> bool:
    slant = SLANT * line.length
    far = farthest(line, other.shape)
    if far <= min(INK * height, slant) or (line.length >= MOST * other.length and far <= min(AGAIN * height, slant)):
        return True
    low, part, high = REPEAT
    off = min(np.clip(part * line.length, low * height, high * height), slant)
    ends = line.points[[0, -1], None] - other.points[None, [0, -1]]
    gaps = np.hypot(ends[..., 0], ends[..., 1])
    return bool(far <= off and (max(gaps[0, 0], gaps[1, 1]) <= off or max(gaps[0, 1], gaps[1, 0]) <= off))


def as_line(row: int, stroke_id: str, points, width, begun: float = np.nan) -> Line | None:
    """A line from the points of a stroke; None where they are all one point. `begun`: when it was begun, ms."""
    size = float(np.ptp(points, axis=0).max())
    mask = without_doubles(points, size) if size > 0 else np.zeros(1, bool)
    if mask.sum() < 2:
        return None
    width = np.broadcast_to(np.asarray(width, float), len(points))[mask].copy()
    return Line(row, stroke_id, np.ascontiguousarray(points[mask]), width, begun)
