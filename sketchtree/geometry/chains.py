"""Which rows make one limb, and what does each limb grow from?

A limb is an apical chain: from where it leaves its parent to its tip. The `limb` column says so; where
it stops although wood goes on (strokes drawn end to end), the child that continues best is taken.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Int

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generation, generations

_STRAIGHT = np.cos(np.radians(60.0))  # a child that turns less may continue a limb that ends at its foot
_ALIKE = 0.6  # … if it is at least this share of the parent's radius

_ONWARD, _THIN = np.cos(np.radians(100.0)), 0.25  # the same where a limb would end otherwise


@dataclass(frozen=True, eq=False)
class Chains:
    """Limbs as rows, ragged: limb i owns `row[start[i]:start[i + 1]]`, from its foot to its tip."""

    row: Int[np.ndarray, " row"]  # every row that is not a base, once
    start: Int[np.ndarray, " limb+1"]
    of_row: Int[np.ndarray, " segment"]  # limb of each row; a base belongs to the limb that continues it, or NULL
    foot: Int[np.ndarray, " limb"]  # row at whose tip the limb starts
    is_stem: Bool[np.ndarray, " limb"]  # it starts on the ground


def chains(tree: TreeSkeleton, apart: Bool[np.ndarray, " segment"] | None = None, onward: bool = False) -> Chains:
    """Cut the tree into limbs; every row that is not a base is in exactly one. Limbs stand in the order of their first rows.

    No limb holds rows that are `apart` and rows that are not. `onward`: a limb that nothing continues so well goes on in what
    turns less than `_ONWARD` and isn't much thinner, so that it doesn't end in a stump with its last child at its side.
    """
    parent = tree.parent
    following = _continuation(tree, np.zeros(len(tree), bool) if apart is None else apart, onward)
    heads = np.flatnonzero(~tree.is_base)
    heads = heads[(following[parent[heads]] != heads) | tree.is_base[parent[heads]]]
    of_row = np.full(len(tree), NULL)
    of_row[heads] = np.arange(len(heads))
    is_head = of_row != NULL
    for rows in generations(parent)[1:]:
        rest = rows[~is_head[rows]]
        of_row[rest] = of_row[parent[rest]]
    rows = np.flatnonzero(~tree.is_base)
    rows = rows[np.lexsort((generation(parent)[rows], of_row[rows]))]
    start = np.r_[0, np.cumsum(np.bincount(of_row[rows], minlength=len(heads)))].astype(np.int64)
    bases = np.flatnonzero(tree.is_base & (following != NULL))
    of_row[bases] = of_row[following[bases]]
    return Chains(rows, start, of_row, parent[heads], tree.is_base[parent[heads]])


def _continuation(tree: TreeSkeleton, apart, onward: bool) -> Int[np.ndarray, " segment"]:
    """The child that carries each row's limb on; NULL at a limb's tip."""
    child = np.flatnonzero(~tree.is_base)
    above = tree.parent[child]
    same = tree.limb[child] == tree.limb[above]
    alike = tree.radius[child] / tree.radius[above]
    turn = _cosine(tree.vector[child], tree.vector[above])
    able = same | tree.is_base[above] | ((turn > _STRAIGHT) & (alike >= _ALIKE))
    well = able
    able = able | (onward & (turn > _ONWARD) & (alike >= _THIN))
    able &= (apart[child] == apart[above]) | tree.is_base[above]
    rank = np.lexsort((-turn, -alike, ~same, ~well, ~able, above))
    child, above, able = child[rank], above[rank], able[rank]
    best = np.r_[True, np.diff(above) != 0][: len(above)] & able
    following = np.full(len(tree), NULL)
    following[above[best]] = child[best]
    return following


def _cosine(a, b):
    scale = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    return np.einsum("ij,ij->i", a, b) / np.maximum(scale, 1e-300)
