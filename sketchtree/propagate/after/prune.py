"""What is left of a tree once it is pruned by planes and meshes?

A user's edit: unlike every other stage it cuts drawn wood too. A row that leaves the shape is cut where it first does, along
its drawn points, and keeps its radius there; all that grew beyond is gone, also what comes back into the shape farther on.
It runs last, on final radii. Roots are cut by planes they cross, by meshes never.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.axes import NULL
from sketchtree.errors import OptionError
from sketchtree.propagate.after.cutting import Cut, cut, path_length, pieces
from sketchtree.propagate.after.shears import Shears, shears
from sketchtree.roots import is_root
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import is_tip

_LIFT = 1e-3  # of the tree's height: a base this far below the lowest point of a shape still stands in it


@dataclass(frozen=True, eq=False)
class Pruned(Cut):
    """What is left, and how many drawn strokes were cut or dropped."""

    strokes_cut: int


@dataclass(frozen=True)
class Prune:
    """A stage that cuts a tree to shape. Nothing it leaves is moved."""

    shapes: tuple[str | Shears, ...] = ()  # each as on the command line (`shears.shears`), or made already

    def __post_init__(self):
        made = tuple(shears(shape) if isinstance(shape, str) else shape for shape in self.shapes)
        object.__setattr__(self, "shapes", made)

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""] | None = None) -> TreeSkeleton:
        """The tree as it is left. `key` is part of the stage's door; nothing here is random."""
        return self.run(tree).skeleton

    def run(self, tree: TreeSkeleton) -> Pruned:
        """As the call, with the rows that are left and the strokes that were cut. Raises OptionError if nothing is left."""
        if not self.shapes or tree.segment_count == 0:
            return Pruned(tree, np.arange(len(tree)), 0)
        share = np.ones(len(tree))
        for shape in self.shapes:
            share = np.minimum(share, share_inside(tree, shape))
        left = _without_bare_feet(cut(tree, share))
        if left.skeleton.segment_count == 0:
            raise OptionError(
                "Pruning cuts the tree off at its foot, so nothing is left.",
                remedy="Turn the plane's `<` round, or let the mesh reach down to the ground (the trunk's root is at the origin).",
            )
        return Pruned(left.skeleton, left.rows, _strokes_cut(tree, left.rows, share))


def _without_bare_feet(left: Cut) -> Cut:
    """The same without the bases that bear nothing any more."""
    tree = left.skeleton
    keep = ~(tree.is_base & is_tip(tree.parent))
    return left if keep.all() else Cut(tree.select(keep), left.rows[keep])


def share_inside(tree: TreeSkeleton, shape: Shears) -> Float[np.ndarray, " segment"]:
    """The share of every row's path up to where it first leaves the shape; 1 where it does not. A base is in or out."""
    share = np.ones(len(tree))
    lift = np.array([0.0, _LIFT * tree.height, 0.0])
    stands = shape.inside(tree.tip) & tree.is_base
    lifted = shape.inside(tree.tip + lift) & tree.is_base & ~stands
    share[tree.is_base] = (stands | lifted)[tree.is_base]
    row, start, end, number = pieces(tree)
    roots = is_root(tree)
    from_ground = (number == 0) & lifted[tree.parent[row]] & ~roots[row]
    start = np.where(from_ground[:, None], start + lift, start)
    share = _first_exit(tree, share, row, start, end, shape.exit_fraction(start, end))
    return share if shape.cuts_roots else np.where(roots, 1.0, share)


def _first_exit(tree, share, row, start, end, free):
    """The share of each row's path up to the first piece that leaves."""
    length = np.linalg.norm(end - start, axis=1)
    before = np.cumsum(length) - length
    first = np.r_[True, row[1:] != row[:-1]] if len(row) else np.zeros(0, bool)
    before = before - np.maximum.accumulate(np.where(first, before, 0.0))
    whole = path_length(tree)[row]
    out = free < 1.0
    at = (before + free * length)[out] / np.maximum(whole[out], 1e-300)
    share = np.array(share)
    np.minimum.at(share, row[out], at)
    return share


def _strokes_cut(tree: TreeSkeleton, rows, share) -> int:
    drawn = np.isin(tree.kind, (int(Kind.DRAWN), int(Kind.ROOT), int(Kind.OBSERVED))) & (tree.stroke != NULL) & ~tree.is_base
    lost = np.ones(len(tree), bool)
    lost[rows] = share[rows] < 1.0
    return len(np.unique(tree.stroke[drawn & lost]))
