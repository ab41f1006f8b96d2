"""Which way does a trunk lean that leans in the drawing? Out of the page too, by a third as much.

A trunk leans or bends in some upright plane, and nothing says that it is the page. Its rows are shown in a plane turned
about the vertical,

    dz = ± .35 dx,

so a straight upright trunk stays where it is and a curved one stays as smooth as it was drawn. One side a stem: that of the
tree that lends its signs, Σ dz dx over the stem's rows. The share was chosen on grown and measured trees: where measured
trunks lean on the page, |dz|/|v| is .45, and the samples, whose trunks rest on an upright prior, say .2. Intervals allow for any turn,
dz/dx ~ N(0, 1), and go down to 0: a trunk may always lie in the page.
"""

import numpy as np
from jaxtyping import Bool, Float
from scipy.special import ndtri

from sketchtree.mrf.factor_graph import FactorGraph

TURN = 0.35  # |dz/dx|


def turned_stems(
    graph: FactorGraph,
    psi: Float[np.ndarray, "segment tree"],
    trees: Float[np.ndarray, "segment tree"],
    *,
    start: Float[np.ndarray, " segment"] | None = None,
    turn: float = TURN,
) -> Float[np.ndarray, "segment tree"]:
    """ψ with the rows of all stems turned out of the page, to the sides that the `trees` have; a stem that leaned to one side at
    the `start` (ψ, NaN where it is not known) stays there."""
    stem = np.flatnonzero(is_stem(graph))
    if not len(stem):
        return psi
    side = _leaning(graph, stem, trees)
    if start is not None:
        before = _leaning(graph, stem, np.nan_to_num(start)[:, None])
        side = np.where(before != 0, before, side)
    side = np.where(side < 0, -1.0, 1.0)
    psi = psi.copy()
    psi[stem] = np.arctan(turn * graph.direction[stem, :1] * side[graph.limb[stem]])
    return psi


def turned_steepness(
    graph: FactorGraph, steepness: Float[np.ndarray, "sample segment"], stem: Bool[np.ndarray, " segment"]
) -> Float[np.ndarray, "sample segment"]:
    """|dz|/|v| of samples, the rows of stems turned out of the page, in each sample by its own dz/dx ~ N(0, 1); the turns are evenly
    spread, not drawn."""
    turn = ndtri((np.arange(1, len(steepness) + 1) * (np.sqrt(5) - 1) / 2) % 1)[:, None]
    slope = steepness[:, stem] / np.sqrt(np.maximum(1 - steepness[:, stem] ** 2, 1e-12)) + turn * graph.direction[stem, 0]
    steepness = steepness.copy()
    steepness[:, stem] = np.abs(slope) / np.sqrt(1 + slope**2)
    return steepness


def _leaning(graph, stem, trees) -> Float[np.ndarray, "limb tree"]:
    """Σ dz dx over the rows of every limb."""
    dx, dz = graph.length[stem] * graph.direction[stem, 0], graph.length[stem, None] * np.tan(trees[stem])
    total = np.zeros((graph.limb_count, trees.shape[1]))
    np.add.at(total, graph.limb[stem], dx[:, None] * dz)
    return total


def is_stem(graph: FactorGraph) -> Bool[np.ndarray, " segment"]:
    """Rows of trunks: of limbs that are held upright by the model (`FactorGraph.limb_spreads`)."""
    return ~graph.is_base & ~graph.limb_spreads[graph.limb]
