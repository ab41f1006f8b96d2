"""Which strokes could each stroke grow from, and what would that cost?

Every end of a stroke is tried on the strokes nearest to it. The cost of growing from stroke j at the point q, by the
end p of stroke i, is a sum of how unlike a branch that would be (ours; weights found on drawings of our own):

    gap         2 log(1 + ½ g²)               g = |p − q| / ε; within the half width of j a third of it counts
    angle       2 (φ − 95°)₊ / 100°          φ between i leaving p and j going on from q; half of it at j's ends
    end         ¼ (1 + Δy / |i|)              Δy from the other end up to p: branches rise more often than they fall
    width       1.5 (log(w_i / w_j) + 0.2)₊   a branch is thinner than its parent
    length      0.2 (log(|i| / |j|))₊         nor often longer
    foot        ½ exp(−|q| / 0.015 H)         |q| from the foot of j to q: near it, i is more likely its sibling

    H   height of the drawing     w   drawn width, where it says something
    ε   5 × the middle gap between an end and the nearest stroke, not below 0.1 % nor above 1 % of H

The direction of j depends on which of its ends is its foot, so the cost has a column for either.
"""

from dataclasses import dataclass, fields

import numpy as np
import shapely
from jaxtyping import Bool, Float, Int

from sketchtree.sketch.joining.lines import Line, angle_between, unit

NEAREST = 16  # strokes tried for every end, half as many in a drawing of more than MANY
MANY = 1000
REACH = 0.03  # over how much of H a direction is taken
PRECISE, COARSE = 0.001, 0.01  # of H: bounds of ε
GAP, TURN, STRAIGHT, RISE, LENGTH = 2.0, 2.0, 95.0, 0.25, 0.2  # weights of the costs above; degrees
AT_FOOT, FOOT_REACH = 0.5, 0.015  # how dear, and within how much of H, it is to grow from near a foot
FOOT = 0.006  # of H: nearer to an end than this is at the end


@dataclass(frozen=True, eq=False)
class Arcs:
    """Every attachment that is considered: line `child` by its `end` (0 first, 1 last point) on `parent` at `s`."""

    child: Int[np.ndarray, " arc"]
    end: Int[np.ndarray, " arc"]
    parent: Int[np.ndarray, " arc"]
    s: Float[np.ndarray, " arc"]  # length along the parent as drawn
    gap: Float[np.ndarray, " arc"]  # distance, sketch units
    cost: Float[np.ndarray, "arc 2"]  # column: the parent's foot is its first (0) or last (1) point

    def joined(self, other: "Arcs") -> "Arcs":
        """These and the others."""
        return Arcs(*(np.concatenate([getattr(self, f.name), getattr(other, f.name)]) for f in fields(self)))


def candidate_arcs(lines: list[Line], height: float) -> Arcs:
    """The attachments of every end to the strokes nearest to it. `height` is H."""
    shapes = np.array([line.shape for line in lines], object)
    ends = np.array([line.points[k] for line in lines for k in (0, -1)])
    return _arcs(lines, shapes, ends, *_near(ends, shapes, height), height)


def bridging_arcs(lines: list[Line], inside: Bool[np.ndarray, " line"], height: float) -> Arcs:
    """The attachments of every end of the lines `inside` a group to the nearest lines outside it."""
    shapes = np.array([line.shape for line in lines], object)
    ends = np.array([line.points[k] for line in lines for k in (0, -1)])
    rows = np.flatnonzero(np.repeat(inside, 2))
    outside = np.flatnonzero(~inside)
    (row, parent), gap = shapely.STRtree(shapes[outside]).query_nearest(shapely.points(ends[rows]), return_distance=True)
    return _arcs(lines, shapes, ends, rows[row], outside[parent], gap, height)


def _arcs(lines, shapes, ends, row, parent, gap, height: float) -> Arcs:
    child, end = row // 2, row % 2
    s = shapely.line_locate_point(shapes[parent], shapely.points(ends[row]))
    return Arcs(child, end, parent, s, gap, _costs(lines, shapes, ends, child, end, parent, s, gap, height))


def foot_reach(line: Line, height: float) -> float:
    """Within this length of an end, a point counts as being at that end: in the ink of it, or within little of H."""
    width = np.nanmax(line.width) if np.isfinite(line.width).any() else 0.0
    return float(min(max(FOOT * height, width), 0.3 * line.length))


