"""How many sides has a ring, and how many rings a collar?

A regular polygon of n sides misses its circle by r (1 − cos(π / n)); n is the fewest sides for which that is within the
tolerance. Since limbs taper, r is a little less than the radius at the limb's foot.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.detail import Detail

_TYPICAL = 0.8  # radius that sets the number of sides, / radius at the foot


def sides(radius: Float[np.ndarray, " limb"], tolerance: float, detail: Detail) -> Int[np.ndarray, " limb"]:
    """Sides of the rings of limbs with this radius at their foot; `tolerance` in metres."""
    cosine = np.clip(1.0 - tolerance / np.maximum(_TYPICAL * radius, 1e-12), -0.5, 1.0 - 1e-9)
    n = np.pi / np.arccos(cosine)
    n = np.where(n > 8, 2 * np.ceil(n / 2), np.ceil(n))  # even above 8: fewer kinds to sweep
    return np.clip(n, detail.fewest_sides, detail.most_sides).astype(np.int64)


def collar_rings(side: int | Int[np.ndarray, " limb"]) -> Int[np.ndarray, " limb"]:
    """Rings of the collar of a limb with so many sides: fewer on thin limbs."""
    return np.where(np.asarray(side) <= 8, 6, 9)
