"""Which colours does a thing have? A mixture of Gaussians over pixel colours (§2).

    G(I, θ) = Σ_k w_k N(I; μ_k, Σ_k)        I: R, G, B from 0 to 255
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from jaxtyping import Array, Float, Key
from scipy.special import logsumexp

from sketchtree.keys import numpy_generator

_LEAST = 4.0  # variance added to every channel, so that a flat patch of colour has a density (two levels of 255)
_SAMPLE = 20_000  # pixels that a mixture is fitted to


@dataclass(frozen=True, eq=False)
class Mixture:
    """A mixture of Gaussians over colours. Requirements: weights are positive and sum to 1; covariances are positive definite."""

    weight: Float[np.ndarray, " component"]
    mean: Float[np.ndarray, "component channel"]  # 0-255
    covariance: Float[np.ndarray, "component channel channel"]

    def __len__(self) -> int:
        return len(self.weight)

    def log_density(self, colour: Float[np.ndarray, "*pixel channel"]) -> Float[np.ndarray, "*pixel"]:
        """log G(I, θ) of every colour."""
        return logsumexp(self.log_parts(colour), axis=-1)

    def log_parts(self, colour: Float[np.ndarray, "*pixel channel"]) -> Float[np.ndarray, "*pixel component"]:
        """log w_k N(I; μ_k, Σ_k) of every colour and component."""
        root = np.linalg.cholesky(np.linalg.inv(self.covariance))
        colour, parts = np.asarray(colour, np.float64), []
        for weight, mean, half in zip(self.weight, self.mean, root, strict=True):
            white = (colour - mean) @ half
            parts.append(np.log(weight) + np.log(np.diag(half)).sum() - 0.5 * ((white**2).sum(axis=-1) + colour.shape[-1] * np.log(2 * np.pi)))
        return np.stack(parts, axis=-1)

    def only(self, components) -> "Mixture":
        """Some of its components (rows or a mask), their weights scaled to sum to 1."""
        weight = self.weight[components]
        return Mixture(weight / weight.sum(), self.mean[components], self.covariance[components])


def fit_mixture(colour: Float[np.ndarray, "pixel channel"], components: int, *, key: Key[Array, ""]) -> Mixture:
    """The mixture that explains the colours best: expectation maximisation from a k-means start. At most so many components: fewer where there are fewer colours."""
    from sklearn.mixture import GaussianMixture

    draw = numpy_generator(key)
    colour = np.asarray(colour, np.float64)
    if len(colour) > _SAMPLE:
        colour = colour[np.sort(draw.choice(len(colour), _SAMPLE, replace=False))]
    components = max(1, min(components, _colours(colour, 2 * components) // 2))
    start = int(draw.integers(2**31 - 1))
    with _threads().limit(limits=1):  # its matrices are 3 × 3: threads would only wait for each other
        fitted = GaussianMixture(components, reg_covar=_LEAST, max_iter=60, tol=1e-2, random_state=start).fit(colour)
    return Mixture(fitted.weights_, fitted.means_, fitted.covariances_)


def _colours(colour: Float[np.ndarray, "pixel channel"], enough: int) -> int:
    """How many different colours there are; where there are enough among the first, only of those."""
    first = len(np.unique(colour[: 64 * enough], axis=0))
    return first if first >= enough else len(np.unique(colour, axis=0))


@cache
def _threads():
    """The pools of threads of the libraries that are loaded. To ask for them takes as long as to fit a mixture."""
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()
