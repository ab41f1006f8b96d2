"""How are several skeletons one table, and one table's rows put in another order?"""

import dataclasses

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton

_COLUMNS = tuple(field.name for field in dataclasses.fields(TreeSkeleton) if not field.name.startswith("curve_"))


def joined(trees: list[TreeSkeleton]) -> TreeSkeleton:
    """All rows, one skeleton after the other, with their numbers of trees, strokes and limbs as they are."""
    first = np.cumsum([0, *map(len, trees)])
    columns = {name: np.concatenate([getattr(tree, name) for tree in trees]) for name in _COLUMNS}
    columns["parent"] = np.concatenate([np.where(t.parent == NULL, NULL, t.parent + k) for t, k in zip(trees, first, strict=False)])
    points = np.concatenate([tree.curve_points for tree in trees])
    count = np.concatenate([np.diff(tree.curve_start) for tree in trees])
    return TreeSkeleton(**columns, curve_points=points, curve_start=np.r_[0, np.cumsum(count)])


def reordered(tree: TreeSkeleton, order: Int[np.ndarray, " segment"]) -> TreeSkeleton:
    """The same rows in another order, in which parents still precede their children."""
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    columns = {name: getattr(tree, name)[order] for name in _COLUMNS}
    columns["parent"] = np.where(columns["parent"] == NULL, NULL, place[columns["parent"]])
    count = np.diff(tree.curve_start)[order]
    start = np.r_[0, np.cumsum(count)]
    point = np.repeat(tree.curve_start[:-1][order] - start[:-1], count) + np.arange(start[-1])
    return TreeSkeleton(**columns, curve_points=tree.curve_points[point], curve_start=start)


def moved(tree: TreeSkeleton, by: Float[np.ndarray, " 3"]) -> TreeSkeleton:
    """The same tree elsewhere, metres."""
    return tree.replace(tip=tree.tip + by, curve_points=tree.curve_points + by)
