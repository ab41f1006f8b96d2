"""Branches that pass through each other are moved away from each other along z.

Chen et al. 2008, §5.2.1: right after the bottom-up pass, and before ICM.
"""

import numpy as np
from jaxtyping import Array, Key

from sketchtree.mrf.chen.estep import EStepPart, Reading
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.overlaps import candidates, pushes
from sketchtree.parameters import TreeParameters
from sketchtree.traverse import sum_from_root


class MoveApart(EStepPart):
    """Pushes interpenetrating branches apart along z."""

    rounds: int = 10  # a push may cause another overlap

    def __call__(self, graph: FactorGraph, theta: TreeParameters, reading: Reading, key: Key[Array, ""]) -> Reading:
        pair = candidates(graph)
        depth = np.array(reading.depth)
        for _ in range(self.rounds):
            push = pushes(graph, depth, pair)
            if not push.any():
                break
            depth = depth + sum_from_root(graph.parent, push)
        return reading._replace(depth=depth)
