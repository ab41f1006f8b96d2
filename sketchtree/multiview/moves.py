"""Which of two suggestions does every pixel take, when neighbours would rather be at like depths? A fusion move (Lempitsky et al. 2010): the best of all mixtures
of two depth maps, by one cut.

    E(β) = Σ_p U_p(β_p) + Σ_pq w_pq V(ρ_p(β_p), ρ_q(β_q))        V = min(|Δdisparity|, τ)

Pairs for which V(0,1) + V(1,0) < V(0,0) + V(1,1) can't be told by a cut; their V(0,0) is lowered until it can (Rother et al. 2005), and a move that then does
not lower the energy as it is is not taken. The cut is a greatest flow (OR-tools), with energies in thousandths.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.errors import ViewsError

STEPS = 1000


def truncated(disparity: Float[np.ndarray, " pair"], most: float) -> Float[np.ndarray, " pair"]:
    """V of a difference of disparities, pixels."""
    return np.minimum(np.abs(disparity), most)


def fused(
    unary: Float[np.ndarray, "node 2"], pairs: Int[np.ndarray, "pair 2"], cost: Float[np.ndarray, "pair 2 2"]
) -> tuple[Bool[np.ndarray, " node"], float]:
    """(for every node whether it takes the second suggestion, by how much the energy falls: 0 where all keep the first). `cost[:, i, j]`: of a pair whose nodes take i and j."""
    lowered = cost.copy()
    lowered[:, 0, 0] = np.minimum(cost[:, 0, 0], cost[:, 0, 1] + cost[:, 1, 0] - cost[:, 1, 1])
    a, b, c, d = (lowered[:, i, j] for i in (0, 1) for j in (0, 1))
    gain = unary[:, 1] - unary[:, 0]  # > 0: rather the first
    gain = gain + np.bincount(pairs[:, 0], c - a, len(unary)) + np.bincount(pairs[:, 1], d - c, len(unary))
    takes = _least_cut(gain, pairs, b + c - a - d)
    fall = energy(unary, pairs, cost, np.zeros(len(unary), bool)) - energy(unary, pairs, cost, takes)
    return (takes, fall) if fall > 0 else (np.zeros(len(unary), bool), 0.0)


def energy(unary, pairs, cost, takes: Bool[np.ndarray, " node"]) -> float:
    """The energy of one mixture."""
    side = takes.astype(np.int64)
    return float(unary[np.arange(len(unary)), side].sum() + cost[np.arange(len(pairs)), side[pairs[:, 0]], side[pairs[:, 1]]].sum())


def _least_cut(gain, pairs, weight) -> Bool[np.ndarray, " node"]:
    """True on the sink's side. An arc p → q costs `weight` where p keeps the first and q takes the second."""
    try:
        from ortools.graph.python.max_flow import SimpleMaxFlow
    except ImportError:
        raise ViewsError("Refining depth maps needs the package `ortools`.", remedy="Install it: pip install 'sketchtree[multiview]'.") from None
    whole = np.rint(STEPS * gain).astype(np.int64)
    weight = np.maximum(np.rint(STEPS * weight), 0).astype(np.int64)
    source, sink = len(gain), len(gain) + 1
    keeps, gives, linked = np.flatnonzero(whole > 0), np.flatnonzero(whole < 0), weight > 0
    tail = np.concatenate([np.full(len(keeps), source), gives, pairs[linked, 0]]).astype(np.int32)
    head = np.concatenate([keeps, np.full(len(gives), sink), pairs[linked, 1]]).astype(np.int32)
    solver, side = SimpleMaxFlow(), np.zeros(len(gain) + 2, bool)
    solver.add_arcs_with_capacity(tail, head, np.concatenate([whole[keeps], -whole[gives], weight[linked]]))
    if not len(gives):
        return np.zeros(len(gain), bool)
    if not len(keeps):
        return np.ones(len(gain), bool)
    status = solver.solve(source, sink)
    assert status == solver.OPTIMAL, f"the greatest flow was not found ({status})"
    side[solver.get_source_side_min_cut()] = True
    return ~side[: len(gain)]
