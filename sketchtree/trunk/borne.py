"""How thick is a trunk that a matte shows too thin at its foot, and limbs that a veil of twigs shows too thick?

The distance to the contour is the thickness where the matte is right. It is too little where bark has the colours behind it, and too much where many twigs make one blot. Ours, from limb to limb:

    by itself        no wood is thicker than `SWELLS` of its limb's median so far, counted from its foot outside its parent's circle (of a trunk also: nor than the `WIDE` quantile of its first `FOOT`)
    to its end       r ≤ (Σ_c r_c³)^(1/3) + `TAPERS` l                   l   length of the piece: wood doesn't end at a step, but in forks
    from above       r ≤ r_bearer · min(1, `SPARE` · share^(1/3))        share   of the wood beyond the fork that the limb carries
    from below       r³ ≥ Σ_c r_c³                                       nor is wood thinner than what it bears needs (pipe model with Murray's exponent)

If that makes the trunk thicker at the ground than it measures, limbs are too thick all over, and everything is as much thinner. Thickness never grows towards the tips.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL

SWELLS = 1.2
WIDE, FOOT = 0.5, 0.4
SPARE = 1.3
EXPONENT = 3.0
TAPERS = 0.15  # a radius a length


def borne_radius(parent: Int[np.ndarray, " node"], xy: Float[np.ndarray, "node 2"], radius: Float[np.ndarray, " node"], limb: Int[np.ndarray, " node"]) -> Float[np.ndarray, " node"]:
    """The radius of every node of a tree, parents first and limbs after what bears them, by what was measured there and around it, and by what it bears."""
    step = np.where(parent == NULL, 0.0, np.hypot(*(xy - xy[np.maximum(parent, 0)]).T))
    wood = carried(parent, step)
    beyond = np.bincount(parent[1:], weights=wood[1:], minlength=len(parent))
    radius = tapering(parent, step, radius)
    thick = np.array(radius, np.float64)
    for one in np.unique(limb):
        rows = np.flatnonzero(limb == one)
        most, fork = _by_itself(radius[rows], step[rows], is_trunk=parent[rows[0]] == NULL), parent[rows[0]]
        if fork != NULL:
            most = np.minimum(most, thick[fork] * min(1.0, SPARE * (wood[rows[0]] / max(beyond[fork], 1e-9)) ** (1 / EXPONENT)))
        thick[rows] = np.maximum.accumulate(np.minimum(radius[rows], most)[::-1])[::-1]
    pipes = np.zeros(len(thick))
    for row in range(len(thick) - 1, -1, -1):
        thick[row] = max(thick[row], pipes[row] ** (1 / EXPONENT))
        if parent[row] != NULL:
            pipes[parent[row]] += thick[row] ** EXPONENT
    return thick * min(1.0, max(_foot(radius[limb == limb[0]], step[limb == limb[0]]), radius[0]) / thick[0])


def tapering(parent: Int[np.ndarray, " node"], step: Float[np.ndarray, " node"], radius: Float[np.ndarray, " node"]) -> Float[np.ndarray, " node"]:
    """What was measured, where it goes on as wood does; parents first."""
    thick, onward, run = np.array(radius, np.float64), np.zeros(len(radius)), np.zeros(len(radius))
    for row in range(len(thick) - 1, -1, -1):
        if onward[row] > 0.0:
            thick[row] = min(thick[row], onward[row] ** (1 / EXPONENT) + TAPERS * run[row])
        if parent[row] != NULL:
            onward[parent[row]] += thick[row] ** EXPONENT
            run[parent[row]] = max(run[parent[row]], step[row])
    return thick


def carried(parent: Int[np.ndarray, " node"], step: Float[np.ndarray, " node"]) -> Float[np.ndarray, " node"]:
    """The length of every node's piece and of all beyond it; parents first."""
    wood = np.array(step, np.float64)
    for row in range(len(wood) - 1, 0, -1):
        wood[parent[row]] += wood[row] if parent[row] != NULL else 0.0
    return wood


def _by_itself(measured, step, *, is_trunk: bool):
    """The most that each place of a limb may measure."""
    most = SWELLS * np.array([_quantile(measured[: k + 1], step[: k + 1], 0.5) for k in range(len(measured))])
    return np.maximum(most, _foot(measured, step)) if is_trunk else most


def _foot(measured, step) -> float:
    """How wide a trunk measures in its lower part."""
    run = np.cumsum(step)
    first = run <= max(FOOT * run[-1], run[min(1, len(run) - 1)])
    return _quantile(measured[first], step[first], WIDE)


def _quantile(value, weight, share: float) -> float:
    """The value below which `share` of the weight lies."""
    order = np.argsort(value, kind="stable")
    sums = np.cumsum(weight[order] + 1e-9)
    return float(value[order][np.searchsorted(sums, share * sums[-1])])
