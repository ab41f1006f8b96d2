"""What does a tree look like to someone who knows nothing of depth? Two yardsticks.

`Flat` leaves the drawing on the page. `RandomSign` gives every lateral the divergence of 50° from its parent
that the paper's trees show on average and tosses a coin for the side:

    cos 50° = cos ψ (e · d_xy) + sin ψ d_z   ⇒   ψ = atan2(d_z, e · d_xy) ± arccos(cos 50° / R),   R = |(e · d_xy, d_z)|

    ψ   elevation of the lateral's first segment      e   its unit direction on the page
    d   unit direction of its parent in space

Where no ψ reaches 50° the nearest angle is taken; |ψ| is at most 60°. The rest of the limb keeps the elevation of its
start.
"""

from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.axes import NULL
from sketchtree.keys import uniform
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.solver import AbstractSolver, Info

_STEEPEST = np.radians(60.0)


class State(NamedTuple):
    """Depths that need no further step."""

    depth: Float[np.ndarray, " segment"]


class Flat(AbstractSolver):
    """z = 0: the tree stays on the page."""

    name = "flat"
    default_steps = 1

    def init(self, graph: FactorGraph, prior: Prior, key: Key[Array, ""]) -> State:
        return State(np.zeros(len(graph)))

    def step(self, graph: FactorGraph, prior: Prior, state: State, key: Key[Array, ""]) -> tuple[State, Any]:
        return state, Info(np.nan, 0.0)

    def terminate(self, graph: FactorGraph, prior: Prior, state: State) -> bool:
        return True

    def depth(self, graph: FactorGraph, state: State) -> Float[np.ndarray, " segment"]:
        return state.depth


class RandomSign(AbstractSolver):
    """Every lateral leaves its parent at one angle, to the front or the back by chance."""

    divergence: float = float(np.radians(50.0))  # radians, 0-π

    name = "random-sign"
    default_steps = 1

    def init(self, graph: FactorGraph, prior: Prior, key: Key[Array, ""]) -> State:
        side = np.where(uniform(key, np.arange(graph.limb_count), 0) < 0.5, 1.0, -1.0)
        elevation = np.zeros(len(graph))
        for row in range(len(graph)):
            above = graph.parent[row]
            if above == NULL or graph.limb_parent[graph.limb[row]] == NULL:
                continue
            if graph.is_apical[row]:
                elevation[row] = elevation[above]
            else:
                along = unit_vector(graph.direction[above], elevation[above])
                elevation[row] = _elevation(graph.direction[row], along, self.divergence, side[graph.limb[row]])
        return State(depth_of(graph, elevation))

    def step(self, graph: FactorGraph, prior: Prior, state: State, key: Key[Array, ""]) -> tuple[State, Any]:
        return state, Info(np.nan, 0.0)

    def terminate(self, graph: FactorGraph, prior: Prior, state: State) -> bool:
        return True

    def depth(self, graph: FactorGraph, state: State) -> Float[np.ndarray, " segment"]:
        return state.depth


def unit_vector(direction: Float[np.ndarray, " 2"], elevation: float) -> Float[np.ndarray, " 3"]:
    """The direction in space of a segment with this direction on the page and this elevation."""
    return np.array([*(np.cos(elevation) * direction), np.sin(elevation)])


def depth_of(graph: FactorGraph, elevation: Float[np.ndarray, " segment"]) -> Float[np.ndarray, " segment"]:
    """Depth of every tip: ℓ tan ψ summed from the base."""
    rise = graph.length * np.tan(elevation)
    depth = np.zeros(len(graph))
    for row in np.flatnonzero(graph.parent != NULL):
        depth[row] = depth[graph.parent[row]] + rise[row]
    return depth


def _elevation(direction, along, divergence, side):
    flat, deep = direction @ along[:2], along[2]
    reach = np.hypot(flat, deep)
    swing = np.arccos(np.clip(np.cos(divergence) / max(reach, 1e-12), -1.0, 1.0))
    return float(np.clip(np.arctan2(deep, flat) + side * swing, -_STEEPEST, _STEEPEST))
