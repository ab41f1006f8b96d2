"""What does every stroke grow from? One minimum spanning arborescence over strokes and the ground.

An attachment's cost depends on which end of the parent is its foot, and that on the parent's own attachment. So
the arborescence is solved first with the kinder of both, then again with the directions it gave, until nothing
changes; the cheapest consistent tree of all rounds is kept. The ground may feed every stroke:

    cost of standing on the ground   4 + 50 |y − y_ground| / H + (1 − up) / 2     for strokes that rise from the ground
                                     the same with 100 (y − y_lowest) / H, + FORBIDDEN   for all others

    up   cosine between the stroke leaving that end and the vertical

First only one stroke may stand on the ground (all are forbidden alike): its foot is y_ground. Then others may join it.
"""

from dataclasses import dataclass

import numpy as np
import shapely
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.sketch.joining.arborescence import arborescence
from sketchtree.sketch.joining.candidates import MANY, REACH, Arcs, bridging_arcs, candidate_arcs
from sketchtree.sketch.joining.lines import Line, extent, unit

FORBIDDEN = 1e4  # dearer than any tree of sensible attachments
GROUND = 0.04  # of H: a foot this near to the ground's height may stand on it
ROUNDS, FEWER = (2, 4), (1, 2)  # at most, for the stem and for the rest; fewer in a drawing of more than MANY


@dataclass(frozen=True, eq=False)
class Hanging:
    """How every line hangs: by which end, on which line, where."""

    parent: Int[np.ndarray, " line"]  # NULL: it stands on the ground
    end: Int[np.ndarray, " line"]  # its foot: 0 first, 1 last point
    s: Float[np.ndarray, " line"]  # length along the parent, from the parent's foot
    gap: Float[np.ndarray, " line"]  # sketch units
    cost: Float[np.ndarray, " line"]
    alternatives: tuple[tuple[tuple[int, float], ...], ...]  # next best (line, cost)


def attach(lines: list[Line]) -> Hanging:
    """The least costly rooted tree (or several) over the lines."""
    height = extent(lines)
    rounds = ROUNDS if len(lines) <= MANY else FEWER
    arcs = candidate_arcs(lines, height)
    rising, foot_y = _rising(lines, height)
    lowest = float(foot_y.min())
    alone = 100 * (foot_y - lowest) / height + 0.5 * (1 - rising) + _smallness(lines)[:, None]
    solution = _solve(lines, arcs, alone + FORBIDDEN, rounds[0])
    stem = int(np.argmin(np.where(solution.parent == NULL, solution.cost, np.inf)))
    ground = foot_y[stem, solution.end[stem]]
    standing = 4 + 50 * np.abs(foot_y - ground) / height + 0.5 * (1 - rising)
    allowed = (np.abs(foot_y - ground) <= GROUND * height) & (rising > 0.2)
    standing = np.where(allowed, standing, alone + FORBIDDEN)
    hanging = _solve(lines, arcs, standing, rounds[1], first=solution.end)
    for _ in range(len(lines)):
        group = _floating(hanging)
        if group is None:
            break
        arcs = arcs.joined(bridging_arcs(lines, group, height))
        hanging = _solve(lines, arcs, standing, 2, first=hanging.end)
    return hanging


def _floating(hanging: Hanging) -> Bool[np.ndarray, " line"] | None:
    """The lines that hang on a stroke in mid-air because only each other are near; None if there are none."""
    stems = np.flatnonzero(hanging.parent == NULL)
    stems = stems[np.argsort(hanging.cost[stems], kind="stable")]
    aloft = stems[1:][hanging.cost[stems[1:]] >= FORBIDDEN]
    if len(aloft) == 0:
        return None
    top = np.arange(len(hanging.parent))
    while (hanging.parent[top] != NULL).any():
        top = np.where(hanging.parent[top] != NULL, hanging.parent[top], top)
    return top == aloft[-1]


def _solve(lines: list[Line], arcs: Arcs, standing: Float[np.ndarray, "line 2"], rounds: int, first=None) -> Hanging:
    count = len(lines)
    tail = np.r_[arcs.parent, np.full(2 * count, count)]
    head = np.r_[arcs.child, np.repeat(np.arange(count), 2)]
    end = np.r_[arcs.end, np.tile([0, 1], count)]
    both = np.concatenate([arcs.cost, np.repeat(standing.reshape(-1, 1), 2, 1)])
    cost = both.min(1) if first is None else both[np.arange(len(both)), np.r_[first, 0][tail]]
    best, least = None, np.inf
    for _ in range(rounds):
        chosen = arborescence(tail, head, cost, count + 1, count)[:count]
        foot = end[chosen]
        cost = both[np.arange(len(both)), np.r_[foot, 0][tail]]
        total = float(cost[chosen].sum())
        if total >= least - 1e-9:
            break
        best, least = (chosen, foot, cost), total
    return _hanging(lines, arcs, tail, head, *best)


def _hanging(lines, arcs: Arcs, tail, head, chosen, foot, cost) -> Hanging:
    count = len(lines)
    parent = np.where(tail[chosen] == count, NULL, tail[chosen])
    length = np.array([line.length for line in lines])
    s, gap = (np.r_[column, np.zeros(2 * count)][chosen] for column in (arcs.s, arcs.gap))
    turned = (parent != NULL) & (foot[parent] == 1)
    s = np.where(turned, length[parent] - s, s)
    return Hanging(parent, foot, s, gap, cost[chosen], _alternatives(tail, head, cost, chosen, count))


def _alternatives(tail, head, cost, chosen, count: int) -> tuple:
    """The two next best parents of every line, with what they would cost."""
    order = np.lexsort((cost, head))
    order = order[tail[order] < count]
    bounds = np.searchsorted(head[order], np.arange(count + 1))
    rows = []
    for line in range(count):
        best: dict[int, float] = {}
        for arc in order[bounds[line] : bounds[line + 1]]:
            if tail[arc] != tail[chosen[line]] and tail[arc] not in best:
                best[int(tail[arc])] = float(cost[arc])
            if len(best) == 2:
                break
        rows.append(tuple(best.items()))
    return tuple(rows)


def _rising(lines: list[Line], height: float) -> tuple[Float[np.ndarray, "line 2"], Float[np.ndarray, "line 2"]]:
    """(cosine with the vertical of each line leaving each end, height of that end)."""
    shapes, length = np.array([line.shape for line in lines], object), np.array([line.length for line in lines])
    reach = np.minimum(2 * REACH * height, 0.5 * length)
    inner = [shapely.get_coordinates(shapely.line_interpolate_point(shapes, s)) for s in (reach, length - reach)]
    first = inner[0] - [line.points[0] for line in lines]
    last = inner[1] - [line.points[-1] for line in lines]
    y = np.array([[line.points[0, 1], line.points[-1, 1]] for line in lines])
    return np.stack([unit(first)[:, 1], unit(last)[:, 1]], 1), y


def _smallness(lines: list[Line]) -> Float[np.ndarray, " line"]:
    """0 for the longest line, towards 2 for the shortest: a trunk is seldom the smallest stroke."""
    length = np.array([line.length for line in lines])
    return 2 * (1 - length / length.max())
