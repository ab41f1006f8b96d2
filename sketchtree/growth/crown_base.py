"""Where does a tree's crown begin? At the first fork with a limb that deserves the name: below it no branch is grafted on."""

from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import limb_chains

LIMB = 0.05  # of the tree's height: how long a limb is at least


def crown_base(tree: TreeSkeleton) -> float | None:
    """The height, in its own units, of the lowest fork from which such a limb grows; None where there is none."""
    length = tree.length
    forks = [
        float(tree.tip[tree.parent[rows[0]], 1])
        for rows in limb_chains(tree.parent, tree.limb)
        if tree.parent[rows[0]] >= 0 and tree.kind[rows[0]] != int(Kind.ROOT) and not tree.is_base[tree.parent[rows[0]]] and length[rows].sum() >= LIMB * tree.height
    ]
    return min(forks, default=None)
