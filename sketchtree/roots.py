"""What of a tree is below the ground? Drawn roots run from a base downward; no stage that grows a crown may touch them.

Depth. Roots leave a stem to all sides and dive about alike, so one that is drawn steep runs towards the viewer or away
from him (ours):

    h = |Δy| / tan φ,   Δz = ± √(h² − Δx²)₊,   h ≤ R

    Δx, Δy   from the foot of a root to its tip, on the page        R   the longest |Δx| of all roots of the stem
    φ        how steep roots of this stem dive: the lower quartile of their drawn slopes

The sign is the one that lies farther, in azimuth, from the roots placed before. A root that goes straight down and
deepest of all is a tap root: it stays in the page's plane. Side roots lean half as far out as they are long, by turns.

Radius. At the stem Σ r_i² = r_stem², shared by length; each tapers to its tip.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.sketch.graph import SketchGraph
from sketchtree.skeleton import Kind, TreeSkeleton

TAP = 0.2  # a tap root goes sideways less than this much of its depth
LEAN = 0.5  # of its length: how far a side root leaves its parent's plane
STOUT = 0.75  # of the stem's radius: no root is thicker
SLENDER = 0.15  # radius of a root's tip / radius of its foot


def is_root(tree: TreeSkeleton) -> Bool[np.ndarray, " segment"]:
    """Rows that are roots."""
    return tree.kind == int(Kind.ROOT)


def without_roots(tree: TreeSkeleton) -> tuple[TreeSkeleton, Int[np.ndarray, " kept"]]:
    """(the tree above the ground, the rows it keeps)."""
    kept = np.flatnonzero(~is_root(tree))
    return (tree if len(kept) == len(tree) else tree.select(~is_root(tree))), kept


def with_roots(tree: TreeSkeleton, whole: TreeSkeleton, row_of: Int[np.ndarray, " segment"]) -> TreeSkeleton:
    """`tree` and, after its rows, the roots of `whole`; `row_of` says where each other row of `whole` stands in `tree`."""
    rows = np.flatnonzero(is_root(whole))
    if len(rows) == 0:
        return tree
    at = np.array(row_of, np.int64)
    at[rows] = len(tree) + np.arange(len(rows))
    columns = {name: np.concatenate([getattr(tree, name), getattr(whole, name)[rows]]) for name in _COLUMNS}
    columns["parent"][len(tree) :] = at[whole.parent[rows]]
    inner = [whole.curve_points[whole.curve_start[row] : whole.curve_start[row + 1]] for row in rows]
    count = np.diff(whole.curve_start)[rows]
    return TreeSkeleton(
        **columns,
        curve_points=np.concatenate([tree.curve_points, *inner]),
        curve_start=np.concatenate([tree.curve_start, tree.curve_start[-1] + np.cumsum(count)]),
    )


def root_depth(graph: SketchGraph) -> Float[np.ndarray, " segment"]:
    """z of every root's tip, sketch units, towards the viewer; 0 on all other rows."""
    depth = np.zeros(len(graph))
    below = graph.root[graph.limb_first]
    main = [k for k in np.flatnonzero(below) if not graph.root[graph.parent[graph.limb_first[k]]]]
    reach = _main_reaches(graph, main)
    side = 1.0
    for limb in sorted(np.flatnonzero(below), key=lambda k: graph.limb_first[k]):
        rows = np.flatnonzero((graph.limb == limb) & graph.root)
        start = depth[graph.parent[rows[0]]]
        along = np.cumsum([_length(graph.curve(row)) for row in rows])
        if limb in reach:
            rise = reach[limb]
        else:
            rise, side = side * LEAN * along[-1], -side
        depth[rows] = start + rise * along / max(along[-1], 1e-300)
    return depth


