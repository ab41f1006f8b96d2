"""How large are the leaves at a time?

A leaf begins to unfold when the wood under it has its length, and is whole `UNFOLDS` later: fast at first, then slower, as leaves do. All
are whole at time 1. Where leaves stand on all wood, those of wood that is older than `LIFE` shrink away again: that wood is bare in the final tree.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.growth.age import WHOLE

UNFOLDS = 1.0 - WHOLE
LIFE = 0.3  # of the tree's time


def unfolded(time: float, end: Float[np.ndarray, " segment"], *, falling: bool = False) -> Float[np.ndarray, " segment"]:
    """Size of the leaves on wood that has its length at `end`, 0-1 of their final size."""
    scale = _eased((time - end) / UNFOLDS)
    return scale * _eased(1.0 - (time - end - LIFE) / UNFOLDS) if falling else scale


def _eased(share):
    share = np.clip(share, 0.0, 1.0)
    return np.where(share > 1 - 1e-9, 1.0, 1.0 - (1.0 - share) ** 2)
