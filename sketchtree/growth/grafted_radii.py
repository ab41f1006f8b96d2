"""How thick are branches that were grafted on?

As thick, where they begin, as what bears them allows, and from there on as thick as what they bear:

    r_i² = ρ² + (r_foot² − ρ²) L_i / L_foot          L  metres of wood at or beyond a piece;  ρ  the radius of a twig
    r_foot = r at a tip's end;  r √(L_foot / L_host), at most `SIDE` r, at a side, L_host the wood beyond it, that of the branch with it
"""

import numpy as np
from jaxtyping import Float

from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generations, sum_to_root

SIDE = 0.7  # r_foot / r at a side


def grafted_radii(tree: TreeSkeleton, old: int, twig: float) -> Float[np.ndarray, " segment"]:
    """The radii of a tree whose rows from `old` on were grafted on. No row is thicker than its parent."""
    wood = sum_to_root(tree.parent, tree.length)
    radius, foot, whole = np.array(tree.radius), np.full(len(tree), np.nan), np.ones(len(tree))
    for rows in generations(tree.parent)[1:]:
        rows = rows[rows >= old]
        above = tree.parent[rows]
        starts = above < old
        side = starts & (tree.limb[rows] != tree.limb[above])
        share = np.where(side, np.minimum(SIDE, np.sqrt(wood[rows] / np.maximum(wood[above] - tree.length[above], 1e-300))), 1.0)
        foot[rows] = np.where(starts, share * radius[above], foot[above])
        whole[rows] = np.where(starts, wood[rows], whole[above])
        thin = np.minimum(twig, foot[rows])
        radius[rows] = np.minimum(np.sqrt(thin**2 + (foot[rows] ** 2 - thin**2) * np.minimum(wood[rows] / whole[rows], 1.0)), radius[above])
    return radius