def root_radius(
    tree: TreeSkeleton, radius: Float[np.ndarray, " segment"], drawn: Float[np.ndarray, " segment"] | None, twig: float
) -> Float[np.ndarray, " segment"]:
    """`radius` with that of every root filled in, metres; drawn radii count where there are any (NaN: none)."""
    radius = np.array(radius, float)
    rows = np.flatnonzero(is_root(tree))
    beyond = _beyond(tree, rows)
    share = np.zeros(len(tree))
    for row in rows:
        if not is_root(tree)[tree.parent[row]]:
            share[tree.parent[row]] += beyond[row]
    foot, total = np.zeros(len(tree)), np.zeros(len(tree))
    root, length = is_root(tree), tree.length
    for row in rows:
        above = tree.parent[row]
        if not root[above]:
            most = STOUT * radius[above]
            foot[row], total[row] = min(most, radius[above] * np.sqrt(beyond[row] / max(share[above], 1e-300))), beyond[row]
        elif tree.limb[above] == tree.limb[row]:
            foot[row], total[row] = foot[above], total[above]
        else:
            foot[row], total[row] = STOUT * radius[above], beyond[row]
        left = (beyond[row] - length[row]) / max(total[row], 1e-300)
        radius[row] = max(foot[row] * (SLENDER + (1 - SLENDER) * np.clip(left, 0.0, 1.0)), twig)
        if drawn is not None and np.isfinite(drawn[row]):
            radius[row] = max(drawn[row], twig)
        radius[row] = min(radius[row], radius[above])
    return radius


def _main_reaches(graph: SketchGraph, main: list[int]) -> dict[int, float]:
    """Signed Δz of every root that starts at a stem, stem by stem."""
    found: dict[int, float] = {}
    for base in sorted({int(graph.parent[graph.limb_first[k]]) for k in main}):
        limbs = [k for k in main if graph.parent[graph.limb_first[k]] == base]
        span = np.array([graph.xy[_last_root(graph, k)] - graph.xy[base] for k in limbs])
        found |= dict(zip(limbs, _reaches(span), strict=True))
    return found


def _reaches(span: Float[np.ndarray, "root 2"]) -> list[float]:
    across, down = np.abs(span[:, 0]), np.abs(span[:, 1])
    steep = np.quantile(down / np.maximum(across, 1e-9 * down.max(initial=1e-300)), 0.25)
    out = np.minimum(down / max(steep, 1e-9), across.max(initial=0.0))
    size = np.sqrt(np.maximum(out**2 - across**2, 0.0))
    tap = int(np.argmax(down))
    if across[tap] < TAP * down[tap]:
        size[tap] = 0.0
    taken = [np.arctan2(0.0, x) for x, d in zip(span[:, 0], size, strict=True) if d == 0.0]
    reach = np.zeros(len(span))
    for k in np.argsort(across, kind="stable"):
        if size[k] > 0.0:
            sign = max((1.0, -1.0), key=lambda s: _apart(np.arctan2(s * size[k], span[k, 0]), taken))
            reach[k] = sign * size[k]
            taken.append(np.arctan2(reach[k], span[k, 0]))
    return reach.tolist()


def _apart(azimuth: float, taken: list[float]) -> float:
    """Least angle from the azimuths that are taken, to a thousandth."""
    return round(min((abs(np.angle(np.exp(1j * (azimuth - other)))) for other in taken), default=np.pi), 3)


def _last_root(graph: SketchGraph, limb: int) -> int:
    return int(np.flatnonzero((graph.limb == limb) & graph.root)[-1])


def _length(points: Float[np.ndarray, "point 2"]) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def _beyond(tree: TreeSkeleton, rows: Int[np.ndarray, " root"]) -> Float[np.ndarray, " segment"]:
    """Metres of root from the start of every root's row on, side roots included."""
    beyond, length = np.zeros(len(tree)), tree.length
    root = is_root(tree)
    for row in rows[::-1]:
        beyond[row] += length[row]
        if tree.parent[row] != NULL and root[tree.parent[row]]:
            beyond[tree.parent[row]] += beyond[row]
    return beyond


_COLUMNS = ("parent", "tip", "radius", "order", "limb", "stroke", "tree", "kind", "depth_sd", "age")
