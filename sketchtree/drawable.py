"""What would a person draw of a tree? Its main limbs, in a few long segments.

A grown tree has thousands of segments, a sketch has dozens. Before its limbs are measured it is brought to a sketch's granularity:

  - the stems, and along each kept limb at most `ALONG_STEM` (a stem) or `ALONG_LIMB` (another limb)
    laterals: its insertions are cut into that many runs and the longest of each run is kept;
  - only limbs of order 3 or less, longer than `SHORTEST` of the tree's height above order 1;
  - a limb keeps its junctions, its tip, and points where it bends by more than `TOLERANCE` of the height;
    a junction nearer than that to the one before it becomes one with it, as the reading of a sketch does.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import limb_chains

ALONG_STEM = 24
ALONG_LIMB = 4
DEEPEST = 3  # order
SHORTEST = 0.1  # of the tree's height
TOLERANCE = 0.015  # of the tree's height


def drawable(
    tree: TreeSkeleton, *, along_stem: int = ALONG_STEM, along_limb: int = ALONG_LIMB, deepest: int = DEEPEST
) -> TreeSkeleton:
    """The main limbs of `tree`, simplified as a person would draw them."""
    chains = limb_chains(tree.parent, tree.limb)
    each = tree.length
    length = np.array([each[rows].sum() for rows in chains])
    owner = np.empty(len(tree), np.int64)
    for limb, rows in enumerate(chains):
        owner[rows] = limb
    above = np.array([tree.parent[rows[0]] for rows in chains])
    order = np.array([tree.order[rows[-1]] for rows in chains])
    kept = _main_limbs(tree, chains, length, owner, above, order, (along_stem, along_limb, deepest))
    return _simplify(tree, chains, above, kept)


def _main_limbs(tree, chains, length, owner, above, order, limits) -> list[int]:
    along_stem, along_limb, deepest = limits
    by_parent: dict[int, list[int]] = {}
    for limb in np.flatnonzero(above != NULL):
        by_parent.setdefault(int(owner[above[limb]]), []).append(int(limb))
    kept, queue = [], [int(limb) for limb in np.flatnonzero(above == NULL)]
    shortest = SHORTEST * tree.height
    while queue:
        limb = queue.pop(0)
        kept.append(limb)
        laterals = [c for c in by_parent.get(limb, []) if order[c] <= deepest and (order[c] <= 1 or length[c] > shortest)]
        laterals.sort(key=lambda c: (above[c], c))
        runs = np.array_split(laterals, min(len(laterals), along_stem if order[limb] == 0 else along_limb)) if laterals else []
        queue.extend(int(run[np.argmax(length[run])]) for run in runs)
    return sorted(kept)


def _simplify(tree: TreeSkeleton, chains, above, kept) -> TreeSkeleton:
    """Only the kept limbs; of their rows only bases, junctions of kept limbs, tips and bends."""
    tolerance = TOLERANCE * tree.height
    junction = np.zeros(len(tree), bool)
    junction[[above[limb] for limb in kept if above[limb] != NULL]] = True
    stands_for = np.full(len(tree), NULL)  # row that a row is drawn as; NULL: it is not drawn
    for limb in sorted(kept, key=lambda limb: tree.order[chains[limb][-1]]):
        rows = chains[limb]
        path = rows if above[limb] == NULL else np.r_[above[limb], rows]
        marks = _marks(tree.tip[path], junction[path] | tree.is_base[path], tolerance)
        if stands_for[path[0]] == NULL:
            stands_for[path[0]] = path[0]
        last = stands_for[path[0]]
        for mark in marks[1:]:
            near = np.linalg.norm(tree.tip[path[mark]] - tree.tip[last]) < tolerance
            if not near or mark == len(path) - 1:
                last = path[mark]
            stands_for[path[mark]] = last
    return _only(tree, stands_for)


def _marks(point, fixed, tolerance: float):
    """Points of a limb to keep: its ends, those that are `fixed`, and its bends between."""
    marks = np.unique(np.r_[0, np.flatnonzero(fixed), len(point) - 1])
    inner = [a + bends(point[a : b + 1], tolerance) for a, b in zip(marks[:-1], marks[1:], strict=True)]
    return np.unique(np.concatenate([marks, *inner]))


def _only(tree: TreeSkeleton, stands_for) -> TreeSkeleton:
    """The rows that stand for themselves, each under the nearest ancestor that is drawn."""
    rows = np.flatnonzero(stands_for == np.arange(len(tree)))
    renumber = np.full(len(tree) + 1, NULL)
    renumber[rows] = np.arange(len(rows))
    parent = np.full(len(rows), NULL)
    for i, row in enumerate(rows):
        at = tree.parent[row]
        while at != NULL and (stands_for[at] == NULL or stands_for[at] == row):
            at = tree.parent[at]
        parent[i] = NULL if at == NULL else renumber[stands_for[at]]
    return TreeSkeleton.from_columns(
        parent, tree.tip[rows], tree.radius[rows], order=tree.order[rows], limb=tree.limb[rows], tree=tree.tree[rows]
    )


def bends(point: Float[np.ndarray, "point axis"], tolerance: float) -> Int[np.ndarray, " bend"]:
    """Inner points a polyline must keep to stay within `tolerance` of itself (Douglas & Peucker 1973)."""
    kept, spans = [], [(0, len(point) - 1)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        away = _distance(point[first + 1 : last], point[first], point[last])
        worst = int(np.argmax(away))
        if away[worst] > tolerance:
            middle = first + 1 + worst
            kept.append(middle)
            spans += [(first, middle), (middle, last)]
    return np.array(sorted(kept), np.int64)


def _distance(point, a, b):
    along = b - a
    square = float(np.sum(along * along))
    share = np.clip(np.sum((point - a) * along, axis=1) / square, 0, 1) if square > 0 else np.zeros(len(point))
    return np.sqrt(np.sum((point - a - share[:, None] * along) ** 2, axis=1))
