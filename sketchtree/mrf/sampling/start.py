"""Where do the chains begin? At trees drawn limb by limb from the root up (ancestral sampling, Chen et al. 2008, §5.2.1), each limb at one
elevation; or where somebody has told them to.

Of `TRIES` elevations, even over the sphere, one is taken for each limb with the odds

    exp(−½((a − μ_o)/σ_o)² − log(sin a + .02) − ½((r − a_o − b(u − ½))/ς_o)²)

of what its parent's elevation is in that chain; Θ is the prior's. Stems begin upright.
"""

import numpy as np
from jaxtyping import Array, Bool, Float, Key

from sketchtree.axes import NULL
from sketchtree.keys import draw_key, normal, uniform
from sketchtree.mrf.conjugate import LimbBelief
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.factors.limb_length import SLOPE

TRIES = 8
WIDEST = np.sin(np.radians(72.0))
SHAKE = 0.05  # radians, by which chains that begin at the same place differ


def starts(
    graph: FactorGraph,
    belief: LimbBelief,
    key: Key[Array, ""],
    chain_count: int,
    segments: int,
    *,
    known: Float[np.ndarray, " segment"] | None,
    held: Bool[np.ndarray, " segment"],
) -> Float[np.ndarray, "chain segment"]:
    """ψ of every chain, padded to `segments`. Where ψ is `known` (not NaN) chains begin near it, the first at it;
    rows that are `held` are the same in all."""
    word = draw_key(key)
    psi = _from_the_root(graph, belief, word, chain_count)[:, graph.limb]
    if known is not None:
        limb = np.arange(graph.limb_count)
        shake = np.array([SHAKE * normal(word, limb, chain)[graph.limb] for chain in range(chain_count)])
        shake[0] = 0.0
        psi = np.where(np.isfinite(known), np.clip(known + np.where(held, 0.0, shake), -1.36, 1.36), psi)
    start = np.zeros((chain_count, segments), np.float32)
    start[:, : len(graph)] = np.where(graph.is_base, 0.0, psi)
    return start


def _from_the_root(graph: FactorGraph, belief: LimbBelief, word, chain_count: int) -> Float[np.ndarray, "chain limb"]:
    limb = np.arange(graph.limb_count)
    tried = np.array([[uniform(word, limb, 1 + chain * (TRIES + 1) + k) for k in range(TRIES + 1)] for chain in range(chain_count)])
    psi = np.zeros((chain_count, graph.limb_count))
    (mean, _, _, square), (long, _, _, wide) = np.asarray(belief.divergence, float), np.asarray(belief.length, float)
    for j in np.argsort(graph.limb_first, kind="stable"):
        if not graph.limb_spreads[j]:
            continue
        candidate = np.arcsin(WIDEST * (2 * tried[:, :TRIES, j] - 1))
        if graph.limb_parent[j] == NULL:  # the stem of a shrub
            psi[:, j] = 0.5 * candidate[:, 0]
            continue
        above, order = psi[:, graph.limb_parent[j], None], min(int(graph.limb_order[j]), 2) - 1
        at, first = graph.parent[graph.limb_first[j]], graph.limb_first[j]
        flat = 1.0 if graph.is_base[at] else float(graph.direction[first] @ graph.direction[at])
        a = np.arccos(np.clip(np.cos(candidate) * np.cos(above) * flat + np.sin(candidate) * np.sin(above), -1, 1))
        r = np.log(max(graph.limb_length[j], 1e-9) / max(graph.limb_length[graph.limb_parent[j]], 1e-9)) + np.log(np.cos(above) / np.cos(candidate))
        away = r - long[order] - SLOPE * (graph.insertion[j] - 0.5)
        log_odds = -0.5 * (a - mean[order]) ** 2 / square[order] - np.log(np.sin(a) + 0.02) - 0.5 * away**2 / wide[order]
        odds = np.cumsum(np.exp(log_odds - log_odds.max(axis=1, keepdims=True)), axis=1)
        chosen = np.sum(tried[:, TRIES, j, None] * odds[:, -1:] > odds[:, :-1], axis=1)
        psi[:, j] = np.take_along_axis(candidate, chosen[:, None], axis=1)[:, 0]
    return psi
