"""Which of two labels has each pixel, when a pixel has its own preference and neighbours would rather agree?

Tan et al. 2008, §2, with Kolmogorov & Zabih 2002: the labels β of least energy

    E(β) = Σ_x E_d(β_x) + Σ_(x,y) w_xy [β_x ≠ β_y]        (x, y): neighbours above, below, left, right

are a least cut of a graph, found as a greatest flow: from a source through the pixels that would rather be 0, along the links, to a sink behind those that would rather be 1.
Capacities are whole numbers, energies times STEPS; to that the answer is exact. `greatest_flow` is the only place that knows the solver.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.errors import OptionError

STEPS = 1000  # capacities in one unit of energy
_MOST = 1e6  # a preference of more energy than this is certain


class Links(NamedTuple):
    """Pairs of nodes, and what it costs that they differ."""

    first: Int[np.ndarray, " link"]
    second: Int[np.ndarray, " link"]
    weight: Float[np.ndarray, " link"]  # 0 or more


def grid_links(
    across: Float[np.ndarray, "row column_less_1"], down: Float[np.ndarray, "row_less_1 column"], region: Bool[np.ndarray, "row column"]
) -> Links:
    """Links between the 4-neighbours of a region, whose pixels are numbered row by row. `across`: between a pixel and its right neighbour; `down`: the one below."""
    number = np.cumsum(region.ravel()).reshape(region.shape) - 1
    right, below = region[:, :-1] & region[:, 1:], region[:-1] & region[1:]
    return Links(
        np.concatenate([number[:, :-1][right], number[:-1][below]]),
        np.concatenate([number[:, 1:][right], number[1:][below]]),
        np.concatenate([across[right], down[below]]),
    )


def least_energy(zero: Float[np.ndarray, " node"], one: Float[np.ndarray, " node"], links: Links) -> Bool[np.ndarray, " node"]:
    """The labels of least energy (True: 1), given what either label costs each node. Of equal ones, that with the fewest zeros."""
    gain = np.rint(STEPS * np.clip(np.asarray(one) - zero, -_MOST, _MOST)).astype(np.int64)  # > 0: rather 0
    weight = np.rint(STEPS * np.clip(links.weight, 0, _MOST)).astype(np.int64)
    source, sink = len(gain), len(gain) + 1
    high, low, kept = np.flatnonzero(gain > 0), np.flatnonzero(gain < 0), weight > 0
    first, second, weight = np.asarray(links.first)[kept], np.asarray(links.second)[kept], weight[kept]
    tail = np.concatenate([np.full(len(high), source), low, first, second])
    head = np.concatenate([high, np.full(len(low), sink), second, first])
    return ~greatest_flow(tail, head, np.concatenate([gain[high], -gain[low], weight, weight]), source, sink)[: len(gain)]


def greatest_flow(
    tail: Int[np.ndarray, " arc"], head: Int[np.ndarray, " arc"], capacity: Int[np.ndarray, " arc"], source: int, sink: int
) -> Bool[np.ndarray, " node"]:
    """The nodes on the source's side of a least cut (the smallest such set): OR-tools' push-relabel."""
    solver = _solver()()
    solver.add_arcs_with_capacity(tail.astype(np.int32), head.astype(np.int32), capacity)
    side = np.zeros(max(source, sink) + 1, bool)
    side[source] = True
    if solver.num_arcs() and solver.num_nodes() > max(source, sink):
        status = solver.solve(source, sink)
        assert status == solver.OPTIMAL, f"the greatest flow was not found ({status})"
        side[solver.get_source_side_min_cut()] = True
    elif solver.num_arcs():  # nothing leads to the sink
        side[head] = True
    return side


def _solver():
    try:
        from ortools.graph.python.max_flow import SimpleMaxFlow
    except ImportError:
        raise OptionError(
            "Finding foliage in a photo needs the package `ortools`.", remedy="Install it with pip install 'sketchtree[photo]'."
        ) from None
    return SimpleMaxFlow
