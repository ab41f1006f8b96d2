"""Trees for the tests of this room."""

import numpy as np
from tests.propagate.worlds import HABIT, THETA, drawn_tree

from sketchtree import keys
from sketchtree.geometry.radii import PipeRadii
from sketchtree.propagate.generations import propagate
from sketchtree.skeleton import Kind, TreeSkeleton

KEY = keys.root_key(2)


def grown(limbs=5, generations=3, crown=()) -> TreeSkeleton:
    """A tree with its final radii."""
    found = propagate(drawn_tree(limbs), HABIT, THETA, generations=generations, crown=crown, key=KEY)
    return PipeRadii(HABIT)(found.skeleton)


def rod(points, radius=0.02, limb=1) -> TreeSkeleton:
    """A drawn post of 3 m, and on its top an undrawn limb through these points (row 2 on)."""
    points = np.asarray(points, float)
    rows = len(points) + 2
    return TreeSkeleton.from_columns(
        np.arange(-1, rows - 1), np.vstack([[0, 0, 0], [0, 3.0, 0], points]), np.r_[0.1, 0.1, np.full(len(points), radius)],
        limb=np.r_[0, 0, np.full(len(points), limb)], order=np.r_[0, 0, np.ones(len(points), int)],
        kind=np.r_[0, 0, np.full(len(points), int(Kind.PROPAGATED))],
    )  # fmt: skip


def shuffled(tree: TreeSkeleton, seed: int) -> tuple[TreeSkeleton, np.ndarray]:
    """The same tree with its rows in another order, parents first still; and which row each one was."""
    rng = np.random.default_rng(seed)
    depth = np.zeros(len(tree), int)
    for row in range(len(tree)):
        depth[row] = 0 if tree.parent[row] < 0 else depth[tree.parent[row]] + 1
    rows = np.lexsort((rng.random(len(tree)), depth))
    place = np.argsort(rows)
    names = ("tip", "radius", "order", "limb", "stroke", "tree", "kind")
    columns = {name: getattr(tree, name)[rows] for name in names}
    parent = tree.parent[rows]
    return TreeSkeleton.from_columns(np.where(parent < 0, -1, place[parent]), columns.pop("tip"), columns.pop("radius"), **columns), rows
