"""Is a crown bald on one side? The largest empty azimuth, looked for where it would show."""

import numpy as np
from jaxtyping import Float

PARTS = 3  # of the crown's height
OUTER = 0.5  # of the crown's half width: wood nearer to the axis is on no side
_FEW = 0.02  # of the outer wood of a part: an arc that holds no more is empty


def empty_azimuth(height: Float[np.ndarray, " sample"], outward: Float[np.ndarray, "sample 2"], half: float | Float[np.ndarray, " sample"]) -> float:
    """Degrees of the largest arc about the crown's axis in which there is hardly any wood, in whichever part of its height that is largest. Of places evenly along the wood: `height`;
    `outward` from the axis, level (x, z); `half` of the crown's width there, all in one unit."""
    edges = np.linspace(*np.percentile(height, [2, 98]), PARTS + 1)
    outer = np.hypot(*outward.T) >= OUTER * half
    turn = np.arctan2(outward[:, 1], outward[:, 0])
    return max(_empty(turn[outer & (height >= low) & (height <= high)]) for low, high in zip(edges[:-1], edges[1:], strict=True))


def _empty(turn: Float[np.ndarray, " sample"]) -> float:
    """Degrees of the largest arc between azimuths, a few of them left out."""
    if len(turn) < 2:
        return 360.0
    turn = np.sort(turn)
    step = max(int(_FEW * len(turn)), 1)
    around = np.r_[turn, turn + 2 * np.pi]
    return float(np.degrees((around[step : step + len(turn)] - turn).max()))
