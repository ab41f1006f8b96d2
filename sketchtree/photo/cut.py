"""Which of two labels has each pixel, when a pixel has its own preference and neighbours would rather agree?

Tan et al. 2008, §2, with Kolmogorov & Zabih 2002: the labels β of least energy

    E(β) = Σ_x E_d(β_x) + Σ_(x,y) w_xy [β_x ≠ β_y]        (x, y): neighbours above, below, left, right

are a least cut of a graph, found exactly as a greatest flow. Capacities are whole numbers, energies times STEPS; a pixel whose preference outweighs
all its neighbours together has its label at once and is taken out of the graph, which leaves the same least energy.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.errors import OptionError

STEPS = 1000  # capacities in one unit of energy
_MOST = 1e6  # energy above which a preference is as good as certain
_ROUNDS = 12  # in which pixels are taken out


class Links(NamedTuple):
    """What it costs that neighbours differ, of a picture or of a list of nodes."""

    first: Int[np.ndarray, " link"]
    second: Int[np.ndarray, " link"]
    weight: Float[np.ndarray, " link"]  # 0 or more


def grid_links(
    across: Float[np.ndarray, "row column_1"], down: Float[np.ndarray, "row_1 column"], region: Bool[np.ndarray, "row column"]
) -> tuple[Links, Int[np.ndarray, "row column"]]:
    """Links between 4-neighbours within a region, and the node number of each of its pixels (-1 elsewhere). `across`: between a pixel and its right neighbour."""
    number = np.full(region.shape, -1, np.int64)
    number[region] = np.arange(region.sum())
    right, below = region[:, :-1] & region[:, 1:], region[:-1] & region[1:]
    return Links(
        np.concatenate([number[:, :-1][right], number[:-1][below]]),
        np.concatenate([number[:, 1:][right], number[1:][below]]),
        np.concatenate([across[right], down[below]]),
    ), number


def least_energy(zero: Float[np.ndarray, " node"], one: Float[np.ndarray, " node"], links: Links) -> Bool[np.ndarray, " node"]:
    """The labels of least energy (True: 1), given the cost of either label for each node. Of equal ones, that with the most zeros."""
    gain = np.clip(np.rint(STEPS * np.clip(one - zero, -_MOST, _MOST)), -_MOST * STEPS, _MOST * STEPS).astype(np.int64)  # > 0: rather 0
    weight = np.rint(STEPS * np.asarray(links.weight)).astype(np.int64)
    kept = weight > 0
    return _reduced(gain, links.first[kept], links.second[kept], weight[kept])


def _reduced(gain, first, second, weight) -> Bool[np.ndarray, " node"]:
    """Settle what is certain, round by round; cut the rest."""
    label = np.full(len(gain), -1, np.int8)
    nodes = len(gain)
    for _ in range(_ROUNDS):
        hold = np.bincount(first, weight, nodes) + np.bincount(second, weight, nodes)
        settled = (label < 0) & (np.abs(gain) >= hold) & ((gain != 0) | (hold == 0))
        if settled.sum() * 50 < (label < 0).sum() or not settled.any():
            break
        label[settled] = gain[settled] < 0
        for near, far in ((first, second), (second, first)):
            pull = settled[near] & (label[far] < 0)
            gain = gain + np.bincount(far[pull], np.where(label[near[pull]] == 0, 1, -1) * weight[pull], nodes).astype(np.int64)
        free = (label[first] < 0) & (label[second] < 0)
        first, second, weight = first[free], second[free], weight[free]
    rest = np.flatnonzero(label < 0)
    if len(rest):
        place = np.full(nodes, -1, np.int64)
        place[rest] = np.arange(len(rest))
        label[rest] = greatest_flow(gain[rest], place[first], place[second], weight)
    return label == 1


def greatest_flow(gain: Int[np.ndarray, " node"], first, second, weight: Int[np.ndarray, " link"]) -> Bool[np.ndarray, " node"]:
    """The nodes that a least cut parts from the source: those with gain > 0 hang on the source, those with gain < 0 on the sink."""
    flow_of = _solver()
    nodes = len(gain)
    source, sink = nodes, nodes + 1
    high, low = np.flatnonzero(gain > 0), np.flatnonzero(gain < 0)
    if not len(high) or not len(low):
        return np.full(nodes, not len(high) and bool(len(low)))
    tail = np.concatenate([np.full(len(high), source), low, first, second])
    head = np.concatenate([high, np.full(len(low), sink), second, first])
    capacity = np.concatenate([gain[high], -gain[low], weight, weight])
    flow = flow_of()
    flow.add_arcs_with_capacity(tail.astype(np.int32), head.astype(np.int32), capacity)
    status = flow.solve(source, sink)
    assert status == flow.OPTIMAL, f"the greatest flow was not found ({status})"
    apart = np.ones(nodes + 2, bool)
    apart[flow.get_source_side_min_cut()] = False
    return apart[:nodes]


def _solver():
    try:
        from ortools.graph.python.max_flow import SimpleMaxFlow
    except ImportError:
        raise OptionError("Finding foliage in a photo needs the package ortools, which is not installed.", remedy="Install it: pip install 'sketchtree[photo]'.") from None
    return SimpleMaxFlow
