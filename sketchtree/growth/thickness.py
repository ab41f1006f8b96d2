"""How thick is wood that is still growing?

The pipe model (Shinozaki et al. 1964) between two ends that are known: wood begins as one twig and ends as thick as the tree
that was given. In between, its cross-section grows with the wood that it bears,

    r_i(t)² = ρ² + (r_i² − ρ²) L_i(t) / L_i(1)

    ρ        radius of the thinnest twig, or r_i where that is less
    L_i(t)   metres of wood that have grown at or beyond piece i

and no piece is thicker than its parent, unless it ends so (then in that ratio).
"""

import numpy as np
from jaxtyping import Float

from sketchtree.growth.layers import Layers


def borne_share(layers: Layers, length: Float[np.ndarray, " segment"], grown: Float[np.ndarray, "segment time"]) -> Float[np.ndarray, "segment time"]:
    """L_i(t) / L_i(1), 0-1, from the shares grown; rows stand at their places, `length` in metres. Never falls with time."""
    borne = grown * length[:, None]
    layers.sum_to_root(borne)
    whole = length[:, None].copy()
    layers.sum_to_root(whole)
    bare = whole[:, 0] <= 0
    share = np.minimum(borne / np.where(bare[:, None], 1.0, whole).astype(grown.dtype), 1.0)
    return np.where(bare[:, None], (grown > 0).astype(grown.dtype), share) if bare.any() else share


def radii(layers: Layers, final: Float[np.ndarray, " segment"], share: Float[np.ndarray, "segment time"]) -> Float[np.ndarray, "segment time"]:
    """Radius of every piece's tip at every time, metres, where it bears a `share` of what it will bear. At share 1 the final one."""
    twig = final.min(initial=np.inf)
    radius = share * (final**2 - twig**2)[:, None]
    radius += twig**2
    np.sqrt(radius, out=radius)
    radius = np.where(share >= 1.0, final[:, None], np.minimum(radius, final[:, None]))
    for layer in layers.downwards():
        above = layers.parent[layer]
        thicker = final[layer] / final[above]
        most = np.where(thicker > 1, thicker * (1 + 1e-6), 1.0).astype(radius.dtype)[:, None]
        radius[layer] = np.minimum(radius[layer], most * radius[above])
    return radius
