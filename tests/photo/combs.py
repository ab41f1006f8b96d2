"""A tree like a comb: whoever tests leaves knows every twig of it."""

import numpy as np

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton


def comb_of(spacing: float) -> TreeSkeleton:
    """A trunk, and level twigs to either side every `spacing` metres, from 0.3 m up to 1.4 m."""
    parent, tip, order, limb, trunk = [NULL], [(1.0, 0.0, 0.0)], [0], [1], 0
    for height in np.arange(0.3, 1.4, spacing):
        parent.append(trunk)
        trunk = len(parent) - 1
        tip.append((1.0, height, 0.0)), order.append(0), limb.append(1)
        for side in (-1, 1):
            parent.append(trunk), order.append(1), limb.append(10 * len(parent))
            tip.append((1.0 + 0.75 * side, height + 0.02, 0.1 * side))
    radius = np.where(np.array(order) == 0, 0.03, 0.004)
    return TreeSkeleton.from_columns(np.array(parent), np.array(tip), radius, order=np.array(order), limb=np.array(limb))
