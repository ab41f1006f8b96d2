"""Which strokes could each stroke grow from? Every end of a stroke is tried on the strokes nearest to it."""

import math
from dataclasses import dataclass, fields

import numpy as np
import shapely
from jaxtyping import Bool, Float, Int

from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.evidence import Places, evidence, first_slip
from sketchtree.sketch.joining.likelihood import arc_costs, slip_costs
from sketchtree.sketch.joining.lines import Line

NEAREST = 16  # strokes tried for every end, half as many in a drawing of more than MANY
MANY = 1000
FEW = 200  # up to so many strokes they are looked for farther off at once
LIKELY = 16  # arcs kept of every line
TOUCHES = 0.001  # of H: up to eight times as many are tried where they are as near as this
FOOT = 0.006  # of H: nearer to an end than this is at the end


@dataclass(frozen=True, eq=False)
class Arcs:
    """Every attachment that is considered: line `child` by its `end` (0 first, 1 last point) on `parent` at `s`."""

    child: Int[np.ndarray, " arc"]
    end: Int[np.ndarray, " arc"]
    parent: Int[np.ndarray, " arc"]
    s: Float[np.ndarray, " arc"]  # length along the parent as drawn
    gap: Float[np.ndarray, " arc"]  # distance, sketch units
    miss: Float[np.ndarray, " arc"]  # how far the end is from where it should be, part of H
    base: Float[np.ndarray, "arc 2"]  # cost but for the slip; column: the parent's foot is its first (0) or last (1) point

    def cost(self, slip: float) -> Float[np.ndarray, "arc 2"]:
        """The cost for a hand that keeps to `slip`, ε, part of H."""
        return self.base + slip_costs(self.miss, slip)

    def joined(self, other: "Arcs") -> "Arcs":
        """These and the others."""
        return Arcs(*(np.concatenate([getattr(self, f.name), getattr(other, f.name)]) for f in fields(self)))


def candidate_arcs(bundle: Bundle, root: Float[np.ndarray, " 2"]) -> tuple[Arcs, float]:
    """(the attachments of every end to the lines nearest to it, a first ε). `root` is the likeliest stem's foot."""
    places = nearest_places(bundle)
    slip = first_slip(bundle, places)
    return _likeliest(_costed(bundle, places, root), slip), slip


def _likeliest(arcs: Arcs, slip: float) -> Arcs:
    """The LIKELY cheapest arcs of every line; dearer ones are in no sensible tree."""
    order = np.lexsort((arcs.cost(slip).min(1), arcs.child))
    rank = np.arange(len(order)) - np.searchsorted(arcs.child[order], arcs.child[order])
    kept = np.sort(order[rank < LIKELY])
    return Arcs(*(getattr(arcs, f.name)[kept] for f in fields(arcs)))


def nearest_places(bundle: Bundle) -> Places:
    """Where every end could be attached: on the lines nearest to it."""
    row, parent, gap = _near(bundle)
    return _places(bundle, row, parent, gap)


def bridging_arcs(bundle: Bundle, inside: Bool[np.ndarray, " line"], root: Float[np.ndarray, " 2"]) -> Arcs:
    """The attachments of every end of the lines `inside` a group to the nearest lines outside it."""
    rows = np.flatnonzero(np.repeat(inside, 2))
    outside = np.flatnonzero(~inside)
    tree = shapely.STRtree(bundle.shapes[outside])
    (row, parent), gap = tree.query_nearest(bundle.end_shapes[rows], return_distance=True)
    return _costed(bundle, _places(bundle, rows[row], outside[parent], gap), root)


def _places(bundle: Bundle, row, parent, gap) -> Places:
    s = shapely.line_locate_point(bundle.shapes[parent], bundle.end_shapes[row])
    return Places(row // 2, row % 2, parent, s, gap)


def _costed(bundle: Bundle, places: Places, root) -> Arcs:
    figures = evidence(bundle, places, root)
    return Arcs(places.child, places.end, places.parent, places.s, places.gap, figures["miss"][:, 0], arc_costs(figures))


def foot_reach(line: Line, height: float) -> float:
    """Within this length of an end, a point counts as being at that end: in the ink of it, or within little of H."""
    widest = float(np.fmax.reduce(line.width))
    return min(max(FOOT * height, widest) if math.isfinite(widest) else FOOT * height, 0.3 * line.length)


def _near(bundle: Bundle):
    """(end, line, distance) of the nearest other lines of every end, nearest first."""
    count = len(bundle)
    tree = shapely.STRtree(bundle.shapes)
    wanted = min(NEAREST if count <= MANY else NEAREST // 2, count - 1)
    pending, radius, found = np.arange(2 * count), (0.3 if count > FEW else 2.5) * bundle.height / np.sqrt(100 + count), []
    while len(pending) and wanted:
        x, y = bundle.ends[pending].T
        row, line = tree.query(shapely.box(x - radius, y - radius, x + radius, y + radius))
        row = pending[row]
        other = row // 2 != line
        row, line = row[other], line[other]
        gap = shapely.distance(bundle.end_shapes[row], bundle.shapes[line])
        enough = np.bincount(row[gap <= radius], minlength=2 * count) >= wanted
        done = enough[row] & (gap <= radius)
        found.append((row[done], line[done], gap[done]))
        pending, radius = pending[~enough[pending]], radius * 2
    if not found:
        return (np.zeros(0, np.int64),) * 2 + (np.zeros(0),)
    row, line, gap = (np.concatenate(part) for part in zip(*found, strict=True))
    order = np.lexsort((line, gap, row))
    row, line, gap = row[order], line[order], gap[order]
    rank = np.arange(len(row)) - np.searchsorted(row, row)
    kept = (rank < wanted) | ((rank < 8 * wanted) & (gap <= TOUCHES * bundle.height))
    return row[kept], line[kept], gap[kept]
