"""Which limbs are siblings, and which tips compete?

Siblings are limbs on one parent limb, in the order of their insertions; a pair's rank gap d is the
difference of their ranks, at most 3. Competitors are limb tips, and the middles of long limbs, near enough on
the page to matter: exp(−λ d / R_c) with λ = 5 falls below .003 at 1.2 R_c. A point keeps its nearest sixteen
among those after it (four in very large drawings), so that the pairs grow with the drawing and not with its square.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL

RANK_GAP = 3
REACH = 1.2  # of R_c
NEAREST = 16
NEAREST_OF_MANY = 4  # where there are more than
MANY = 2048
LONG = 0.25  # a limb longer than this (H = 1) also competes at its middle


def sibling_pairs(
    limb_parent: Int[np.ndarray, " limb"], insertion: Float[np.ndarray, " limb"]
) -> tuple[Int[np.ndarray, "sibling_pair 2"], Int[np.ndarray, " sibling_pair"]]:
    """Pairs of limbs on one parent limb with a rank gap of at most three, and the gaps."""
    ranked = np.lexsort((np.arange(len(limb_parent)), insertion, limb_parent))
    ranked = ranked[limb_parent[ranked] != NULL]
    pairs, gaps = [np.zeros((0, 2), np.int64)], [np.zeros(0, np.int64)]
    for gap in range(1, RANK_GAP + 1):
        pair = np.stack([ranked[:-gap], ranked[gap:]], axis=1)
        pair = pair[limb_parent[pair[:, 0]] == limb_parent[pair[:, 1]]]
        pairs.append(pair)
        gaps.append(np.full(len(pair), gap))
    return np.concatenate(pairs), np.concatenate(gaps)


def competitors(
    graph, length: Float[np.ndarray, " segment"], limb_length: Float[np.ndarray, " limb"]
) -> Int[np.ndarray, " competitor"]:
    """Rows whose tips compete: every limb's last, and the middle one of long limbs."""
    rows = [int(tip) for tip in graph.limb_tip]
    for limb in np.flatnonzero(limb_length > LONG):
        chain = np.flatnonzero((graph.limb == limb) & ~graph.is_base)
        if len(chain) >= 3:
            half = np.cumsum(length[chain]) - limb_length[limb] / 2
            rows.append(int(chain[np.argmin(np.abs(half[:-1]))]))
    return np.unique(rows)


def competition_pairs(
    graph, xy: Float[np.ndarray, "segment 2"], rows: Int[np.ndarray, " competitor"], *, radius: float
) -> Int[np.ndarray, "competition_pair 2"]:
    """Pairs of competing rows, each once; rows of one limb, a parent and its child, and children of one
    node do not compete."""
    if len(rows) < 2:
        return np.zeros((0, 2), np.int64)
    nearest = NEAREST if len(rows) <= MANY else NEAREST_OF_MANY
    count = min(len(rows), 2 * nearest + 1)
    distance, near = cKDTree(xy[rows]).query(xy[rows], k=count)
    keep = (distance < REACH * radius) & (near > np.arange(len(rows))[:, None])
    keep &= np.cumsum(keep, axis=1) <= nearest
    first, second = rows[np.nonzero(keep)[0]], rows[near[keep]]
    parent, limb = graph.parent, graph.limb
    apart = (limb[first] != limb[second]) & (parent[first] != parent[second])
    apart &= (parent[first] != second) & (parent[second] != first)
    return np.stack([first, second], axis=1)[apart]
