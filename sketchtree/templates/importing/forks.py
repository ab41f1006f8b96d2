"""Which forks, and what between them, can be told of a tree that was traced in a point cloud? TreeSkeleton → one of segments from fork to fork.

A traced tree has a row for every layer of its points. Directions over one layer are mostly noise, and points that lie off a limb become spurs of a few layers, as
many as there are true limbs: Θ of all those rows says how points scatter. So (ours)

    limbs      shorter than `SHORT` layers, that bear none longer, are left out
    forks      nearer than `NEAR` layers to the one before on their limb are one with it
    segments   run from fork to fork, and bend where the limb lies farther from them than `BEND` layers and its own radius (Douglas & Peucker 1973)
    which      child carries on a limb: the straightest of those about as thick as the thickest (`THICK`). What is traced carries on by the longest way

A layer is the median length of a row.
"""

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import child_count, children, limb_chains

SHORT, NEAR, BEND = 8.0, 4.0, 0.5  # layers
THICK = 0.5  # of the thickest child's radius


def forked(tree: TreeSkeleton) -> TreeSkeleton:
    """The tree from fork to fork; rows of the ground stay."""
    if tree.segment_count == 0:
        return tree
    layer = float(np.median(tree.length[~tree.is_base]))
    tree = tree.select(_told(tree, SHORT * layer))
    kept = _corners(tree, layer)
    above = np.arange(len(tree))  # of every row: itself if it is kept, else the kept one before it
    for row in np.flatnonzero(~kept):
        above[row] = above[tree.parent[row]]
    rows = np.flatnonzero(kept)
    renumber = np.full(len(tree) + 1, NULL)
    renumber[rows] = np.arange(len(rows))
    parent = np.where(tree.parent[rows] == NULL, NULL, renumber[above[tree.parent[rows]]])
    return _carried_on(TreeSkeleton.from_columns(parent, tree.tip[rows], tree.radius[rows], tree=tree.tree[rows], kind=tree.kind[rows]))


def _carried_on(tree: TreeSkeleton) -> TreeSkeleton:
    """The tree with its limbs and their orders told by straightness; a base carries on in its first child."""
    child, start = children(tree.parent)
    direction = tree.vector / np.maximum(tree.length, 1e-12)[:, None]
    limb, order = np.arange(len(tree)), np.zeros(len(tree), int)
    for row in range(len(tree)):
        borne = child[start[row] : start[row + 1]]
        thick = borne[tree.radius[borne] >= THICK * tree.radius[borne].max(initial=0.0)]
        order[borne] = order[row] + 1
        if len(thick):
            on = thick[np.argmax(direction[thick] @ direction[row])]
            limb[on], order[on] = limb[row], order[row]
    return tree.replace(limb=limb, order=order)


def _told(tree: TreeSkeleton, shortest: float) -> Bool[np.ndarray, " segment"]:
    """The rows of limbs that are long enough, or bear one that is."""
    told, length, base = np.ones(len(tree), bool), tree.length, tree.is_base
    borne = np.zeros(int(tree.limb.max()) + 1, bool)
    for rows in reversed(limb_chains(tree.parent, tree.limb)):
        bearer = tree.parent[rows[0]]
        if bearer == NULL or base[bearer] or borne[tree.limb[rows[0]]] or length[rows].sum() >= shortest:
            borne[tree.limb[bearer]] |= bearer != NULL
        else:
            told[rows] = False
    return told


def _corners(tree: TreeSkeleton, layer: float) -> Bool[np.ndarray, " segment"]:
    """Bases, forks that are not one with another, tips, and rows where a limb must bend between them."""
    kept, forks, length = tree.is_base.copy(), child_count(tree.parent) > 1, tree.length
    for rows in limb_chains(tree.parent, tree.limb):
        run, kept[rows[-1]], last = np.cumsum(length[rows]), True, -np.inf
        for k in np.flatnonzero(forks[rows]):
            if run[k] - last >= NEAR * layer:
                kept[rows[k]], last = True, run[k]
        tolerance, start = max(BEND * layer, float(np.median(tree.radius[rows]))), tree.parent[rows[0]]
        path = rows if start == NULL else np.concatenate([[start], rows])
        ends = np.flatnonzero(kept[path] | (path == start))
        for low, high in zip(ends[:-1], ends[1:], strict=True):
            kept[path[low + _bends(tree.tip[path[low : high + 1]], tolerance)]] = True
    return kept


def _bends(points: Float[np.ndarray, "point 3"], tolerance: float):
    """The places at which a line of points must bend so that none lies farther than `tolerance` from it."""
    found, stretches = [], [(0, len(points) - 1)]
    while stretches:
        low, high = stretches.pop()
        if high - low < 2:
            continue
        chord, off = points[high] - points[low], points[low + 1 : high] - points[low]
        along = np.clip(off @ chord / max(chord @ chord, 1e-300), 0.0, 1.0)
        distance = np.linalg.norm(off - along[:, None] * chord, axis=1)
        worst = int(np.argmax(distance))
        if distance[worst] > tolerance:
            middle = low + 1 + worst
            found.append(middle)
            stretches += [(low, middle), (middle, high)]
    return np.array(sorted(found), int)
