"""How thick is wood that nobody has measured?

Guo et al. 2018, Eq. 5: from the root to the tips, a child is as thick as the share of the wood that it bears,

    d_ci = d_p (l_ci / Σ_j l_cj)^γ

    l_ci   length of all branches that the child bears, its own internode with them      γ   diameter coefficient of the species

A child without siblings would be as thick as its parent, and a twig a rod: its parent's internode counts among the siblings there (ours), so that it tapers.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.traverse import child_count, generations, sum_to_root


def radii(
    parent: Int[np.ndarray, " node"], step: Float[np.ndarray, " node"], root: Float[np.ndarray, " node"], gamma: float
) -> Float[np.ndarray, " node"]:
    """Radius of every node. `step`: from its parent; `root`: radius at bases, anything elsewhere."""
    borne = sum_to_root(parent, step) + 1e-12
    child = np.flatnonzero(parent != NULL)
    siblings = np.bincount(parent[child], borne[child], len(parent))
    only = child_count(parent) == 1
    share = np.ones(len(parent))
    share[child] = borne[child] / (siblings + np.where(only, step, 0.0))[parent[child]]
    radius = np.where(parent == NULL, root, 0.0)
    for rows in generations(parent)[1:]:
        radius[rows] = radius[parent[rows]] * share[rows] ** gamma
    return radius
