"""How like another tree is a tree, in one number? Like S_T of Stava et al. 2014, as Guo et al. 2018 (§6.2) use it; its weights are not in our papers, so ours are defined here:

    S_T = (shape + geometry + structure) / 3          each 0 (nothing alike) to 1 (the same)

    alike(a, b) = min(a, b) / max(a, b)

    shape       mean of alike(heights), alike(crown spreads), and of the crowns in ten slices of height and eight sectors the volume that both fill over that which either fills,
                Σ min(r_a, r_b)² / Σ max(r_a, r_b)²,  r: how far wood reaches from the axis over the foot
    geometry    mean over length / H, thickness / H, divergence, slope and straightness of limbs, each ½ alike(means) + ½ alike(spreads), weighted by the limbs' length
    structure   1 − D / 2,  D: the constrained edit distance of `edit_distance`

Both trees stand with their first foot at the origin; none is turned or scaled.
"""

from dataclasses import dataclass

import numpy as np

from sketchtree.errors import SkeletonError
from sketchtree.fidelity.edit_distance import edit_distance
from sketchtree.fidelity.limb_tree import LimbTree, limb_tree
from sketchtree.fidelity.sampled import along
from sketchtree.skeleton import TreeSkeleton

_SLICES, _SECTORS = 10, 8
_FINE = 0.004  # of the height: between places on axes


@dataclass(frozen=True)
class StavaLike:
    """S_T and its thirds, 0-1."""

    shape: float
    geometry: float
    structure: float

    @property
    def total(self) -> float:
        """S_T."""
        return (self.shape + self.geometry + self.structure) / 3


def stava_like(one: TreeSkeleton, other: TreeSkeleton) -> StavaLike:
    """S_T of two trees; it doesn't matter which is which. Raises SkeletonError for a tree without height."""
    if min(one.height, other.height) <= 0:
        raise SkeletonError("A tree without any height can't be compared.", remedy="Give trees that stand.")
    a, b = limb_tree(one), limb_tree(other)
    return StavaLike(_shape(one, other), _geometry(a, b, one.height, other.height), 1.0 - edit_distance(a, b) / 2.0)


def alike(a: float, b: float) -> float:
    """min / max of two numbers of 0 or more; 1 where both are 0."""
    return 1.0 if max(a, b) == 0 else float(min(a, b) / max(a, b))


def _shape(one: TreeSkeleton, other: TreeSkeleton) -> float:
    tall = max(one.height, other.height)
    a, b = (_crown(tree, tall) for tree in (one, other))
    either = np.sum(np.maximum(a, b) ** 2)
    return float((alike(one.height, other.height) + alike(a.max(), b.max()) + (np.sum(np.minimum(a, b) ** 2) / either if either > 0 else 1.0)) / 3)


def _crown(tree: TreeSkeleton, tall: float):
    """[slice sector] metres that wood reaches from the axis over the first foot; 0 where there is none."""
    place = along(tree, _FINE * tall)[0] - tree.tip[np.flatnonzero(tree.is_base)[0]]
    low = np.clip((place[:, 1] / tall * _SLICES).astype(int), 0, _SLICES - 1)
    sector = np.floor((np.arctan2(place[:, 2], place[:, 0]) / (2 * np.pi) + 0.5) * _SECTORS).astype(int) % _SECTORS
    reach = np.zeros((_SLICES, _SECTORS))
    np.maximum.at(reach, (low, sector), np.hypot(place[:, 0], place[:, 2]))
    return reach


def _geometry(a: LimbTree, b: LimbTree, a_height: float, b_height: float) -> float:
    pairs = [(a.length / a_height, b.length / b_height), (a.thickness / a_height, b.thickness / b_height)]
    pairs += [(getattr(a, name), getattr(b, name)) for name in ("divergence", "slope", "straightness")]
    found = []
    for mine, yours in pairs:
        (mean, sd), (other_mean, other_sd) = _moments(mine, a.length), _moments(yours, b.length)
        found.append((alike(mean, other_mean) + alike(sd, other_sd)) / 2)
    return float(np.mean(found))


def _moments(value, weight) -> tuple[float, float]:
    """Mean and spread of what is known, weighted; 0 where nothing is."""
    known = np.isfinite(value)
    if not known.any():
        return 0.0, 0.0
    mean = np.average(value[known], weights=weight[known])
    return float(mean), float(np.sqrt(np.average((value[known] - mean) ** 2, weights=weight[known])))
