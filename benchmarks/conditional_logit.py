"""Which curves make the true alternatives likeliest? A conditional logit (McFadden 1974) with piecewise linear curves.

With u = −Σ_k c_k(x_k) of each arc, c_k piecewise linear between its knots, what is minimised is

    Σ_strokes [log Σ_arcs exp u − log Σ_true exp u] + ½ RIDGE |c|² + ½ STIFF Σ (second differences of c)²

Everywhere `figures` (arc, k) are the x_k, `stroke` numbers the arcs' strokes in ascending order, `true` marks the right ones.
"""

import numpy as np
import scipy.sparse as sp
from scipy.optimize import minimize

RIDGE, STIFF = 0.05, 1.5
Knots = dict[str, tuple[float, ...]]


def hats(figures, knots_of: Knots) -> sp.csr_matrix:
    """The weight of every knot in every arc's curves (arc, knot)."""
    rows, columns, values, first = [], [], [], 0
    for figure, knots in zip(figures.T, (np.array(k, float) for k in knots_of.values()), strict=True):
        x = np.clip(figure, knots[0], knots[-1])
        low = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, len(knots) - 2)
        t = (x - knots[low]) / (knots[low + 1] - knots[low])
        rows += [np.arange(len(x))] * 2
        columns += [first + low, first + low + 1]
        values += [1 - t, t]
        first += len(knots)
    return sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(len(figures), first))


def _stiffness(knots_of: Knots) -> sp.csr_matrix:
    """RIDGE and STIFF as one matrix (knot, knot)."""
    blocks = [sp.diags([1.0, -2.0, 1.0], [0, 1, 2], shape=(len(knots) - 2, len(knots))) for knots in knots_of.values()]
    bend = sp.block_diag(blocks)
    return (RIDGE * sp.eye(bend.shape[1]) + STIFF * bend.T @ bend).tocsr()


def fit(knots_of: Knots, figures, stroke, true) -> dict[str, np.ndarray]:
    """The curves: cost at every knot, 0 at the least of each."""
    hat, stiff = hats(figures, knots_of), _stiffness(knots_of)
    first = np.searchsorted(stroke, np.arange(stroke.max() + 1))

    def loss(utility):
        u = hat @ utility
        u -= np.maximum.reduceat(u, first)[stroke]
        e = np.exp(u)
        every, right = np.add.reduceat(e, first), np.maximum(np.add.reduceat(e * true, first), 1e-300)
        slope = hat.T @ (e / every[stroke] - e * true / right[stroke])
        return float(np.log(every / right).sum() + 0.5 * utility @ (stiff @ utility)), slope + stiff @ utility

    found = minimize(loss, np.zeros(hat.shape[1]), jac=True, method="L-BFGS-B", options={"maxiter": 300}).x
    parts = np.split(-found, np.cumsum([len(knots) for knots in knots_of.values()])[:-1])
    return {name: part - part.min() for name, part in zip(knots_of, parts, strict=True)}


def least(knots_of: Knots, figures, stroke, true, curves) -> float:
    """What the surest attachments cost: the 1 % quantile over strokes."""
    cost = np.full(stroke.max() + 1, np.inf)
    np.minimum.at(cost, stroke[true], _cost(knots_of, figures[true], curves))
    return float(np.quantile(cost, 0.01))


def _cost(knots_of: Knots, figures, curves):
    return sum(np.interp(figures[:, k], knots, curves[name]) for k, (name, knots) in enumerate(knots_of.items()))


def hits(knots_of: Knots, figures, stroke, true, curves) -> float:
    """How often the least costly arc of a stroke is a true one."""
    cost = _cost(knots_of, figures, curves)
    order = np.lexsort((cost, stroke))
    return float(true[order][np.unique(stroke[order], return_index=True)[1]].mean())
