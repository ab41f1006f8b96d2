"""How does a digitised tree come to stand in our world? Metres, y up, its base at the origin."""

import numpy as np

from sketchtree.axes import NULL
from sketchtree.errors import TemplateError
from sketchtree.skeleton import Kind, TreeSkeleton

METRES = {"m": 1.0, "cm": 0.01, "mm": 0.001}
UP = {".mtg": "z", ".csv": "z", ".txt": "z"}
"""Ending → the axis that points up in such files; y in all others."""

SMALLEST, TALLEST = 0.05, 150.0  # metres: what is no tree


def stood(tree: TreeSkeleton, *, file: str, unit: str = "m", up: str = "y") -> TreeSkeleton:
    """The tree in metres, y up, the first base at the origin and nothing of its roots; limbs numbered from 0. `file` names it in errors."""
    tree = tree.select(tree.kind != int(Kind.ROOT)) if (tree.kind == int(Kind.ROOT)).any() else tree
    if tree.segment_count == 0:
        raise TemplateError(f"{file}: the tree has no segments.", remedy="Give a tree with at least one branch.")
    metres = METRES[unit]
    tip = _turned(tree.tip, up) * metres
    base = tip[int(np.flatnonzero(tree.parent == NULL)[0])]
    tall = float(np.ptp(tip[:, 1]))
    if not SMALLEST <= tall <= TALLEST:
        raise TemplateError(
            f"{file}: read in {unit} with {up} up, the tree is {tall:.4g} m tall.",
            remedy="Say in which unit it is and which way is up, with --unit m, cm or mm and --up y or z.",
        )
    _, limb = np.unique(tree.limb, return_inverse=True)
    return TreeSkeleton.from_columns(
        tree.parent, tip - base, tree.radius * metres, order=tree.order, limb=limb, tree=tree.tree,
        kind=np.full(len(tree), int(Kind.OBSERVED)),
    )  # fmt: skip


def _turned(points, up: str):
    return points if up == "y" else points[:, [0, 2, 1]] * (1.0, 1.0, -1.0)
