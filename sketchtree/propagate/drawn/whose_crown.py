"""Whose is a crown that was drawn, where a drawing shows several trees?

An outline is the crown of every tree that has `_MUCH` of its own drawn wood above the lowest point of the outline inside it; where no
tree has, of the tree that has most wood inside, and else of the tree whose drawn tip is nearest to it. A tree without an outline
has the crown that its limbs imply.
"""

import numpy as np
import shapely
from jaxtyping import Float

from sketchtree.skeleton import TreeSkeleton

_MUCH = 0.5


def outlines_of_trees(trees: list[TreeSkeleton], outlines: tuple) -> list[tuple]:
    """The outlines (each point 2, world metres) of each tree."""
    if len(trees) == 1:
        return [tuple(outlines)]
    found: list[list] = [[] for _ in trees]
    for outline in outlines:
        for k in _owners(trees, np.asarray(outline, float)):
            found[k].append(outline)
    return [tuple(its) for its in found]


def _owners(trees, outline: Float[np.ndarray, "point 2"]) -> list[int]:
    area = shapely.make_valid(shapely.Polygon(outline))
    wood = np.array([_wood(tree, area, outline[:, 1].min()) for tree in trees])
    share = wood[:, 0] / np.maximum(wood[:, 1], 1e-12)
    if (share >= _MUCH).any():
        return np.flatnonzero(share >= _MUCH).tolist()
    if wood[:, 0].max() > 0:
        return [int(np.argmax(wood[:, 0]))]
    away = [shapely.distance(area, shapely.points(tree.tip[~tree.is_base][:, :2])).min(initial=np.inf) for tree in trees]
    return [int(np.argmin(away))]


def _wood(tree: TreeSkeleton, area, lowest: float) -> tuple[float, float]:
    """(metres of drawn wood inside, metres of it above the lowest point), on the page, by the middles of the rows."""
    middle = 0.5 * (tree.start + tree.tip)[:, :2]
    length = np.linalg.norm(tree.vector[:, :2], axis=1)
    return float(length[shapely.contains_xy(area, *middle.T)].sum()), float(length[middle[:, 1] >= lowest].sum())
