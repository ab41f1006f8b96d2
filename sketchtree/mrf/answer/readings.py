"""Which other trees might the drawing show? Distinct readings, none the mirror image of another.

    d(z, z') = min(‖z − z'‖, ‖z + z'‖)      ‖·‖ the root of the mean square over the tips of laterals, H = 1

The answer comes first. Then one cooled tree after the other is added that brings the samples nearest, on average, to
their nearest reading (a greedy k-medoid), as long as it is farther than `DISTINCT` from those before it.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from sketchtree.mrf.factor_graph import FactorGraph

DISTINCT = 0.04  # H
FAR_BELOW = 2.0  # nats a limb: a tree so much less likely than the best is no reading


class Reading(NamedTuple):
    """One tree that the drawing may show."""

    depth: Float[np.ndarray, " segment"]  # z of every tip
    log_posterior: float  # E of the tree that gave the signs, nats
    odds: float  # share of the samples that are nearest to this reading, 0-1


def distinct_readings(
    graph: FactorGraph,
    trees: Float[np.ndarray, "segment tree"],
    value: Float[np.ndarray, " tree"],
    answer: int,
    samples: Float[np.ndarray, "segment sample"],
    count: int,
    *,
    mirrors: bool = False,
) -> list[Reading]:
    """The answer and up to `count` − 1 others, by falling log posterior. Depths are those of `trees`, E is `value`,
    `samples` are depths too. With `mirrors`, a mirror image counts as another reading.

    The answer is credited with the best tree's E: it is how that tree is shown.
    """
    tips = graph.limb_tip[graph.limb_spreads]
    value = np.where(np.arange(len(value)) == answer, value.max(), value)
    if mirrors:
        trees, value = np.c_[trees, -trees], np.r_[value, np.where(np.arange(len(value)) == answer, np.sort(value)[-1] - 1e-9, value)]
    apart = _distance(trees[tips], trees[tips], mirrors)
    near = _distance(samples[tips], trees[tips], mirrors)  # (sample, tree)
    chosen = [answer]
    allowed = value >= value.max() - FAR_BELOW * max(len(tips), 1)
    while len(chosen) < count:
        fresh = allowed & (apart[chosen].min(axis=0) >= DISTINCT)
        if not fresh.any():
            break
        best = near[:, chosen].min(axis=1)
        mean = np.minimum(best[:, None], near).mean(axis=0)
        chosen.append(int(np.argmin(np.where(fresh, mean, np.inf))))
    odds = np.bincount(np.argmin(near[:, chosen], axis=1), minlength=len(chosen)) / max(len(near), 1)
    ranked = sorted(range(len(chosen)), key=lambda k: (k > 0, -value[chosen[k]]))
    return [Reading(trees[:, chosen[k]], float(value[chosen[k]]), float(odds[k])) for k in ranked]


def _distance(a: Float[np.ndarray, "tip one"], b: Float[np.ndarray, "tip other"], mirrors: bool):
    """d of every column of `a` and of `b`."""
    square = (a**2).sum(axis=0)[:, None] + (b**2).sum(axis=0)
    both = 2 * a.T @ b
    cross = both if mirrors else np.abs(both)
    return np.sqrt(np.maximum(square - cross, 0.0) / max(len(a), 1))
