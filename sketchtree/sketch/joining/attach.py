"""What does every stroke grow from? One minimum spanning arborescence over strokes and the ground.

An attachment's cost depends on which end of the parent is its foot, and that on the parent's own attachment. So
the arborescence is solved first with the kinder of both, then again with the directions it gave, until nothing
changes; the cheapest consistent tree of all rounds is kept. The ground may feed every stroke:

    cost of standing on the ground   STANDING − TOWERS min(2 t, 1) + HANGS exp(−g / ε) + 50 |y − y_ground| / H + (1 − up) / 2
                                     for strokes that rise from the ground; FORBIDDEN + 100 (y − y_lowest) / H + … for others

    t    how far above its foot the stroke's other end is, of H: a low branch that hangs to the ground rises little
    g    how far that other end is from any line: there it may hang; ε see `evidence`
    up   cosine between the stroke leaving that end and the vertical

First only one stroke may stand on the ground (all are forbidden alike): its foot is y_ground, and the gaps of that tree
say how exactly the hand starts its strokes. Then others may join it.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.sketch.joining.arborescence import arborescence
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.candidates import MANY, Arcs, bridging_arcs, candidate_arcs
from sketchtree.sketch.joining.evidence import slip_of
from sketchtree.sketch.joining.lines import Line

FORBIDDEN = 1e4  # dearer than any tree of sensible attachments
STANDING, TOWERS = 8.0, 5.0  # what a rising stroke pays to stand beside the stem; how much less if it is tall
HANGS = 6.0  # and how much more if its upper end is on another stroke
RISES = 0.06  # over how much of H a stroke's rise from the ground is taken
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


def attach(lines: list[Line], progress: Callable[[float], None] | None = None) -> Hanging:
    """The least costly rooted tree (or several) over the lines. `progress` is told the share done, 0-1."""
    bundle, told = Bundle.of(lines), progress or (lambda done: None)
    rounds = ROUNDS if len(lines) <= MANY else FEWER
    rising, foot_y = _rising(bundle)
    lowest = float(foot_y.min())
    alone = 100 * (foot_y - lowest) / bundle.height + 0.5 * (1 - rising) + _smallness(bundle)[:, None]
    root = bundle.ends[int(np.argmin(alone))]
    arcs, slip = candidate_arcs(bundle, root)
    told(0.5)
    solution = _solve(bundle, arcs, slip, alone + FORBIDDEN, rounds[0])
    slip = slip_of(solution.gap[solution.parent != NULL] / bundle.height)
    told(0.7)
    stem = int(np.argmin(np.where(solution.parent == NULL, solution.cost, np.inf)))
    ground = foot_y[stem, solution.end[stem]]
    tall = np.clip(2 * (foot_y[:, ::-1] - foot_y) / bundle.height, 0.0, 1.0)
    hung = np.exp(-_nearest(bundle, arcs)[:, ::-1] / (slip * bundle.height))
    standing = STANDING - TOWERS * tall + HANGS * hung + 50 * np.abs(foot_y - ground) / bundle.height + 0.5 * (1 - rising)
    allowed = (np.abs(foot_y - ground) <= GROUND * bundle.height) & (rising > 0.2)
    standing = np.where(allowed, standing, alone + FORBIDDEN)
    hanging = _solve(bundle, arcs, slip, standing, rounds[1], first=solution.end)
    told(0.9)
    for _ in range(len(lines)):
        group = _floating(hanging)
        if group is None:
            break
        arcs = arcs.joined(bridging_arcs(bundle, group, root))
        hanging = _solve(bundle, arcs, slip, standing, 2, first=hanging.end)
    told(1.0)
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


def _solve(bundle: Bundle, arcs: Arcs, slip: float, standing: Float[np.ndarray, "line 2"], rounds: int, first=None) -> Hanging:
    count = len(bundle)
    tail = np.r_[arcs.parent, np.full(2 * count, count)]
    head = np.r_[arcs.child, np.repeat(np.arange(count), 2)]
    end = np.r_[arcs.end, np.tile([0, 1], count)]
    both = np.concatenate([arcs.cost(slip), np.repeat(standing.reshape(-1, 1), 2, 1)])
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
    return _hanging(bundle, arcs, tail, head, *best)


def _hanging(bundle: Bundle, arcs: Arcs, tail, head, chosen, foot, cost) -> Hanging:
    count, length = len(bundle), bundle.length
    parent = np.where(tail[chosen] == count, NULL, tail[chosen])
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


def _rising(bundle: Bundle) -> tuple[Float[np.ndarray, "line 2"], Float[np.ndarray, "line 2"]]:
    """(cosine with the vertical of each line leaving each end, height of that end)."""
    reach = np.minimum(RISES * bundle.height, 0.5 * bundle.length)
    return bundle.leaving(reach)[:, 1].reshape(-1, 2), bundle.ends[:, 1].reshape(-1, 2)


def _nearest(bundle: Bundle, arcs: Arcs) -> Float[np.ndarray, "line 2"]:
    """How far each end is from the nearest other line."""
    gap = np.full(2 * len(bundle), np.inf)
    np.minimum.at(gap, 2 * arcs.child + arcs.end, arcs.gap)
    return gap.reshape(-1, 2)


def _smallness(bundle: Bundle) -> Float[np.ndarray, " line"]:
    """0 for the longest line, towards 2 for the shortest: a trunk is seldom the smallest stroke."""
    return 2 * (1 - bundle.length / bundle.length.max())
