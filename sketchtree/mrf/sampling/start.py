"""Where do the chains begin? One ψ a limb, N(0, .5), 0 on stems; or where somebody has told them to."""

import numpy as np
from jaxtyping import Array, Bool, Float, Key

from sketchtree.keys import draw_key, normal
from sketchtree.mrf.factor_graph import FactorGraph

SD = 0.5  # radians, of a lateral's first ψ
WIDEST = 1.2  # radians
SHAKE = 0.05  # radians, by which chains that begin at the same place differ


def starts(
    graph: FactorGraph,
    key: Key[Array, ""],
    chain_count: int,
    segments: int,
    *,
    known: Float[np.ndarray, " segment"] | None,
    held: Bool[np.ndarray, " segment"],
) -> Float[np.ndarray, "chain segment"]:
    """ψ of every chain, padded to `segments`. Where ψ is `known` (not NaN) chains begin near it, the first at it;
    rows that are `held` are the same in all."""
    start = np.zeros((chain_count, segments), np.float32)
    limb, key = np.arange(graph.limb_count), draw_key(key)
    for chain in range(chain_count):
        psi = np.clip(SD * normal(key, limb, chain), -WIDEST, WIDEST) * graph.limb_spreads
        row = psi[graph.limb]
        if known is not None:
            shake = 0.0 if chain == 0 else SHAKE * normal(key, limb, chain_count + chain)[graph.limb]
            row = np.where(np.isfinite(known), np.clip(known + np.where(held, 0.0, shake), -1.36, 1.36), row)
        start[chain, : len(graph)] = np.where(graph.is_base, 0.0, row)
    return start
