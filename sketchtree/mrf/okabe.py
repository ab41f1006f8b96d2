"""How do branches lie if each takes as much room as it can?

After Okabe, Owada & Igarashi 2005, "Interactive design of botanical trees using freehand sketches and example-based
editing", as Chen et al. 2008, §2 tell it: the 3D pattern is found greedily, by making the distances between branches as
large as possible within the crown's hull of revolution. The details are ours:

    z_j* = argmax_z  Σ_a Σ_b |q_ja(z) − q_b|        z_j ∈ [−Z_j, Z_j]
    Z_j  = 1.05 b √(1 − (dx / 1.05 a)²)             b = (a_left + a_right) / 2

    z_j    depth of limb j's tip; along the limb it grows with the length on the page
    q_ja   points of limb j at a quarter, a half, three quarters and the whole of its length
    q_b    the same points of every limb placed so far, and twenty of every stem
    a      how far the crown reaches from the trunk at the tip's height, on the tip's own side
    dx     the tip's distance from the trunk on the page

Limbs are placed order by order, the longest on the page first. A crown that is wider on one side turns smoothly
into the other, so its depth half way round is the mean b. No limb is steeper than 70°. A step places one order.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.axes import NULL
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.solver import AbstractSolver, Info
from sketchtree.traverse import limb_chains

_ALONG = np.array([0.25, 0.5, 0.75, 1.0])  # where on a limb distances are measured
_STEM_POINTS = 20
_BLOCK = 4096  # points compared at once


class State(NamedTuple):
    """Only what the next step needs."""

    depth: Float[np.ndarray, " segment"]
    placed: Float[np.ndarray, "point 3"]  # what the next limbs keep away from
    order: int  # that is placed next
    moved: float


class Okabe(AbstractSolver):
    """Greedy: every limb as far from all others as the crown allows."""

    candidates: int = 41  # depths tried for each limb, 2 or more
    margin: float = 1.05  # hull of revolution / hull of the drawn limbs, 1 or more
    steepest: float = float(np.radians(70.0))  # radians, below π/2

    name = "okabe"
    default_steps = 10_000  # more orders than any drawing has

    def answer(self, graph: FactorGraph) -> Float[np.ndarray, " segment"]:
        """The depths after the last order, H = 1. Nothing is drawn at random and no prior is asked."""
        state = self._start(graph)
        while not self.terminate(graph, Prior(), state):
            state, _ = self._placed(graph, state)
        return state.depth

    def init(self, graph: FactorGraph, prior: Prior, key: Key[Array, ""]) -> State:
        return self._start(graph)

    def step(self, graph: FactorGraph, prior: Prior, state: State, key: Key[Array, ""]) -> tuple[State, Info]:
        return self._placed(graph, state)

    def _start(self, graph: FactorGraph) -> State:
        depth = np.zeros(len(graph))
        stems = np.flatnonzero(graph.limb_parent == NULL)
        chains = _chains(graph)
        along = np.linspace(0.2, 1.0, _STEM_POINTS)
        points = [_points(graph, chains[stem], depth[chains[stem]], along) for stem in stems]
        return State(depth, np.concatenate([np.zeros((0, 3)), *points]), 1, np.inf)

    def _placed(self, graph: FactorGraph, state: State) -> tuple[State, Info]:
        depth, placed = np.array(state.depth), [state.placed]
        chains, half_depth = _chains(graph), self._half_depth(graph)
        limbs = np.flatnonzero(graph.limb_order == state.order)
        for limb in limbs[np.argsort(-graph.limb_length[limbs], kind="stable")]:
            chain = chains[limb]
            share = _share(graph, chain)
            start = depth[graph.parent[chain[0]]]
            steep = graph.limb_length[limb] * np.tan(self.steepest)
            low, high = np.clip(np.array([-1, 1]) * half_depth[limb] - start, -steep, steep)
            rise = np.linspace(low, high, self.candidates)
            flat = np.array([np.interp(_ALONG, share, line) for line in _line(graph, chain).T]).T
            flat = np.broadcast_to(flat, (len(rise), *flat.shape))
            q = np.concatenate([flat, (start + rise[:, None] * _ALONG)[..., None]], axis=-1)
            best = int(np.argmax(_total_distance(q, np.concatenate(placed))))
            depth[chain] = start + rise[best] * share[1:]
            placed.append(q[best])
        moved = float(np.abs(depth - state.depth).sum())
        return State(depth, np.concatenate(placed), state.order + 1, moved), Info(np.nan, moved)

    def terminate(self, graph: FactorGraph, prior: Prior, state: State) -> bool:
        return state.order > graph.limb_order.max(initial=0)

    def depth(self, graph: FactorGraph, state: State) -> Float[np.ndarray, " segment"]:
        return state.depth

    def _half_depth(self, graph: FactorGraph) -> Float[np.ndarray, " limb"]:
        """Z of every limb's tip: how far the hull of revolution reaches in front of the page there."""
        tip = graph.limb_tip
        left, right = _reaches(graph)
        aside = graph.xy[tip, 0] - graph.trunk_x
        own = self.margin * np.where(aside >= 0, right, left)
        inside = 1 - (aside / np.maximum(own, 1e-9)) ** 2
        return self.margin * (left + right) / 2 * np.sqrt(np.maximum(inside, 0.0))


