"""How is a branch cut off? Its own part stays as it was, with the radius it had there; all it bore goes.

With u the share of a row's path (through its drawn points) that stays, the cut end of a row from p to q lies at path
length u ℓ and has the radius

    r = (1 − u) r_p + u r_q        r_p  at its start,  r_q  at its tip; where a limb begins, r_p = r_q
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generations

SHORTEST = 1e-4  # metres: a shorter stump is left out


@dataclass(frozen=True, eq=False)
class Cut:
    """What is left of a tree."""

    skeleton: TreeSkeleton
    rows: Int[np.ndarray, " kept"]  # of the tree that was given, in order


def cut(tree: TreeSkeleton, share: Float[np.ndarray, " segment"]) -> Cut:
    """The tree with every row cut to its `share`: 1 stays whole, less is cut there and bears nothing any more, 0 is dropped."""
    share = np.where(tree.is_base, (share > 0).astype(float), np.clip(share, 0.0, 1.0))
    keep = ~borne(tree.parent, share < 1.0) & (share > 0)
    end = keep & (share < 1.0) & ~tree.is_base
    if not end.any():
        return _kept(tree, keep)
    length = path_length(tree)
    keep &= ~(end & (share * length < SHORTEST))
    end &= keep
    return _kept(_shortened(tree, np.flatnonzero(end), share), keep)


def borne(parent: Int[np.ndarray, " segment"], rows: Bool[np.ndarray, " segment"]) -> Bool[np.ndarray, " segment"]:
    """What stands, at any remove, on one of these rows."""
    on = np.zeros(len(parent), bool)
    if rows.any():
        for step in generations(parent)[1:]:
            on[step] = on[parent[step]] | rows[parent[step]]
    return on


def bears(parent: Int[np.ndarray, " segment"], rows: Bool[np.ndarray, " segment"]) -> Bool[np.ndarray, " segment"]:
    """Rows that are one of these, or that bear one at any remove."""
    found = np.array(rows, bool)
    if found.any():
        for step in reversed(generations(parent)[1:]):
            found[parent[step[found[step]]]] = True
    return found


def path_length(tree: TreeSkeleton) -> Float[np.ndarray, " segment"]:
    """Length of every row through its drawn points, metres."""
    owner, start, end, _ = pieces(tree)
    return np.bincount(owner, np.linalg.norm(end - start, axis=1), minlength=len(tree))


def pieces(tree: TreeSkeleton):
    """(row, start, end, number along the row) of every straight piece of every row that is not a base."""
    count = np.where(tree.is_base, 0, np.diff(tree.curve_start) + 1)
    owner = np.repeat(np.arange(len(tree)), count)
    number = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    points = np.concatenate([tree.curve_points, np.zeros((1, 3))])
    at = tree.curve_start[owner] + number
    first, last = number == 0, number == count[owner] - 1
    start = np.where(first[:, None], tree.start[owner], points[np.where(first, -1, at - 1)])
    end = np.where(last[:, None], tree.tip[owner], points[np.where(last, -1, at)])
    return owner, start, end, number


def start_radius(tree: TreeSkeleton) -> Float[np.ndarray, " segment"]:
    """Radius where each row starts, metres: its parent's if that is of the same limb, else its own."""
    above = np.where(tree.parent == NULL, np.arange(len(tree)), tree.parent)
    goes_on = (tree.limb[above] == tree.limb) | (tree.parent[above] == NULL)
    return np.where(goes_on, tree.radius[above], tree.radius)


def _shortened(tree: TreeSkeleton, rows, share) -> TreeSkeleton:
    """The tree with the tips of some rows at their shares."""
    tip, radius = np.array(tree.tip), np.array(tree.radius)
    part = share[rows, None]
    tip[rows] = tree.start[rows] + part * tree.vector[rows]
    radius[rows] = (1 - share[rows]) * start_radius(tree)[rows] + share[rows] * tree.radius[rows]
    drop = np.zeros(len(tree.curve_points), bool)
    for row in rows[np.diff(tree.curve_start)[rows] > 0]:
        tip[row], past = _along(tree.curve(row), share[row])
        drop[tree.curve_start[row] : tree.curve_start[row + 1]] = past
    start = tree.curve_start - np.r_[0, np.cumsum(drop)][tree.curve_start]
    return tree.replace(tip=tip, radius=radius, curve_points=tree.curve_points[~drop], curve_start=start)


def _along(path, share: float):
    """(the point at a share of a path, which of its inner points lie at or past it)."""
    run = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))]
    at = share * run[-1]
    return [np.interp(at, run, path[:, axis]) for axis in range(3)], run[1:-1] >= at


def _kept(tree: TreeSkeleton, keep) -> Cut:
    return Cut(tree if keep.all() else tree.select(keep), np.flatnonzero(keep))
