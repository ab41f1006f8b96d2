"""How much must be done to one branching structure to make another of it?

The constrained edit distance between unordered trees (Zhang 1996): limbs are put in, taken out or changed into one another, and separate subtrees stay separate. With T_i the
subtree of limb i, F_i the forest of the limbs that it bears, ∅ nothing:

    D(T_i, T_j) = min { D(∅, T_j) + min_k [D(T_i, T_jk) − D(∅, T_jk)],  the same with i and j exchanged,  D(F_i, F_j) + γ(i → j) }
    D(F_i, F_j) = min { D(∅, F_j) + min_k [D(F_i, F_jk) − D(∅, F_jk)],  the same with i and j exchanged,  the cheapest pairing of the subtrees of F_i and F_j }

    γ(i → ∅)   length of limb i, as a share of its tree's
    γ(i → j)   |l_i − l_j| + min(l_i, l_j) |p_i − p_j|          l: length, a share;  p: where on its parent it leaves, 0-1

Trees have length 1, so the distance is 0 (the same) to 2 (nothing alike).
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.optimize import linear_sum_assignment

from sketchtree.axes import NULL
from sketchtree.fidelity.limb_tree import LimbTree

MOST = 150  # limbs of each tree, the longest with all that bears them: the work grows with the product


def edit_distance(one: LimbTree, other: LimbTree, most: int = MOST) -> float:
    """0 to 2."""
    a, b = _Limbs(one, most), _Limbs(other, most)
    trees, forests = np.zeros((len(a) + 1, len(b) + 1)), np.zeros((len(a) + 1, len(b) + 1))  # the last row and column: nothing
    for i in reversed(range(len(a))):
        forests[i, -1] = trees[a.borne[i], -1].sum()
        trees[i, -1] = forests[i, -1] + a.length[i]
    for j in reversed(range(len(b))):
        forests[-1, j] = trees[-1, b.borne[j]].sum()
        trees[-1, j] = forests[-1, j] + b.length[j]
    for i in reversed(range(len(a))):
        for j in reversed(range(len(b))):
            _one_pair(a, b, i, j, trees, forests)
    return _paired(trees, a.ground, b.ground)


class _Limbs:
    """The longest limbs, with those that each bears."""

    def __init__(self, tree: LimbTree, most: int):
        kept = np.zeros(len(tree), bool)
        for limb in np.argsort(-tree.length, kind="stable"):
            way = [limb]
            while tree.parent[way[-1]] != NULL and not kept[way[-1]]:
                way.append(tree.parent[way[-1]])
            if kept.sum() + np.sum(~kept[way]) <= most:
                kept[way] = True
        rows = np.flatnonzero(kept)
        number = np.full(len(tree), NULL)
        number[rows] = np.arange(len(rows))
        self.length: Float[np.ndarray, " limb"] = tree.length[rows] / tree.length[rows].sum()
        self.place: Float[np.ndarray, " limb"] = tree.place[rows]
        parent: Int[np.ndarray, " limb"] = np.where(tree.parent[rows] == NULL, NULL, number[tree.parent[rows]])
        self.borne = [np.flatnonzero(parent == k) for k in range(len(rows))]
        self.ground = np.flatnonzero(parent == NULL)

    def __len__(self) -> int:
        return len(self.length)


def _one_pair(a: _Limbs, b: _Limbs, i: int, j: int, trees, forests) -> None:
    mine, yours = a.borne[i], b.borne[j]
    ways = [_paired(trees, mine, yours)]
    if len(yours):
        ways.append(forests[-1, j] + np.min(forests[i, yours] - forests[-1, yours]))
    if len(mine):
        ways.append(forests[i, -1] + np.min(forests[mine, j] - forests[mine, -1]))
    forests[i, j] = min(ways)
    change = abs(a.length[i] - b.length[j]) + min(a.length[i], b.length[j]) * abs(a.place[i] - b.place[j])
    whole = [forests[i, j] + change]
    if len(yours):
        whole.append(trees[-1, j] + np.min(trees[i, yours] - trees[-1, yours]))
    if len(mine):
        whole.append(trees[i, -1] + np.min(trees[mine, j] - trees[mine, -1]))
    trees[i, j] = min(whole)


def _paired(trees, mine, yours) -> float:
    """The cheapest way to make some subtrees of others: each becomes one of them, or nothing, or comes of nothing."""
    if not len(mine) or not len(yours):
        return float(trees[mine, -1].sum() + trees[-1, yours].sum())
    gone, come = trees[mine, -1], trees[-1, yours]
    cost = np.minimum(trees[np.ix_(mine, yours)] - gone[:, None] - come[None], 0.0)
    rows, columns = linear_sum_assignment(cost)
    return float(gone.sum() + come.sum() + cost[rows, columns].sum())
