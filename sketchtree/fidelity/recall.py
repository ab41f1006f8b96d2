"""How much of a known tree was found again?

    Chamfer     mean of the distances from places on one tree's axes to the other's, both ways added (distances, not their squares), over the known height
    length      share of the known tree's length that has the other near it (recall), and of the other's that has the known near it (precision)
    tips        the same of tips: each tip belongs to one tip at most, the nearest pairs first

Near is 1 % of the known height for axes, 2 % for tips, unless said otherwise.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment
from scipy.spatial import cKDTree

from sketchtree.errors import SkeletonError
from sketchtree.fidelity.sampled import along
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import is_tip

NEAR, TIP_NEAR = 0.01, 0.02  # of the known height
_FINE = 0.002  # of the known height: between places on axes


@dataclass(frozen=True)
class Recall:
    """Shares 0-1; `chamfer` over the height."""

    chamfer: float
    length_recall: float
    length_precision: float
    tip_recall: float
    tip_precision: float


def recall(known: TreeSkeleton, found: TreeSkeleton, near: float = NEAR, tip_near: float = TIP_NEAR) -> Recall:
    """How much of `known` is in `found`. Raises SkeletonError for a tree without length."""
    height = known.height
    if height <= 0 or found.length.sum() <= 0:
        raise SkeletonError("A tree without any height or length can't be compared.", remedy="Give trees that stand.")
    of_known, of_found = (along(tree, _FINE * height)[0] for tree in (known, found))
    there, back = cKDTree(of_found).query(of_known)[0] / height, cKDTree(of_known).query(of_found)[0] / height
    tips, found_tips = (tree.tip[is_tip(tree.parent) & ~tree.is_base] for tree in (known, found))
    met = _pairs(tips, found_tips, tip_near * height)
    return Recall(float(there.mean() + back.mean()), float(np.mean(there <= near)), float(np.mean(back <= near)), met / max(len(tips), 1), met / max(len(found_tips), 1))


def _pairs(one, other, reach: float) -> int:
    """How many can be paired no farther apart than that, most of all ways."""
    near = cKDTree(one).sparse_distance_matrix(cKDTree(other), reach, output_type="coo_matrix")
    if not near.nnz:
        return 0
    rows, row = np.unique(near.row, return_inverse=True)
    columns, column = np.unique(near.col, return_inverse=True)
    cost = np.full((len(rows), len(columns)), 2.0)
    cost[row, column] = near.data / reach - 1.0
    a, b = linear_sum_assignment(cost)
    return int(np.sum(cost[a, b] <= 0.0))
