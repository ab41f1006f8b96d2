"""How does a stem widen where it enters the ground?

With h the height above the ground and R the stem's radius there,

    r(h, θ) = R (1 + a e^(−h / 1.1 R) (1 + b(θ)))        b(θ) = Σ_m b_m cos(m θ + φ_m),  m = 3, 4, 5

    a   flare, `Detail.flare`        b   buttresses, |b| < 1, their phases φ_m from the limb's id
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.rings import Rings

_LOBES = ((3, 0.22), (4, 0.16), (5, 0.24))


def flare(
    lines: CentreLines,
    ring: Rings,
    rows: Int[np.ndarray, " ring"],
    theta: Float[np.ndarray, " side"],
    amount: float,
) -> Float[np.ndarray, "ring side"]:
    """Factor on the radius of every vertex of the rings `rows`; 1 but near the foot of a stem."""
    limb = ring.limb[rows]
    fade = faded(lines, limb, ring.s[rows])
    phase = (lines.limb_id % 65521)[limb] * 0.6180339887
    lobes = sum(size * np.cos(m * theta + (m + 1) * phase[:, None]) for m, size in _LOBES)
    return 1.0 + amount * fade[:, None] * (1.0 + lobes)


def faded(lines: CentreLines, limb: Int[np.ndarray, " ring"], s: Float[np.ndarray, " ring"]) -> Float[np.ndarray, " ring"]:
    """e^(−h / 1.1 R) at places `s` metres along stems, 0 where that is next to nothing and on other limbs."""
    foot = lines.radius[lines.start[:-1]][limb]
    fade = np.where(lines.is_stem[limb], np.exp(-np.maximum(s - lines.ground[limb], 0.0) / (1.1 * foot)), 0.0)
    return np.where(fade < 1e-3, 0.0, fade)
