"""What habit has a digitised tree? What can be measured on it, measured; the rest as another exemplar has it, or by default.

    height, trunk_ratio     of the skeleton; the thickest base over the height
    pipe_exponent           n with r^n = Σ r_child^n, the median over forks whose radii tell (r above every child's)
    twig_radius             median radius at the tips
    whorl, arrangement      the commonest number of laterals a node; 1 alternate, 2 opposite, 3+ whorled
    lateral_spacing         median distance along a limb between nodes that bear laterals
    lateral_ratio           median of the length of a lateral over that of the limb it sits on
    lateral_angle           mean divergence of laterals of order 2 and more, else of order 1
    twig_length             lower quartile of the lengths of limbs that bear none
    apical_control          1/2 − r/2, r the correlation between place on the trunk and length of its laterals
"""

import dataclasses

import numpy as np

from sketchtree.axes import NULL
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.limb_statistics import limb_statistics
from sketchtree.traverse import children, is_tip, limb_chains

FEW = 5  # of a kind, below which nothing is estimated from it
LOWEST, HIGHEST = 1.2, 4.0  # pipe exponents that a tree has
WHORLS = 12  # the most laterals a node that are counted


def habit_from_tree(tree: TreeSkeleton, *, like: Habit | None = None) -> Habit:
    """The habit of a skeleton in metres. Leaves, bark, gravitropism and whatever can't be measured are those of `like`."""
    like = Habit() if like is None else like
    measured = {
        "height": tree.height,
        "trunk_ratio": float(tree.radius[tree.is_base].max() / max(tree.height, 1e-6)),
        "pipe_exponent": _pipe_exponent(tree),
        "twig_radius": float(np.median(tree.radius[is_tip(tree.parent)])),
        "max_order": int(min(tree.order.max(), 12)),
        **_laterals(tree),
    }
    limits = {
        "height": (0.05, 150), "trunk_ratio": (0.001, 0.2), "twig_radius": (1e-4, 0.1), "lateral_spacing": (0.01, 20),
        "lateral_ratio": (0, 4), "twig_length": (0.01, 20),
    }  # fmt: skip
    known = {name: value for name, value in measured.items() if value is not None}
    for name, (low, high) in limits.items():
        if name in known:
            known[name] = float(np.clip(known[name], low, high))
    return dataclasses.replace(like, **{name: round(value, 6) if isinstance(value, float) else value for name, value in known.items()})


def _pipe_exponent(tree: TreeSkeleton) -> float | None:
    child, start = children(tree.parent)
    found = []
    for row in np.flatnonzero(np.diff(start) >= 2):
        ratio = tree.radius[child[start[row] : start[row + 1]]] / tree.radius[row]
        if ratio.max() < 1 and LOWEST <= (n := _exponent(ratio)) <= HIGHEST:
            found.append(n)
    return float(np.median(found)) if len(found) >= FEW else None


def _exponent(ratio) -> float:
    """n with Σ ratio^n = 1, by halving."""
    low, high = 0.0, 16.0
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if (ratio**middle).sum() > 1 else (low, middle)
    return low


def _laterals(tree: TreeSkeleton) -> dict:
    chains = limb_chains(tree.parent, tree.limb)
    each = tree.length
    length = {int(tree.limb[rows[0]]): float(each[rows].sum()) for rows in chains}
    first = np.array([rows[0] for rows in chains if tree.parent[rows[0]] != NULL], int)
    first = first[tree.order[first] > tree.order[tree.parent[first]]]
    if len(first) < FEW:
        return {}
    node, bearer = tree.parent[first], tree.limb[tree.parent[first]]
    along = _place(tree, chains)
    ratio = [length[int(tree.limb[row])] / max(length[int(on)], 1e-9) for row, on in zip(first, bearer, strict=True)]
    found = {"lateral_ratio": float(np.median(ratio)), "lateral_spacing": _spacing(node, bearer, along)}
    a_node = np.unique(node, return_counts=True)[1]
    whorl = int(np.argmax(np.bincount(np.minimum(a_node, WHORLS))))
    found |= {"whorl": whorl, "arrangement": ("alternate", "opposite")[whorl - 1] if whorl <= 2 else "whorled"}
    limbs = limb_statistics(tree)
    rank = 1 if limbs.divergence_count[1] >= FEW else 0
    if limbs.divergence_count[rank] >= FEW:
        found["lateral_angle"] = float(np.degrees(limbs.divergence_mean[rank]))
    barren = [value for limb, value in length.items() if limb not in set(bearer.tolist()) and value > 0]
    found["twig_length"] = float(np.quantile(barren, 0.25)) if len(barren) >= FEW else None
    on_trunk = tree.order[first] == 1
    place, size = along[node[on_trunk]], np.array([length[int(limb)] for limb in tree.limb[first[on_trunk]]])
    if on_trunk.sum() >= FEW and place.std() > 0 and size.std() > 0:
        found["apical_control"] = float(0.5 - 0.5 * np.corrcoef(place, size)[0, 1])
    return found


def _place(tree: TreeSkeleton, chains):
    """How far along its limb every row ends, metres."""
    along, length = np.zeros(len(tree)), tree.length
    for rows in chains:
        along[rows] = np.cumsum(length[rows])
    return along


def _spacing(node, bearer, along) -> float | None:
    places = np.array(sorted({(int(limb), float(along[row])) for row, limb in zip(node, bearer, strict=True)}))
    same = np.diff(places[:, 0]) == 0
    gaps = np.diff(places[:, 1])[same]
    gaps = gaps[gaps > 1e-6]
    return float(np.median(gaps)) if len(gaps) >= FEW else None
