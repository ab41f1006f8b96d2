"""Do the intervals hold the depths of trees that the model did not draw?

Grown and measured trees of known depth, drawn and inferred as in `benchmarks.depth`; s = |dz|/|v| of every drawn segment.

    cover     share of the segments with s inside [q05, q95] of `Posterior.intervals`
    score     mean of width + 20 × overshoot (Gneiting & Raftery 2007, Eq. 43), over that of one constant interval: the 5 and 95 %
              quantiles of s in all other cases of the set

for several shares ε of a spread that is even over 0 … 1 (see `answer.intervals`), and by branching order.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from benchmarks.drawing import Case
from sketchtree.keys import root_key
from sketchtree.mrf.answer.intervals import LEVELS, quantiles
from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.prior import Prior

SHARES = (0.0, 0.05, 0.1, 0.2)
COVER = (0.82, 0.96)
SCORE = 0.95
OUTSIDE = 20.0  # 2 / .1


class Measured(NamedTuple):
    """The segments of one case."""

    truth: Float[np.ndarray, " segment"]  # s
    order: Int[np.ndarray, " segment"]
    low: Float[np.ndarray, "share segment"]
    high: Float[np.ndarray, "share segment"]


class Held(NamedTuple):
    """What some segments' intervals are worth."""

    segments: int
    cover: float
    below: float  # share of the truths under the interval
    width: float
    score: float  # over that of the constant interval


def measured(case: Case, *, seed: int, shares: tuple[float, ...] = SHARES) -> Measured:
    """Infer one case."""
    graph = factor_graph(case.graph)
    posterior = infer(graph, Prior(), Elevation(), key=root_key(seed), throw=False).posterior
    rows = ~graph.is_base
    steepness = posterior.steepness.reshape(len(posterior), -1)
    ends = zip(*([q[rows] for q in quantiles(graph, steepness, (LEVELS[0], LEVELS[-1]), share=share)] for share in shares), strict=True)
    return Measured(true_steepness(case)[rows], np.minimum(graph.order[rows], 2), *(np.array(end) for end in ends))


def true_steepness(case: Case) -> Float[np.ndarray, " segment"]:
    """|dz|/|v| of the tree; 0 at bases."""
    above = np.maximum(case.graph.parent, 0)
    v = case.position - case.position[above]
    size = np.linalg.norm(v, axis=1)
    return np.where(case.graph.is_base, 0.0, np.abs(v[:, 2]) / np.maximum(size, 1e-12))


def held(of: list[Measured], share: int, order: int | None = None) -> Held:
    """The intervals with the `share`-th share, of one order or all; NaN where there is no segment."""
    rows = [(one.order == order) if order is not None else np.ones(len(one.truth), bool) for one in of]
    columns = zip(*((one.truth[r], one.low[share][r], one.high[share][r]) for one, r in zip(of, rows, strict=True)), strict=True)
    truth, low, high = map(np.concatenate, columns)
    if not len(truth):
        return Held(0, np.nan, np.nan, np.nan, np.nan)
    constant = np.concatenate([np.tile(_constant(of, k)[:, None], int(r.sum())) for k, r in enumerate(rows)], axis=1)
    own, inside = score(truth, low, high), (truth >= low) & (truth <= high)
    return Held(len(truth), float(inside.mean()), float((truth < low).mean()), float((high - low).mean()), own / score(truth, *constant))


def score(truth, low, high) -> float:
    """Mean interval score at 90 %."""
    return float(np.mean(high - low + OUTSIDE * (np.maximum(low - truth, 0) + np.maximum(truth - high, 0))))


def _constant(of, k):
    """The interval that all other cases suggest."""
    return np.quantile(np.concatenate([one.truth for j, one in enumerate(of) if j != k]), [0.05, 0.95])
