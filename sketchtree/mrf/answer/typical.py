"""From samples and cooled trees to the depths that are shown: typical steepness, the signs of the most typical tree.

    |ψ_i|     its median over the samples: the best tree alone is too steep here, too flat there
    stems     in a plane turned out of the page (`stems`); in a planar drawing they stay in it
    crown     the deeper a limb reaches the more it is stretched (`crown`), until the whole is as deep as the samples and as
              the drawing is wide
    signs     one a limb, that of its tip over its start: what is steep in most trees would zigzag with a tree whose limb just
              passes the page. The best tree and the likeliest cooled chains propose theirs; taken are those whose tree, seen from the side, is
              nearest to the samples on average. Which of two mirror images a limb is no drawing can tell, but how
              the limbs share out before and behind the trunk, the samples do. Two trees are as far apart as

                  d = mean_θ |h(θ) − h'(θ)|,     h(θ) = max over laterals of z cos θ + y sin θ,

              or as one and the other's mirror image, whichever is nearer (h: the support function of the hull)
"""

import numpy as np
from jaxtyping import Float

from sketchtree.mrf.answer.crown import stretched_crown
from sketchtree.mrf.answer.stems import TURN, turned_stems
from sketchtree.mrf.depths import depth_of
from sketchtree.mrf.factor_graph import FactorGraph

ENOUGH = 160  # samples that the stretches and the choice of signs look at
_DIRECTIONS = np.linspace(-np.pi / 2, np.pi / 2, 17)  # θ, from straight down to straight up


def typical_readings(
    graph: FactorGraph,
    samples: Float[np.ndarray, "sample segment"],
    trees: Float[np.ndarray, "tree segment"],
    *,
    planar: bool = False,
    start: Float[np.ndarray, " segment"] | None = None,
) -> tuple[Float[np.ndarray, "segment tree"], Float[np.ndarray, "segment some"]]:
    """(ψ with typical steepness and the signs of each tree, the samples that were looked at). Stems that leaned to one side at the
    `start` (ψ, NaN where it is not known) stay there."""
    size = np.median(np.abs(samples), axis=0)
    some = samples[:: -(-len(samples) // ENOUGH)].T
    readings = size[:, None] * _sides(graph, trees.T)
    readings = turned_stems(graph, readings, trees.T, start=start, turn=0.0 if planar else TURN)
    return stretched_crown(graph, readings, some, planar=planar), some


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


def _sides(graph: FactorGraph, trees: Float[np.ndarray, "segment tree"]) -> Float[np.ndarray, "segment tree"]:
    """±1: the side to which the limb of each segment leads."""
    rise = np.zeros((graph.limb_count, trees.shape[1]))
    np.add.at(rise, graph.limb, graph.length[:, None] * np.tan(trees))
    return np.where(rise < 0, -1.0, 1.0)[graph.limb]


def side_view(
    graph: FactorGraph, psi: Float[np.ndarray, "segment tree"]
) -> Float[np.ndarray, "tree side direction"]:
    """h(θ) of every tree, towards the viewer and away from him; H = 1."""
    lateral = graph.limb_spreads[graph.limb]
    lateral = lateral if lateral.any() else ~graph.is_base
    z, y = depth_of(graph, psi)[lateral], graph.xy[lateral, 1:]
    reach = [[np.max(side * np.cos(t) * z + np.sin(t) * y, axis=0) for t in _DIRECTIONS] for side in (1, -1)]
    return np.moveaxis(np.array(reach), -1, 0)
