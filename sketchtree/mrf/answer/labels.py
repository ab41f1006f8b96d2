"""Which child continues its parent's limb? Chen's labels (§5.2.1), where the drawing does not tell.

A segment that continues its own stroke is apical: that is no question. Where the reader joined two strokes (`is_joined`) it is:
given the depths, child h of K at that node is the apical one with probability

    P(h) ∝ exp(A(a_h) + Σ_{c ≠ h} B(a_c)),     A(a) = −½(a/τ)² − 2 log τ,     B(a) = −½((a − μ)/σ)² − log σ − log(sin a + .02)

    a   angle to the parent segment in 3D      τ, μ, σ   Θ of the sample, of the parent's order and the next

Laterals are exchangeable here, so K hypotheses stand for the paper's K!. The labels do not act back on the depths: the chains keep
the limbs as they were read.
"""

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.axes import NULL
from sketchtree.mrf.factor_graph import FactorGraph


def questions(graph: FactorGraph) -> list[np.ndarray]:
    """The rows that compete at every node where two strokes were joined and something else grows."""
    at = np.unique(graph.parent[graph.is_joined & ~graph.is_base])
    children = [np.flatnonzero(graph.parent == node) for node in at if node != NULL]
    return [rows for rows in children if len(rows) > 1]


def apical_labels(
    graph: FactorGraph,
    elevation: Float[np.ndarray, "sample segment"],
    theta: dict[str, Float[np.ndarray, " sample"]],
    generator: np.random.Generator,
) -> Bool[np.ndarray, "sample segment"]:
    """One draw of every label given each sample: True where a segment continues its parent's limb. `theta` has the columns of
    `Posterior.theta` by name."""
    apical = np.broadcast_to(graph.is_apical, elevation.shape).copy()
    for rows in questions(graph):
        log_odds = _log_odds(graph, elevation, theta, rows)
        odds = np.exp(log_odds - log_odds.max(axis=1, keepdims=True))
        below = np.cumsum(odds / odds.sum(axis=1, keepdims=True), axis=1)
        chosen = np.sum(generator.random((len(below), 1)) > below[:, :-1], axis=1)
        apical[:, rows] = chosen[:, None] == np.arange(len(rows))
    return apical


def _log_odds(graph, elevation, theta, rows):
    """log P(h) of every child, up to a constant."""
    at = int(graph.parent[rows[0]])
    order = int(min(graph.order[at], 2))
    side = "1" if order == 0 else "2+"
    tau = theta[f"bend_sd_{'2+' if order == 2 else order}"][:, None]
    mu, sigma = theta[f"divergence_mean_{side}"][:, None], theta[f"divergence_sd_{side}"][:, None]
    child, parent = _directions(graph, elevation, rows), _directions(graph, elevation, np.array([at]))
    a = np.arccos(np.clip(np.sum(child * parent, axis=2), -1, 1))
    continues = -0.5 * (a / tau) ** 2 - 2 * np.log(tau)
    leaves = -0.5 * ((a - mu) / sigma) ** 2 - np.log(sigma) - np.log(np.sin(a) + 0.02)
    return continues - leaves


def _directions(graph, elevation, rows):
    psi = elevation[:, rows, None]
    flat = np.where(graph.is_base[rows][:, None], [0.0, 1.0], graph.direction[rows])
    psi = np.where(graph.is_base[rows][None, :, None], 0.0, psi)
    return np.concatenate([np.cos(psi) * flat, np.sin(psi)], axis=2)
