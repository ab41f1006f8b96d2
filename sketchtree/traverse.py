"""Root-to-tip and tip-to-root passes over a parents-first table.

Works on any `parent` column whose parents precede their children (a `TreeSkeleton`'s or a
`SketchGraph`'s). Passes go generation by generation, each as one array operation.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL


def generation(parent: Int[np.ndarray, " segment"]) -> Int[np.ndarray, " segment"]:
    """How many rows lie between each row and its base (0 at a base): by ancestors twice as far away at every step."""
    depth = (parent != NULL).astype(np.int64)
    above = np.where(parent == NULL, np.arange(len(parent)), parent)
    while depth[above].any():
        depth += depth[above]
        above = above[above]
    return depth


def generations(parent: Int[np.ndarray, " segment"]) -> list[Int[np.ndarray, " row"]]:
    """The rows of each generation, bases first; rows keep their order."""
    depth = generation(parent)
    order = np.argsort(depth, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(depth[order])) + 1) if len(order) else []


def children(parent: Int[np.ndarray, " segment"]) -> tuple[Int[np.ndarray, " child"], Int[np.ndarray, " segment+1"]]:
    """Children of every row as one ragged column: row i's are `child[start[i]:start[i + 1]]`."""
    rows = np.flatnonzero(parent != NULL)
    child = rows[np.argsort(parent[rows], kind="stable")]
    start = np.r_[0, np.cumsum(np.bincount(parent[rows], minlength=len(parent)))].astype(np.int64)
    return child, start


def child_count(parent: Int[np.ndarray, " segment"]) -> Int[np.ndarray, " segment"]:
    """How many children every row has."""
    return np.bincount(parent[parent != NULL], minlength=len(parent))


def is_tip(parent: Int[np.ndarray, " segment"]) -> Bool[np.ndarray, " segment"]:
    """Rows without children."""
    return child_count(parent) == 0


def sum_to_root(parent: Int[np.ndarray, " segment"], value: Float[np.ndarray, " segment"]) -> Float[np.ndarray, " segment"]:
    """For every row the sum of `value` over itself and all its descendants."""
    total = np.array(value, float)
    for rows in reversed(generations(parent)[1:]):
        np.add.at(total, parent[rows], total[rows])
    return total


def sum_from_root(parent: Int[np.ndarray, " segment"], value: Float[np.ndarray, " segment"]) -> Float[np.ndarray, " segment"]:
    """For every row the sum of `value` over itself and all its ancestors."""
    total = np.array(value, float)
    for rows in generations(parent)[1:]:
        total[rows] += total[parent[rows]]
    return total


def limb_chains(parent: Int[np.ndarray, " segment"], limb: Int[np.ndarray, " segment"]) -> list[Int[np.ndarray, " row"]]:
    """The rows of every limb from insertion to tip, limbs in the order of their first rows."""
    _, first, inverse = np.unique(limb, return_index=True, return_inverse=True)
    rank = np.argsort(np.argsort(first))[inverse]
    order = np.argsort(rank, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(rank[order])) + 1) if len(order) else []