def _near(ends, shapes, height: float):
    """(end, line, distance) of the nearest other lines of every end, nearest first."""
    tree = shapely.STRtree(shapes)
    wanted = min(NEAREST if len(shapes) <= MANY else NEAREST // 2, len(shapes) - 1)
    points = shapely.points(ends)
    pending, radius, found = np.arange(len(ends)), 0.3 * height / np.sqrt(100 + len(shapes)), []
    while len(pending) and wanted:
        row, line = tree.query(points[pending], predicate="dwithin", distance=radius)
        row = pending[row]
        other = row // 2 != line
        row, line = row[other], line[other]
        enough = np.bincount(row, minlength=len(ends)) >= wanted
        done = enough[row]
        found.append((row[done], line[done]))
        pending, radius = pending[~enough[pending]], radius * 2
    if not found:
        return (np.zeros(0, np.int64),) * 2 + (np.zeros(0),)
    row, line = (np.concatenate(part) for part in zip(*found, strict=True))
    gap = shapely.distance(points[row], shapes[line])
    order = np.lexsort((line, gap, row))
    row, line, gap = row[order], line[order], gap[order]
    rank = np.arange(len(row)) - np.searchsorted(row, row)
    kept = (rank < wanted) | ((rank < 8 * wanted) & (gap <= PRECISE * height))
    return row[kept], line[kept], gap[kept]


def _costs(lines, shapes, ends, child, end, parent, s, gap, height: float) -> Float[np.ndarray, "arc 2"]:
    length = np.array([line.length for line in lines])
    width = np.array([typical_width(line) for line in lines])
    reach = np.minimum(REACH * height, 0.4 * length)
    leaving = _leaving(shapes, ends, length, reach)[2 * child + end]
    forward = _forward(shapes[parent], s, length[parent], reach[parent])
    foot = np.array([foot_reach(line, height) for line in lines])[parent]
    inside = np.minimum(gap, 0.5 * np.nan_to_num(width[parent]))
    excess = (gap - 0.65 * inside) / _precision(gap, child, len(lines), height)
    other = ends[2 * child + 1 - end]
    rise = (ends[2 * child + end, 1] - other[:, 1]) / length[child]
    with np.errstate(invalid="ignore"):
        thicker = np.nan_to_num(np.maximum(np.log(width[child] / width[parent]) + 0.2, 0.0))
    longer = np.maximum(np.log(length[child] / length[parent]), 0.0)
    shared = GAP * np.log1p(0.5 * excess**2) + LENGTH * longer + RISE * (1 + np.clip(rise, -1, 1)) + 1.5 * thicker
    columns = []
    for sign, from_foot in ((1.0, s), (-1.0, length[parent] - s)):
        diverging = np.degrees(angle_between(leaving, sign * forward))
        at_end = np.minimum(from_foot, length[parent] - from_foot) < foot
        angle = np.where(at_end, 0.5, 1.0) * TURN * np.maximum(diverging - STRAIGHT, 0) / 100
        columns.append(shared + angle + AT_FOOT * np.exp(-from_foot / (FOOT_REACH * height)))
    return np.stack(columns, 1)


def _precision(gap, child, count: int, height: float) -> float:
    """ε: how exactly this hand starts its strokes on others."""
    nearest = np.full(count, np.inf)
    np.minimum.at(nearest, child, gap)
    return float(np.clip(5 * np.median(nearest), PRECISE * height, COARSE * height))


def typical_width(line: Line) -> float:
    """The middle one of a line's widths; NaN if they say nothing."""
    return float(np.nanmedian(line.width)) if np.isfinite(line.width).any() else np.nan


def _leaving(shapes, ends, length, reach) -> Float[np.ndarray, "end 2"]:
    """Direction of every line as it leaves each of its ends."""
    double = np.repeat(shapes, 2)
    at = np.stack([reach, length - reach], 1).ravel()
    return unit(shapely.get_coordinates(shapely.line_interpolate_point(double, at)) - ends)


def _forward(shapes, s, length, reach) -> Float[np.ndarray, "arc 2"]:
    """Direction of the parents at s, in the order of drawing."""
    ahead = shapely.line_interpolate_point(shapes, np.minimum(s + reach, length))
    behind = shapely.line_interpolate_point(shapes, np.maximum(s - reach, 0.0))
    return unit(shapely.get_coordinates(ahead) - shapely.get_coordinates(behind))
