"""Which colours does a layer have? A mixture of Gaussians over linear parts of one, fitted to pixels that count by their weights.

    p(c) = Σ_k w_k N(c; μ_k, Σ_k)        c: R, G, B from 0 to 1

Expectation maximisation from a k-means++ start. (`photo/appearance.py` fits the like to unweighted pixels with scikit-learn; this one needs numpy only, and weights.)
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.special import logsumexp

LEAST = 0.012**2  # variance that every channel has at least: three levels of 255
_ROUNDS = 12
_RARE = 0.005  # share below which a component is dropped
PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))  # the six entries of a symmetric 3 × 3 matrix, in the order in which they are stored


@dataclass(frozen=True, eq=False)
class Colours:
    """A mixture. Requirements: weights are positive and sum to 1; covariances are positive definite."""

    weight: Float[np.ndarray, " component"]
    mean: Float[np.ndarray, "component 3"]
    covariance: Float[np.ndarray, "component 3 3"]

    def log_parts(self, colour: Float[np.ndarray, "pixel 3"]) -> Float[np.ndarray, "pixel component"]:
        """log w_k N(c; μ_k, Σ_k)."""
        parts = []
        for weight, mean, covariance in zip(self.weight, self.mean, self.covariance, strict=True):
            half = np.linalg.cholesky(np.linalg.inv(covariance))
            white = (colour - mean) @ half
            parts.append(np.log(weight) + np.log(np.diag(half)).sum() - 0.5 * ((white**2).sum(axis=1) + 3 * np.log(2 * np.pi)))
        return np.stack(parts, axis=1)

    def log_density(self, colour: Float[np.ndarray, "pixel 3"]) -> Float[np.ndarray, " pixel"]:
        """log p(c)."""
        return logsumexp(self.log_parts(colour), axis=1)


def fit_colours(colour: Float[np.ndarray, "pixel 3"], weight: Float[np.ndarray, " pixel"], components: int, draw: np.random.Generator) -> Colours:
    """The mixture that explains weighted colours best; fewer components where there are fewer colours."""
    count = max(1, min(components, len(np.unique((colour[weight > 0] * 64).round(), axis=0))))
    mean = _start(colour, weight, count, draw)
    mixture = Colours(np.full(count, 1 / count), mean, np.tile(np.eye(3) * 0.01, (count, 1, 1)))
    for _ in range(_ROUNDS):
        parts = mixture.log_parts(colour)
        share = np.exp(parts - logsumexp(parts, axis=1, keepdims=True)) * weight[:, None]
        total = share.sum(axis=0) + 1e-9
        mean = (share.T @ colour) / total[:, None]
        spread = [((colour - mean[k]) * share[:, k : k + 1]).T @ (colour - mean[k]) / total[k] + np.eye(3) * LEAST for k in range(count)]
        mixture = Colours(total / total.sum(), mean, np.stack(spread))
    kept = mixture.weight > _RARE
    return Colours(mixture.weight[kept] / mixture.weight[kept].sum(), mixture.mean[kept], mixture.covariance[kept])


def _start(colour, weight, count: int, draw: np.random.Generator) -> Float[np.ndarray, "component 3"]:
    """k-means++: each next mean is drawn by its squared distance to those there are."""
    chosen = [colour[draw.choice(len(colour), p=weight / weight.sum())]]
    while len(chosen) < count:
        far = np.min([((colour - mean) ** 2).sum(axis=1) for mean in chosen], axis=0) * weight + 1e-12
        chosen.append(colour[draw.choice(len(colour), p=far / far.sum())])
    return np.array(chosen)
