"""Which of all arcs together make the least costly tree?

An attachment's cost depends on which end of the parent is its foot, and that on the parent's own attachment. So the
arborescence is solved first with the kinder of both, then again with the directions it gave, until nothing changes; the
cheapest consistent tree of all rounds is bettered by single moves.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.sketch.joining.arborescence import arborescence
from sketchtree.sketch.joining.candidates import Arcs
from sketchtree.sketch.joining.moves import improved

MOVES = 200  # at most, to better the solution


@dataclass(frozen=True, eq=False)
class Choices:
    """Everything that could be chosen: the arcs, then standing on the ground by either end. Node `count` is the ground."""

    tail: Int[np.ndarray, " arc"]
    head: Int[np.ndarray, " arc"]
    end: Int[np.ndarray, " arc"]
    both: Float[np.ndarray, "arc 2"]  # cost, by which end of the tail is its foot
    count: int

    @classmethod
    def of(cls, arcs: Arcs, slip: float, standing: Float[np.ndarray, "line 2"]) -> "Choices":
        """These arcs for a hand that keeps to `slip`, and what standing on the ground by either end costs."""
        count = len(standing)
        return cls(
            np.concatenate([arcs.parent, np.full(2 * count, count)]),
            np.concatenate([arcs.child, np.repeat(np.arange(count), 2)]),
            np.concatenate([arcs.end, np.tile([0, 1], count)]),
            np.concatenate([arcs.cost(slip), np.repeat(standing.reshape(-1, 1), 2, 1)]),
            count,
        )

    def cost(self, foot) -> Float[np.ndarray, " arc"]:
        """What every arc costs if those ends are the lines' feet."""
        return self.both[np.arange(len(self.both)), np.append(foot, 0)[self.tail]]


def solve(choices: Choices, rounds: int, foot=None) -> Int[np.ndarray, " line"]:
    """The arc chosen into every line; `foot`, where given, is a first guess at the lines' feet."""
    cost = choices.both.min(1) if foot is None else choices.cost(foot)
    best, least = None, np.inf
    for _ in range(rounds):
        chosen = arborescence(choices.tail, choices.head, cost, choices.count + 1, choices.count)[: choices.count]
        assumed, foot = foot, choices.end[chosen]
        cost = choices.cost(foot)
        total = float(cost[chosen].sum())
        if total >= least - 1e-9:
            break
        best, least = chosen, total
        if assumed is not None and (assumed == foot).all():
            break
    return improved(choices.tail, choices.head, choices.end, choices.both, best, MOVES)
