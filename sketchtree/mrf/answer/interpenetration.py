"""Do limbs still pass through each other in the final depths? Then they give way, a little, along z.

The factor is −w Σ softplus((½(r_i + r_k) − d_ik)/δ) with d_ik the distance of two axes, in the limit of a hard wall: of all
depths without overlap those nearest to the inferred ones. Each round moves the overlapping tips, and all that grows from
them, by what is missing (`overlaps.pushes`); a push may cause another overlap, so there are several. Kin do not count: pairs
that share a node, a grandparent or a limb. Drawings without overlap are returned as they are, and so are those of more
than `MOST_ROWS` rows: there the lines lie so close on the page that most of them would have to move.
"""

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.mrf.overlaps import candidates, pushes
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.traverse import sum_from_root

ROUNDS = 24
MOST_ROWS = 6000


def moved_apart(
    graph: FactorGraph, depth: Float[np.ndarray, " segment"], *, held: Bool[np.ndarray, " segment"] | None = None
) -> Float[np.ndarray, " segment"]:
    """Depths (H = 1) with as few overlapping segments as the rounds allow, near the given ones. Rows that are `held` stay."""
    if len(graph) > MOST_ROWS:
        return depth
    pair = candidates(graph)
    best, fewest = depth, None
    for _ in range(ROUNDS + 1):
        push = pushes(graph, depth, pair)
        overlaps = np.count_nonzero(push)
        if held is not None:
            push = np.where(held, 0.0, push)
        if fewest is None or overlaps < fewest:
            best, fewest = depth, overlaps
        if overlaps == 0:
            break
        depth = depth + sum_from_root(graph.parent, push)
    return best
