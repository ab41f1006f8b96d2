"""Which limb does every limb grow out of, where the wood is to hang together?

Each stem stands on a base. Where several limbs start at one base (stems of a coppice, roots drawn below the ground), the
thickest that is no root carries the others, which leave it at the height of the ground.
"""

from dataclasses import replace

import numpy as np

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines
from sketchtree.skeleton import Kind, TreeSkeleton


def joined(lines: CentreLines, tree: TreeSkeleton) -> CentreLines:
    """The same lines with one limb without a parent for every base of the tree."""
    loose = np.flatnonzero(lines.parent == NULL)
    first = lines.first_row[loose]
    base = _base(tree)[first]
    root = tree.kind[first] == int(Kind.ROOT)
    rank = np.lexsort((-lines.radius[lines.start[:-1]][loose], root, ~lines.is_stem[loose], base))
    loose, base = loose[rank], base[rank]
    leads = np.r_[True, np.diff(base) != 0][: len(loose)]
    main = loose[leads][np.cumsum(leads) - 1]
    parent, parent_s = lines.parent.copy(), lines.parent_s.copy()
    is_stem, ground = lines.is_stem.copy(), lines.ground.copy()
    others = loose[~leads]
    parent[others], parent_s[others] = main[~leads], ground[main[~leads]]
    is_stem[others], ground[others] = False, 0.0
    return replace(lines, parent=parent, parent_s=parent_s, is_stem=is_stem, ground=ground)


def _base(tree: TreeSkeleton):
    """The base that each row stands on, by pointer doubling."""
    up = np.where(tree.is_base, np.arange(len(tree)), tree.parent)
    while len(up) and (up[up] != up).any():
        up = up[up]
    return up
