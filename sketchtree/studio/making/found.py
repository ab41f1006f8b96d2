"""An undrawn limb of the tree that is shown, by its id: as it would be if it were kept by hand."""

import numpy as np

from sketchtree.drawn_tree import DrawnTree
from sketchtree.editing.edits import Adopted
from sketchtree.editing.turning import on_page
from sketchtree.errors import OptionError
from sketchtree.limb_ids import stroke_limb_id
from sketchtree.skeleton import TreeSkeleton


def found_limb(drawn: DrawnTree, tree: TreeSkeleton, limb: int) -> Adopted:
    """Raises OptionError where there is none of that id."""
    rows = np.flatnonzero((tree.limb == limb) & ~tree.is_base)
    if not len(rows) or limb in drawn.settled.limbs:
        raise OptionError("That branch is not there any more.", remedy="Pick it again on the tree as it is now.")
    above = int(tree.parent[rows[0]])
    parent = int(tree.limb[above])
    on = None if parent in drawn.settled.limbs else found_limb(drawn, tree, parent)
    page = drawn.similarity.to_sketch(np.concatenate([tree.tip[above][None], *[tree.curve(row)[1:] for row in rows]]))
    share = _share(drawn, tree, above, parent)
    radius = float(tree.radius[rows[0]]) / drawn.similarity.scale
    own = stroke_limb_id(f"adopted {limb}")
    return Adopted(own, parent if on is None else on.limb, share, page - page[0], radius, was=limb, foot=page[0], on=on)


def _share(drawn: DrawnTree, tree: TreeSkeleton, row: int, limb: int) -> float:
    """How far along its limb the tip of a row is, on the page that limb was drawn on."""
    known = drawn.settled.limbs.get(limb)
    rows = np.flatnonzero((tree.limb == limb) & ~tree.is_base)
    if not len(rows) or row not in rows:
        return 0.0
    points = [tree.curve(one) for one in rows]
    view, axis = (known.view_deg, drawn.settled.axis * drawn.similarity.scale + drawn.similarity.translate[0]) if known else (0.0, 0.0)
    lengths = [float(np.linalg.norm(np.diff(on_page(line, view, axis)[:, :2], axis=0), axis=1).sum()) for line in points]
    upto = sum(length for one, length in zip(rows, lengths, strict=True) if one <= row)
    return float(np.clip(upto / max(sum(lengths), 1e-300), 0.0, 1.0))
