"""Are the everyday samples those of a run of fifty times the length?

The full default model, as it ships. Reference: five restarts from other random limbs, ten times the everyday blocks each, with a longer and
hotter burn-in, all their samples pooled.

    steepness   Wasserstein-1 of |dz|/|v| between everyday and reference, mean over segments
    odds        |difference of the same-side odds|, mean over all pairs of laterals: the share of the samples in which two limbs' tips
                lie on one side of where their limbs start, which a mirror image does not change
    restart     the same two of one restart against the other four: how far the reference itself may be off
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from scipy.stats import wasserstein_distance

from benchmarks import cases as case_sets
from benchmarks.drawing import Case
from sketchtree.axes import NULL
from sketchtree.keys import root_key
from sketchtree.mrf.answer.typical import depth_of
from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import FactorGraph, factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.prior import Prior

TIMES = 50
RESTARTS = 5
HOT = (8.0, 5.0, 3.0, 2.0, 1.5, 1.2, 1.0, 1.0, 1.0, 1.0)  # temperature of each block of a restart's burn-in
FIRST_SEED = 100  # of the grown trees: far from those that `benchmarks.depth` measures on
GROWN = 0.6  # share of the drawings
AT_MOST = {"steepness": 0.03, "odds": 0.05}
Samples = Float[np.ndarray, "sample segment"]  # ψ


class Difference(NamedTuple):
    """Of one drawing."""

    name: str
    segments: int
    steepness: float
    odds: float
    restart_steepness: float
    restart_odds: float


def drawings(count: int) -> list[Case]:
    """Grown and measured trees by turns, as far as the measured ones reach."""
    families = 3
    grown = case_sets.synthetic(-(-count // families), FIRST_SEED)
    grown = [case for seed in range(len(grown) // families) for case in grown[seed :: len(grown) // families]]
    views = case_sets.real()
    views = sorted(views, key=lambda case: case.name.rpartition("_")[2])[: round((1 - GROWN) * count)]
    return [*grown[: count - len(views)], *views]


def differences(cases: list[Case], *, seed: int) -> Iterator[Difference]:
    """One drawing after another."""
    for case in cases:
        graph = factor_graph(case.graph)
        everyday = samples(graph, Elevation(), seed)
        restarts = [samples(graph, reference(), seed + 1 + k) for k in range(RESTARTS)]
        others = [np.concatenate(restarts[:k] + restarts[k + 1 :]) for k in range(RESTARTS)]
        own = [difference(graph, one, rest) for one, rest in zip(restarts, others, strict=True)]
        yield Difference(
            case.name, int((~graph.is_base).sum()), *difference(graph, everyday, np.concatenate(restarts)), *np.mean(own, axis=0).tolist()
        )


def reference() -> Elevation:
    """One restart."""
    blocks = Elevation().default_steps * TIMES // RESTARTS
    return Elevation(burn=HOT, keep=blocks - len(HOT), cool=())


def samples(graph: FactorGraph, solver: Elevation, seed: int) -> Samples:
    """All that a run keeps."""
    fit = infer(graph, Prior(), solver, key=root_key(seed))
    return fit.posterior.elevation.reshape(-1, len(graph)).astype(np.float64)


def difference(graph: FactorGraph, one: Samples, other: Samples) -> tuple[float, float]:
    """(steepness, odds)."""
    rows = np.flatnonzero(~graph.is_base)
    apart = [wasserstein_distance(*(np.abs(np.sin(psi[:, row])) for psi in (one, other))) for row in rows]
    pairs = np.triu_indices(int(np.sum(graph.limb_parent != NULL)), 1)
    odds = [same_side(graph, psi)[pairs] for psi in (one, other)]
    return float(np.mean(apart)), float(np.mean(np.abs(odds[0] - odds[1]))) if len(pairs[0]) else 0.0


def same_side(graph: FactorGraph, psi: Samples) -> Float[np.ndarray, "lateral lateral"]:
    """`Posterior.same_side` of every two laterals."""
    depth = depth_of(graph, psi.T)
    limb = np.flatnonzero(graph.limb_parent != NULL)
    side = np.sign(depth[graph.limb_tip[limb]] - depth[graph.parent[graph.limb_first[limb]]])
    return 0.5 + 0.5 * (side @ side.T) / len(psi)
