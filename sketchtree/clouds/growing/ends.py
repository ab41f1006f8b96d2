"""How far does wood go on where photos no longer show it? (ours)

A twig that is thinner than a pixel leaves no points, so every limb that was found ends where it became so thin. By Eq. 5 of Guo et al. 2018, d = d_root (l / l_root)^γ, wood of the
radius r that just shows bears

    l = l_root (r / r_root)^(1/γ)

metres more, and l_root is longer by the same at every end. A limb goes on by so much, but no farther than it was seen, and a spur not at all, since it may be noise; the way
it went, and tapers. What shows is no thinner than that. One that ends thick was broken or cut: it ends there.
"""

import numpy as np

from sketchtree.axes import NULL
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import is_tip

_BROKEN = 4.0  # times the radius that just shows: thicker ends are ends (thin wood comes out too thick)
_SPUR = 8.0  # the same: shorter limbs are spurs, of which half are noise
_MOST = 0.5  # of l_root, that all ends may have together
_TIP = 1 / 3  # radius at the new end over that which just shows


def gone_on(tree: TreeSkeleton, shows: float, gamma: float) -> TreeSkeleton:
    """The tree whose ends go on; the new rows are the last, kind GROWN. `shows`: radius of the thinnest wood that shows, metres."""
    seen = np.bincount(tree.limb, tree.length)[tree.limb]
    ends = np.flatnonzero(is_tip(tree.parent) & (tree.parent != NULL) & (tree.radius <= _BROKEN * shows))
    far = np.where(seen[ends] >= _SPUR * shows, np.minimum(_length(tree, ends, shows, gamma), seen[ends]), 0.0)
    way = np.array([_course(tree, row, length) for row, length in zip(ends, far, strict=True)]).reshape(-1, 3)
    kept = far > 0
    ends, far, way = ends[kept], far[kept], way[kept]
    if not len(ends):
        return tree
    more = {"parent": ends, "tip": tree.tip[ends] + far[:, None] * way, "radius": np.full(len(ends), _TIP * shows)}
    more |= {name: getattr(tree, name)[ends] for name in ("limb", "order", "tree")} | {"kind": np.full(len(ends), int(Kind.GROWN))}
    return tree.replace(radius=np.maximum(tree.radius, shows)).append(more)


def _length(tree: TreeSkeleton, ends, shows: float, gamma: float):
    """Metres that each end goes on."""
    base = np.flatnonzero(tree.parent == NULL)
    at = {tree.tree[row]: row for row in base[::-1]}
    long, count = np.bincount(tree.tree, tree.length), np.bincount(tree.tree[ends], minlength=tree.tree.max() + 1)
    far = np.zeros(len(ends))
    for name, row in at.items():
        share = min((shows / tree.radius[row]) ** (1.0 / gamma), _MOST / max(count[name], 1))  # l / l_root
        far[tree.tree[ends] == name] = share * long[name] / (1.0 - share * count[name])
    return far


def _course(tree: TreeSkeleton, row: int, length: float):
    """Which way a limb goes at its end: from so many metres before it. Where so little of the limb was seen, the way of what bears it counts for the rest: a stub says little."""
    end, back, at = tree.tip[row], 0.0, row
    while tree.parent[at] != NULL and back < length and (at == row or tree.limb[at] == tree.limb[row]):
        back += tree.length[at]
        at = tree.parent[at]
    own = _unit(end - tree.tip[at])
    sure = min(back / length, 1.0) if length > 0 else 1.0
    return _unit(own + (1.0 - sure) * _unit(tree.vector[at])) if tree.parent[at] != NULL else own


def _unit(vector):
    return vector / max(np.linalg.norm(vector), 1e-12)
