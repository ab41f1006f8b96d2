"""Which branches pass through each other, and how far must they move?

Two segments do so where their axes come nearer than the mean of their radii,

    d_ik < ½ (r_i + r_k)          i, k not of one limb, sharing no node and no grandparent (forks are meant to touch)

and each tip, with all that grows from it, gives way by half of what is missing along z.
"""

import numpy as np
import shapely
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.mrf.factor_graph import FactorGraph

_SPARE = 1.05  # how much farther than they must the two move


def pushes(
    graph: FactorGraph, depth: Float[np.ndarray, " segment"], pair: Int[np.ndarray, "pair 2"]
) -> Float[np.ndarray, " segment"]:
    """How far each tip must give way along z, its descendants with it; 0 where nothing overlaps."""
    push = np.zeros(len(graph))
    between = _between(graph, depth, pair)
    need = 0.5 * (graph.radius[pair[:, 0]] + graph.radius[pair[:, 1]])
    hit = np.flatnonzero(np.linalg.norm(between, axis=1) < need)
    across = np.linalg.norm(between[hit, :2], axis=1)
    deep = between[hit, 2]
    missing = _SPARE * np.sqrt(np.maximum(need[hit] ** 2 - across**2, 0.0)) - np.abs(deep)
    side = np.where(deep >= 0, 1.0, -1.0)
    for (i, k), by in zip(pair[hit], 0.5 * side * np.maximum(missing, 0.0), strict=True):
        for row, step in ((i, by), (k, -by)):
            push[row] = step if abs(step) > abs(push[row]) else push[row]
    stem_start = ~graph.is_base & graph.is_base[np.maximum(graph.parent, 0)] & (graph.limb_parent[graph.limb] == NULL)
    return np.where(stem_start, 0.0, push)


def overlapping(graph: FactorGraph, depth: Float[np.ndarray, " segment"]) -> Int[np.ndarray, "pair 2"]:
    """Pairs of segments that pass through each other at these depths (H = 1)."""
    pair = candidates(graph)
    need = 0.5 * (graph.radius[pair[:, 0]] + graph.radius[pair[:, 1]])
    return pair[np.linalg.norm(_between(graph, depth, pair), axis=1) < need]


def candidates(graph: FactorGraph) -> Int[np.ndarray, "pair 2"]:
    """Pairs of segments that lie so near on the page that they may overlap in space, and are no kin."""
    row = np.flatnonzero(~graph.is_base)
    if len(row) < 2:
        return np.zeros((0, 2), np.int64)
    lines = shapely.linestrings(np.stack([graph.xy[graph.parent[row]], graph.xy[row]], axis=1))
    widest = float(graph.radius[row].max())
    near = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=widest).T
    near = near[near[:, 0] < near[:, 1]]
    i, k = row[near[:, 0]], row[near[:, 1]]
    up = graph.parent
    up2 = np.where(up == NULL, NULL, up[up])
    no_kin = (up[i] != up[k]) & (up[i] != k) & (up[k] != i) & (graph.limb[i] != graph.limb[k])
    no_kin &= (up2[i] != up[k]) & (up2[k] != up[i]) & (up2[i] != k) & (up2[k] != i)
    return np.stack([i, k], axis=1)[no_kin]


def _between(graph, depth, pair):
    """The vector from k to i where the two segments of each pair are nearest (Ericson 2005, §5.1.9)."""
    tip = np.c_[graph.xy, depth]
    (p, r), (q, s) = (tip[graph.parent[pair]].transpose(1, 0, 2), tip[pair].transpose(1, 0, 2))
    d, e, gap = q - p, s - r, p - r
    a, b, c, f, ee = (np.sum(x * y, axis=1) for x, y in ((d, d), (d, e), (d, gap), (e, gap), (e, e)))
    area = a * ee - b * b
    slanted = area > 1e-12 * np.maximum(a * ee, 1e-12)
    t = np.where(slanted, np.clip((b * f - c * ee) / np.where(slanted, area, 1.0), 0, 1), 0.0)
    u = (b * t + f) / np.maximum(ee, 1e-12)
    t = np.where(u < 0, np.clip(-c / np.maximum(a, 1e-12), 0, 1), t)
    t = np.where(u > 1, np.clip((b - c) / np.maximum(a, 1e-12), 0, 1), t)
    return gap + d * t[:, None] - e * np.clip(u, 0, 1)[:, None]
