"""How unlikely is it that a stroke grows from another? The cost of an arc is a sum of curves over its figures.

    cost = Σ_k c_k(x_k) − BASE + 1.5 (thicker + 0.2)₊ + 2 min((thins − 0.1)₊, 1.5) + before / 2

Each c_k is piecewise linear, 0 where it speaks most for a branch. Together they are minus the log odds of a
conditional logit (McFadden 1974): given all arcs of a stroke, the true one is taken with probability
exp(−cost) / Σ exp(−cost), so that a difference of 1 is odds of e to one. BASE is what the surest cost. The curves (`fitted.py`) are fitted by
`python -m benchmarks.fit_attachment` on careless drawings of grown trees. No drawing there has widths or times:
the three last weights are ours.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.sketch.joining.fitted import BASE, CURVES

THICKER, AS_THICK = 1.5, 0.2  # cost of a branch e times as thick as its parent; log ratio that is free below as thick
THINS, EVEN, MOST = 2.0, 0.1, 1.5  # cost of growing from the end that is e times thinner; log ratio that is free; most that counts
BEFORE = 0.5  # cost of a branch drawn before its parent


def arc_costs(figures: dict[str, Float[np.ndarray, "arc side"]]) -> Float[np.ndarray, "arc 2"]:
    """The cost of every arc but for its slip; column: the parent's foot is its first (0) or last (1) point."""
    total = np.full((len(figures["gap"]), 2), -BASE)
    for name, (knots, values) in CURVES.items():
        if name != "slip":
            total += np.interp(figures[name], knots, values)
    return total + THICKER * np.maximum(figures["thicker"] + AS_THICK, 0.0) + taper_costs(figures["thins"]) + BEFORE * figures["before"]


def taper_costs(thins: Float[np.ndarray, "*row"]) -> Float[np.ndarray, "*row"]:
    """What it costs a stroke to grow from an end that is thinner than its other one."""
    return THINS * np.clip(thins - EVEN, 0.0, MOST)


def slip_costs(miss: Float[np.ndarray, " arc"], slip: float) -> Float[np.ndarray, "arc 1"]:
    """What it costs a hand that keeps to `slip`, ε, to miss by so much (parts of H)."""
    return np.interp(miss / slip, *CURVES["slip"])[:, None]
