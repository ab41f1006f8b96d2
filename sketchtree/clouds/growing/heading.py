"""Which way does a bud grow?

Guo et al. 2018, §5.2, Eq. 9:

    V_A = V_default + α V_opt + β V_tropism,        V_opt = Σ w_i V_i / Σ w_i

    V_default   the bud's heading       V_i   from the bud to point i, unit       w_i   its weight (Eq. 8)
    V_tropism   (0, −1, 0) as printed   α     1.6                                 β     0.3
"""

import numpy as np
from jaxtyping import Float, Int

ALPHA, BETA = 1.6, 0.3
_STEPS, _NARROW = 4, 6.0  # of the search for the limb that most points lie on, and how narrow it is


def optimal(
    way: Float[np.ndarray, "pair 3"], weight: Float[np.ndarray, " pair"], bud: Int[np.ndarray, " pair"], buds: int
) -> Float[np.ndarray, "bud 3"]:
    """V_opt of every bud: `way` leads from `bud` to a point that it perceives, unit. 0 for a bud without any."""
    total = np.stack([np.bincount(bud, weight * axis, buds) for axis in way.T], axis=1)
    return total / np.maximum(np.bincount(bud, weight, buds), 1e-300)[:, None]


def decided(
    way: Float[np.ndarray, "pair 3"], weight: Float[np.ndarray, " pair"], bud: Int[np.ndarray, " pair"], start: Float[np.ndarray, "bud 3"]
) -> Float[np.ndarray, "bud 3"]:
    """V_opt of points that lie one way together: where wood forks, the mean of all leads between both limbs (ours). `start`: where the search begins."""
    mode = start
    for _ in range(_STEPS):
        alike = np.exp(_NARROW * (np.einsum("pi,pi->p", way, unit(mode)[bud]) - 1.0))
        mode = optimal(way, weight * alike, bud, len(start))
    return mode


def headed(
    default: Float[np.ndarray, "bud 3"], best: Float[np.ndarray, "bud 3"], tropism: Float[np.ndarray, " 3"], alpha: float = ALPHA, beta: float = BETA
) -> Float[np.ndarray, "bud 3"]:
    """V_A, unit (Eq. 9)."""
    return unit(default + alpha * best + beta * tropism)


def unit(vector: Float[np.ndarray, "row 3"]) -> Float[np.ndarray, "row 3"]:
    """The same directions, of length 1 (0 stays 0)."""
    return vector / np.maximum(np.linalg.norm(vector, axis=1, keepdims=True), 1e-12)
