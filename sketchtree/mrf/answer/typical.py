"""From samples and cooled trees to the depths that are shown: typical steepness, the signs of the most typical tree.

    |ψ_i|     its median over the samples: the best tree alone is too steep here, too flat there
    stems     three tenths of the median: samples disagree about the side a trunk leans to
    crown     tan ψ of laterals times f = (median ext z_s / ext z)^.7, ext the extent from front to back
    signs     the best tree and the likeliest cooled chains propose theirs; taken are those whose tree, seen from the side, is
              nearest to the samples on average. Which of two mirror images a limb is no drawing can tell, but how
              the limbs share out before and behind the trunk, the samples do. Two trees are as far apart as

                  d = mean_θ |h(θ) − h'(θ)|,     h(θ) = max over laterals of z cos θ + y sin θ,

              or as one and the other's mirror image, whichever is nearer (h: the support function of the hull)

s runs over the samples; f lies within 1/1.6 … 1.6. Its power and the stems' share were chosen on grown and measured trees,
and so was where signs come from.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.mrf.depths import depth_of
from sketchtree.mrf.factor_graph import FactorGraph

STEM_SHARE = 0.3
CROWN_POWER, CROWN_LIMIT = 0.7, 1.6
ENOUGH = 160  # samples that the stretches and the choice of signs look at
_DIRECTIONS = np.linspace(-np.pi / 2, np.pi / 2, 17)  # θ, from straight down to straight up


def typical_readings(
    graph: FactorGraph, samples: Float[np.ndarray, "sample segment"], trees: Float[np.ndarray, "tree segment"]
) -> tuple[Float[np.ndarray, "segment tree"], Float[np.ndarray, "segment some"]]:
    """(ψ with typical steepness and the signs of each tree, the samples that were looked at)."""
    size = np.median(np.abs(samples), axis=0)
    size = np.where(graph.limb_spreads[graph.limb], size, STEM_SHARE * size)
    some = samples[:: -(-len(samples) // ENOUGH)].T
    readings = np.where(trees < 0, -size, size).T
    return stretched_crown(graph, readings, some), some


def stretched_crown(
    graph: FactorGraph, psi: Float[np.ndarray, "segment tree"], samples: Float[np.ndarray, "segment sample"]
) -> Float[np.ndarray, "segment tree"]:
    """ψ with the extent of the whole brought towards its median over the samples."""
    extent, own = np.median(np.ptp(depth_of(graph, samples), axis=0)), np.ptp(depth_of(graph, psi), axis=0)
    factor = np.clip((extent / np.maximum(own, 1e-6)) ** CROWN_POWER, 1 / CROWN_LIMIT, CROWN_LIMIT)
    return np.where(graph.limb_spreads[graph.limb][:, None], np.arctan(np.tan(psi) * factor), psi)


def most_typical(
    graph: FactorGraph, psi: Float[np.ndarray, "segment tree"], samples: Float[np.ndarray, "segment sample"]
) -> int:
    """The tree whose side view is nearest to the samples' on average; the first of equals."""
    own, others = side_view(graph, psi), side_view(graph, samples)
    mean = []
    for tree in own:
        away = [np.abs(others - view).mean(axis=(1, 2)) for view in (tree, tree[::-1])]
        mean.append(np.minimum(*away).mean())
    return int(np.argmin(mean))


def side_view(
    graph: FactorGraph, psi: Float[np.ndarray, "segment tree"]
) -> Float[np.ndarray, "tree side direction"]:
    """h(θ) of every tree, towards the viewer and away from him; H = 1."""
    lateral = graph.limb_spreads[graph.limb]
    lateral = lateral if lateral.any() else ~graph.is_base
    z, y = depth_of(graph, psi)[lateral], graph.xy[lateral, 1:]
    reach = [[np.max(side * np.cos(t) * z + np.sin(t) * y, axis=0) for t in _DIRECTIONS] for side in (1, -1)]
    return np.moveaxis(np.array(reach), -1, 0)
