"""How sure is each segment's depth? Intervals of |dz|/|v|, and the odds of its side.

    q05, q50, q95      quantiles of s = |dz|/|v| = |sin ψ| over the samples, calibrated
    same-side odds     share of the samples in which a segment leans to the side on which it is shown; each sample is mirrored first
                       if that brings it nearer to what is shown, because no drawing can tell a tree from its mirror image

Calibration. The samples are those of a model, and real trees are not drawn from it: on trees with known depths its intervals
are somewhat too narrow. Quantiles are therefore those of a mixture, a share ε of s spread evenly over 0 … 1, `SHARE` fitted
on the trees of `benchmarks.calibration coverage`. Stems are first turned out of the page (`stems`).
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.mrf.answer.stems import is_stem, turned_steepness
from sketchtree.mrf.factor_graph import FactorGraph

SHARE = 0.05  # ε
LEVELS = (0.05, 0.5, 0.95)


class Intervals(NamedTuple):
    """One entry a segment; NaN at bases."""

    q05: Float[np.ndarray, " segment"]
    q50: Float[np.ndarray, " segment"]
    q95: Float[np.ndarray, " segment"]
    same_side_odds: Float[np.ndarray, " segment"]


def intervals_of(
    graph: FactorGraph,
    steepness: Float[np.ndarray, "sample segment"],
    depth: Float[np.ndarray, "sample segment"],
    answer: Float[np.ndarray, " segment"],
    levels: tuple[float, float, float] = LEVELS,
) -> Intervals:
    """Intervals from samples of |dz|/|v| and of z, and the z that is shown; H = 1."""
    base = graph.is_base
    off_page = answer != answer[np.maximum(graph.parent, 0)]  # not so in a planar drawing
    ends = quantiles(graph, steepness, levels, stem=is_stem(graph) & off_page)
    return Intervals(*(np.where(base, np.nan, x) for x in (*ends, same_side_odds(graph, depth, answer))))


def quantiles(
    graph: FactorGraph,
    steepness: Float[np.ndarray, "sample segment"],
    levels: tuple[float, ...],
    *,
    share: float | None = None,
    stem: Bool[np.ndarray, " segment"] | None = None,
) -> list[Float[np.ndarray, " segment"]]:
    """Calibrated quantiles of |dz|/|v|, one level after the other. Those of a `stem` (default: all) below the median are 0."""
    stem = (is_stem(graph) if stem is None else stem) & (np.ptp(steepness, axis=0) > 0)  # not where it is locked
    steepness = turned_steepness(graph, steepness, stem)
    return [np.where(stem & (level < 0.5), 0.0, mixed_quantile(steepness, level, share)) for level in levels]


def mixed_quantile(steepness: Float[np.ndarray, "sample segment"], level: float, share: float | None = None) -> Float[np.ndarray, " segment"]:
    """The quantile of the samples and a share spread evenly over 0 … 1."""
    share = SHARE if share is None else share
    ordered = np.sort(steepness, axis=0)
    n = len(ordered)
    mass = (1 - share) * (np.arange(n) + 0.5)[:, None] / n + share * ordered  # the mixture's distribution at each sample
    out = np.empty(ordered.shape[1])
    for k in range(ordered.shape[1]):
        out[k] = np.interp(level, np.r_[0.0, mass[:, k], 1.0], np.r_[0.0 if share else ordered[0, k], ordered[:, k], 1.0 if share else ordered[-1, k]])
    return out


def same_side_odds(
    graph: FactorGraph, depth: Float[np.ndarray, "sample segment"], answer: Float[np.ndarray, " segment"]
) -> Float[np.ndarray, " segment"]:
    """Share of the samples in which each segment's dz has the sign that is shown."""
    above = np.maximum(graph.parent, 0)
    side = np.where(depth @ answer < 0, -1.0, 1.0)[:, None]
    rise, shown = side * (depth - depth[:, above]), answer - answer[above]
    return np.mean(np.where(shown == 0, 0.5, (rise * shown > 0).astype(float)), axis=0)
