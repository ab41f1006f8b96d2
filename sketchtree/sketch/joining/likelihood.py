"""How unlikely is it that a stroke grows from another? The cost of an arc is a sum of curves over its figures.

    cost = Σ_k c_k(x_k) − BASE + 1.5 (thicker + 0.2)₊ + before / 2

There are two sets of curves: FIRST goes by the figures of `evidence` alone; AGAIN, for a second look, knows a first tree too (`ranks`).

Each c_k is piecewise linear, 0 where it speaks most for a branch. Together they are minus the log odds of a
conditional logit (McFadden 1974): given all arcs of a stroke, the true one is taken with probability
exp(−cost) / Σ exp(−cost), so that a difference of 1 is odds of e to one. BASE is what the surest cost. The curves (`fitted.py`) are fitted by
`python -m benchmarks.fit_attachment` on careless drawings of grown trees. No drawing there has widths or times:
the two last weights are ours.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.joining.fitted import AGAIN, FIRST

THICKER, AS_THICK = 1.5, 0.2  # cost of a branch e times as thick as its parent; log ratio that is free below as thick
BEFORE = 0.5  # cost of a branch drawn before its parent


def arc_costs(figures: dict[str, Float[np.ndarray, "arc side"]], again: bool = False) -> Float[np.ndarray, "arc 2"]:
    """The cost of every arc but for its slip and ranks; column: the parent's foot is its first (0) or last (1) point."""
    fitted = AGAIN if again else FIRST
    total = np.full((len(figures["gap"]), 2), -fitted.base)
    for name, (knots, values) in fitted.curves.items():
        if name in figures:
            total += np.interp(figures[name], knots, values)
    return total + THICKER * np.maximum(figures["thicker"] + AS_THICK, 0.0) + BEFORE * figures["before"]


def slip_costs(miss: Float[np.ndarray, " arc"], slip: float, again: bool = False) -> Float[np.ndarray, "arc 1"]:
    """What it costs a hand that keeps to `slip`, ε, to miss by so much (parts of H)."""
    return np.interp(miss / slip, *(AGAIN if again else FIRST).curves["slip"])[:, None]


def rank_costs(ranks: dict[str, Float[np.ndarray, " arc"]]) -> Float[np.ndarray, "arc 1"]:
    """What the first tree adds to the cost of every arc."""
    return sum(np.interp(figure, *AGAIN.curves[name]) for name, figure in ranks.items())[:, None]
