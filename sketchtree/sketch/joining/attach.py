"""What does every stroke grow from? One minimum spanning arborescence over strokes and the ground.

The ground may feed every stroke:

    cost of standing on the ground   STANDING − TOWERS min(2 t, 1) + HANGS exp(−g / ε) + 50 |y − y_ground| / H + (1 − up) / 2 + taper
                                     for strokes that rise from the ground; FORBIDDEN + 100 (y − y_lowest) / H + … for others

    t    how far above its foot the stroke's other end is, of H: a low branch that hangs to the ground rises little
    g    how far that other end is from any line: there it may hang; ε see `evidence`
    taper   what it costs to stand on the thinner end (`likelihood`)
    up   cosine between the stroke leaving that end and the vertical

First only one stroke may stand on the ground (all are forbidden alike): its foot is y_ground, and the gaps of that tree
say how exactly the hand starts its strokes. Then others may join it.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.sketch.joining.boughs import heavier_foot
from sketchtree.sketch.joining.bundle import Bundle
from sketchtree.sketch.joining.candidates import MANY, Arcs, bridging_arcs, candidate_arcs
from sketchtree.sketch.joining.choices import Choices, solve
from sketchtree.sketch.joining.evidence import slip_of
from sketchtree.sketch.joining.likelihood import taper_costs
from sketchtree.sketch.joining.lines import Line
from sketchtree.sketch.joining.moves import hangs

ALOFT = 30.0  # how much less the foot of a bough costs than the lowest end
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
    alone = 100 * (foot_y - lowest) / bundle.height + 0.5 * (1 - rising) + _smallness(bundle)[:, None] + _tapering(bundle)
    aloft = heavier_foot(bundle, int(np.argmin(alone)))
    if aloft is not None:
        alone.ravel()[aloft] = alone.min() - ALOFT
    root = bundle.ends[int(np.argmin(alone))]
    arcs, slip = candidate_arcs(bundle, root)
    told(0.5)
    choices = Choices.of(arcs, slip, alone + FORBIDDEN)
    chosen = solve(choices, rounds[0])
    told(0.7)
    stands = choices.tail[chosen] == len(lines)
    slip = slip_of(arcs.gap[chosen[~stands]] / bundle.height)
    stem = int(np.argmin(np.where(stands, choices.cost(choices.end[chosen])[chosen], np.inf)))
    standing = _standing(bundle, arcs, slip, alone, foot_y[stem, choices.end[chosen[stem]]]) if aloft is None else alone + FORBIDDEN
    choices = Choices.of(arcs, slip, standing)
    chosen = solve(choices, rounds[1], choices.end[chosen])
    told(0.9)
    for _ in range(len(lines)):
        group = _floating(choices, chosen)
        if group is None:
            break
        foot = choices.end[chosen]
        arcs = arcs.joined(bridging_arcs(bundle, group, root))
        choices = Choices.of(arcs, slip, standing)
        chosen = solve(choices, 2, foot)
    told(1.0)
    return _hanging(bundle, arcs, choices, chosen)


def _standing(bundle: Bundle, arcs: Arcs, slip: float, alone, ground: float) -> Float[np.ndarray, "line 2"]:
    """What it costs each line to stand on the ground, at height `ground`, by either end."""
    rising, foot_y = _rising(bundle)
    tall = np.clip(2 * (foot_y[:, ::-1] - foot_y) / bundle.height, 0.0, 1.0)
    hung = np.exp(-_nearest(bundle, arcs)[:, ::-1] / (slip * bundle.height))
    standing = STANDING - TOWERS * tall + HANGS * hung + 50 * np.abs(foot_y - ground) / bundle.height + 0.5 * (1 - rising) + _tapering(bundle)
    allowed = (np.abs(foot_y - ground) <= GROUND * bundle.height) & (rising > 0.2)
    return np.where(allowed, standing, alone + FORBIDDEN)


def _floating(choices: Choices, chosen) -> Bool[np.ndarray, " line"] | None:
    """The lines that hang on a stroke in mid-air because only each other are near; None if there are none."""
    above = np.append(choices.tail[chosen], choices.count)
    stems = np.flatnonzero(above[:-1] == choices.count)
    cost = choices.both[chosen[stems], 0]
    stems = stems[np.argsort(cost, kind="stable")]
    if len(stems) < 2 or choices.both[chosen[stems[-1]], 0] < FORBIDDEN:
        return None
    above[stems] = stems
    above[-1] = stems[0]
    for _ in range(len(above).bit_length()):
        above = above[above]
    return above[:-1] == stems[-1]


def _hanging(bundle: Bundle, arcs: Arcs, choices: Choices, chosen) -> Hanging:
    count, length, foot = choices.count, bundle.length, choices.end[chosen]
    parent = np.where(choices.tail[chosen] == count, NULL, choices.tail[chosen])
    s, gap = (np.append(column, np.zeros(2 * count))[chosen] for column in (arcs.s, arcs.gap))
    s = np.where((parent != NULL) & (foot[parent] == 1), length[parent] - s, s)
    cost = choices.cost(foot)
    return Hanging(parent, foot, s, gap, cost[chosen], _alternatives(choices, cost, chosen))


def _alternatives(choices: Choices, cost, chosen) -> tuple[tuple[tuple[int, float], ...], ...]:
    """The two next best parents of every line, with what they would cost; none that hangs on the line itself."""
    above = choices.tail[chosen]
    others = np.flatnonzero((choices.tail < choices.count) & (choices.tail != above[choices.head]))
    order = others[np.lexsort((cost[others], choices.head[others]))]
    rows: list[dict[int, float]] = [{} for _ in range(choices.count)]
    for line, other, price in zip(choices.head[order].tolist(), choices.tail[order].tolist(), cost[order].tolist(), strict=True):
        if len(rows[line]) < 2 and other not in rows[line] and not hangs(other, line, above, choices.count):
            rows[line][other] = price
    return tuple(tuple(row.items()) for row in rows)


def _rising(bundle: Bundle) -> tuple[Float[np.ndarray, "line 2"], Float[np.ndarray, "line 2"]]:
    """(cosine with the vertical of each line leaving each end, height of that end)."""
    reach = np.minimum(RISES * bundle.height, 0.5 * bundle.length)
    return bundle.leaving(reach)[:, 1].reshape(-1, 2), bundle.ends[:, 1].reshape(-1, 2)


def _tapering(bundle: Bundle) -> Float[np.ndarray, "line 2"]:
    """What it costs each line to stand on each end, by its widths."""
    return taper_costs(bundle.thicker_away()).reshape(-1, 2)


def _nearest(bundle: Bundle, arcs: Arcs) -> Float[np.ndarray, "line 2"]:
    """How far each end is from the nearest other line."""
    gap = np.full(2 * len(bundle), np.inf)
    np.minimum.at(gap, 2 * arcs.child + arcs.end, arcs.gap)
    return gap.reshape(-1, 2)


def _smallness(bundle: Bundle) -> Float[np.ndarray, " line"]:
    """0 for the longest line, towards 2 for the shortest: a trunk is seldom the smallest stroke."""
    return 2 * (1 - bundle.length / bundle.length.max())
