"""How does a list of nodes and their parents become a skeleton? What every reader of digitised trees needs.

Parents are put first; limbs follow the child that the file says continues its parent, else the thickest, the straightest of equals.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.errors import SkeletonError
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import generations


FARTHEST = 1e100
"""Beyond it squares of lengths are no numbers any more."""


def observed(
    path,
    parent: Int[np.ndarray, " node"],
    tip: Float[np.ndarray, "node 3"],
    radius: Float[np.ndarray, " node"],
    continues: Bool[np.ndarray, " node"] | None = None,
) -> TreeSkeleton:
    """A skeleton of nodes in any order, kind OBSERVED. `continues` says which nodes carry on their parent's limb; where two
    claim it, and without it, thickness and straightness decide. Radii must be positive. Raises `SkeletonError`."""
    if np.abs(tip).max(initial=0.0) > FARTHEST:
        far = float(np.abs(tip).max())
        raise SkeletonError(f"{path}: a node lies at {far:.3g}; lengths beyond {FARTHEST:g} can't be reckoned with.", remedy="Take the stray point out.")
    order = parents_first(parent, path)
    parent = np.where(parent[order] < 0, NULL, np.argsort(order)[parent[order]])
    tip, radius = tip[order], radius[order]
    limb, branching = limbs(parent, tip, radius, None if continues is None else continues[order])
    kind = np.full(len(parent), int(Kind.OBSERVED))
    return TreeSkeleton.from_columns(parent, tip, radius, limb=limb, order=branching, tree=tree_of(parent), kind=kind)


def parents_first(parent, path) -> Int[np.ndarray, " node"]:
    """An order of the rows in which every parent precedes its children; kept where it already does."""
    depth = np.where(parent == NULL, 0, -1)
    while (depth < 0).any():
        ready = (depth < 0) & (parent != NULL) & (depth[parent] >= 0)
        if not ready.any():
            raise SkeletonError(
                f"{path}: some nodes hang in a circle.",
                remedy="Give every branch a path to a node whose parent is -1.",
            )
        depth[ready] = depth[parent[ready]] + 1
    if (parent < np.arange(len(parent))).all():
        return np.arange(len(parent))
    return np.argsort(depth, kind="stable")


def limbs(parent, tip, radius, continues=None) -> tuple[Int[np.ndarray, " node"], Int[np.ndarray, " node"]]:
    """Apical chains and branching orders. With `continues` a node none of whose children continue it ends its limb."""
    child = np.flatnonzero(parent != NULL)
    above = parent[child]
    along = np.where((parent == NULL)[:, None], [0.0, 1.0, 0.0], tip - tip[parent])
    along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-300)
    straight = np.sum(along[child] * along[above], axis=1)
    claim = np.ones(len(parent), bool) if continues is None else continues | (parent[parent] == NULL) & (parent != NULL)
    rank = np.lexsort((-straight, -radius[child], ~claim[child], above))
    best = np.r_[True, np.diff(above[rank]) != 0][: len(rank)]
    apical = np.zeros(len(parent), bool)
    apical[child[rank[best]]] = True
    apical &= claim
    limb, order = np.arange(len(parent)), np.zeros(len(parent), np.int64)
    for rows in generations(parent)[1:]:
        limb[rows] = np.where(apical[rows], limb[parent[rows]], rows)
        order[rows] = order[parent[rows]] + ~apical[rows]
    return limb, order


def tree_of(parent) -> Int[np.ndarray, " node"]:
    """Which base every row hangs on, numbered from 0."""
    tree = np.where(parent == NULL, np.cumsum(parent == NULL) - 1, 0)
    for rows in generations(parent)[1:]:
        tree[rows] = tree[parent[rows]]
    return tree


def filled_radius(radius: Float[np.ndarray, " node"], instead: float | None = None) -> Float[np.ndarray, " node"]:
    """Radii in which those that are unknown (not positive, not finite) are `instead`, by default the median of the known."""
    known = np.isfinite(radius) & (radius > 0)
    if instead is None:
        instead = float(np.median(radius[known])) if known.any() else 1e-3
    return np.where(known, radius, instead)