def _reaches(graph: FactorGraph):
    """How far the crown reaches left and right of the trunk at the height of every limb's tip, 0 or more."""
    y, tree = graph.xy[graph.limb_tip, 1], graph.tree[graph.limb_tip]
    low, high = np.full(len(y), np.inf), np.full(len(y), -np.inf)
    for k, crowns in enumerate(graph.outline.crowns):
        at = np.flatnonzero(tree == k)
        for a, b in ((crown, np.roll(crown, -1, axis=0)) for crown in crowns):
            below, above = np.minimum(a[:, 1], b[:, 1])[:, None], np.maximum(a[:, 1], b[:, 1])[:, None]
            crosses = (below <= y[at]) & (y[at] <= above)
            rise = np.where(a[:, 1] == b[:, 1], 1.0, b[:, 1] - a[:, 1])[:, None]
            x = a[:, 0, None] + np.clip((y[at] - a[:, 1, None]) / rise, 0, 1) * (b[:, 0] - a[:, 0])[:, None]
            low[at] = np.minimum(low[at], np.where(crosses, x, np.inf).min(axis=0))
            high[at] = np.maximum(high[at], np.where(crosses, x, -np.inf).max(axis=0))
    met = low <= high
    return (np.where(met, np.maximum(side, 0.0), 0.0) for side in (graph.trunk_x - low, high - graph.trunk_x))


def _total_distance(q, others) -> Float[np.ndarray, " candidate"]:
    """Σ_a Σ_b |q_a − q_b| of every candidate."""
    total = np.zeros(len(q))
    for first in range(0, len(others), _BLOCK):
        gap = q[:, :, None] - others[first : first + _BLOCK]
        total += np.sqrt(np.einsum("kabx,kabx->kab", gap, gap)).sum(axis=(1, 2))
    return total


def _chains(graph: FactorGraph):
    """The rows of every limb, its base left out."""
    chains = {int(graph.limb[rows[0]]): rows[~graph.is_base[rows]] for rows in limb_chains(graph.parent, graph.limb)}
    return [chains[limb] for limb in range(graph.limb_count)]


def _line(graph: FactorGraph, chain):
    """The limb on the page, its junction first."""
    return graph.xy[np.r_[graph.parent[chain[0]], chain]]


def _share(graph: FactorGraph, chain):
    """Length on the page from the junction to every node, over the whole."""
    along = np.cumsum(graph.length[chain])
    return np.r_[0.0, along / along[-1]]


def _points(graph: FactorGraph, chain, depth, along):
    share, line = _share(graph, chain), np.c_[_line(graph, chain), np.r_[0.0, depth]]
    return np.stack([np.interp(along, share, column) for column in line.T], axis=1)
