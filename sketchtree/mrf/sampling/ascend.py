"""Straight up to the nearest peak of the log posterior, by a minimiser of optimistix.

The cooled chains end within about a nat of a peak; L-BFGS reaches it. It is a second program to compile,
of twice the size, and moves ψ by less than what the samples spread, so the default method leaves it out.
"""

import jax.numpy as jnp
import numpy as np
import optimistix
from jaxtyping import Float

from sketchtree.mrf.assignment import STEEPEST
from sketchtree.mrf.compilation import compiled
from sketchtree.mrf.log_posterior import LogPosterior


def ascend(
    posterior: LogPosterior, elevation: Float[np.ndarray, " segment"], minimiser: optimistix.AbstractMinimiser, steps: int = 300
) -> tuple[Float[np.ndarray, " segment"], float]:
    """ψ at the peak above `elevation`, and E there. ψ = 80° tanh(y / 80°) keeps every step inside the range."""

    def to_elevation(y):
        return STEEPEST * jnp.tanh(y / STEEPEST)

    def climb(posterior, y):
        found = optimistix.minimise(lambda y, p: -p(to_elevation(y)), minimiser, y, posterior, max_steps=steps, throw=False).value
        return to_elevation(found), posterior(to_elevation(found))

    padded = np.zeros(posterior.page.length.shape, posterior.page.length.dtype)
    padded[: len(elevation)] = STEEPEST * np.arctanh(np.clip(elevation / STEEPEST, -0.999, 0.999))
    arguments = (posterior, jnp.asarray(padded))
    psi, value = compiled(climb, *arguments, name=f"ascend {minimiser!r} {steps}")(*arguments)
    return np.asarray(psi, np.float64)[: len(elevation)], float(value)
