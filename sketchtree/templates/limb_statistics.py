"""How do a tree's limbs branch? Counts, means and variances per branching order.

What the default method learns Θ from (beyond Chen et al., whose scale per segment says mostly where
laterals sit). For a limb j of order o ≥ 1 with first segment f on parent segment p:

    divergence   angle between v_f and v_p, radians
    length       log(Λ_j / Λ_parent), Λ a limb's length along its segments
    bend         angle between successive segments of one limb; its mean square per order 0, 1, 2+
"""

import numpy as np

from sketchtree.parameters import LimbStatistics
from sketchtree.skeleton import TreeSkeleton


def limb_statistics(tree: TreeSkeleton) -> LimbStatistics:
    """The statistics of one tree. A limb that stands on the ground has no divergence or length ratio."""
    rows = np.flatnonzero(~tree.is_base & (tree.length > 1e-9))
    parent = tree.parent[rows]
    total = dict(zip(*_limb_lengths(tree), strict=True))
    angle = _angle(tree.vector[rows], tree.vector[parent])
    same = tree.limb[rows] == tree.limb[parent]
    known = ~tree.is_base[parent] & (tree.length[parent] > 1e-9)

    starts = rows[~same & ~tree.is_base[parent]]
    ratio = np.array([np.log(total[tree.limb[r]] / total[tree.limb[tree.parent[r]]]) for r in starts])
    lateral, apical = ~same & known, same & known
    divergence_order = np.clip(tree.order[rows][lateral], 1, 2)
    length_order = np.clip(tree.order[starts], 1, 2)
    bend_order = np.clip(tree.order[rows][apical], 0, 2)
    divergence = [_moments(angle[lateral][divergence_order == o]) for o in (1, 2)]
    length = [_moments(ratio[length_order == o]) for o in (1, 2)]
    bend = [angle[apical][bend_order == o] for o in (0, 1, 2)]
    return LimbStatistics(
        *(np.array(column) for column in zip(*divergence, strict=True)),
        *(np.array(column) for column in zip(*length, strict=True)),
        np.array([len(b) for b in bend]),
        np.array([float(np.mean(b**2)) if len(b) else 0.0 for b in bend]),
    )


def _limb_lengths(tree: TreeSkeleton):
    limb, index = np.unique(tree.limb, return_inverse=True)
    return limb.tolist(), np.maximum(np.bincount(index, weights=tree.length), 1e-9).tolist()


def _moments(x) -> tuple[int, float, float]:
    return (len(x), float(np.mean(x)), float(np.var(x))) if len(x) else (0, 0.0, 0.0)


def _angle(a, b):
    cross = np.sqrt(np.sum(np.cross(a, b) ** 2, axis=1))
    return np.arctan2(cross, np.sum(a * b, axis=1))
