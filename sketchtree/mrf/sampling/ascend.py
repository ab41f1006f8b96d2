"""Straight up to the nearest peak of the log posterior, by a minimiser of optimistix.

The cooled chains end within about a nat of a peak; L-BFGS reaches it. It is a second program to compile,
of twice the size, and moves ψ by less than what the samples spread, so the default method leaves it out.
"""

import jax.numpy as jnp
import numpy as np
import optimistix
from jaxtyping import Bool, Float

from sketchtree.mrf.assignment import STEEPEST
from sketchtree.mrf.compilation import compiled
from sketchtree.mrf.log_posterior import LogPosterior


def ascend(
    posterior: LogPosterior,
    elevation: Float[np.ndarray, " segment"],
    minimiser: optimistix.AbstractMinimiser,
    steps: int = 300,
    *,
    held: Bool[np.ndarray, " segment"] | None = None,
) -> tuple[Float[np.ndarray, " segment"], float]:
    """ψ at the peak above `elevation`, and E there. ψ = 80° tanh(y / 80°) keeps every step inside the range. Rows that are
    `held` stay."""

    def climb(posterior, start, free):
        def to_elevation(y):
            return STEEPEST * jnp.tanh(jnp.where(free, y, start) / STEEPEST)

        found = optimistix.minimise(lambda y, p: -p(to_elevation(y)), minimiser, start, posterior, max_steps=steps, throw=False).value
        return to_elevation(found), posterior(to_elevation(found))

    padded = np.zeros(posterior.page.length.shape, posterior.page.length.dtype)
    padded[: len(elevation)] = STEEPEST * np.arctanh(np.clip(elevation / STEEPEST, -0.999, 0.999))
    free = np.ones(len(padded), bool)
    free[: len(elevation)] = True if held is None else ~held
    arguments = (posterior, jnp.asarray(padded), free)
    psi, value = compiled(climb, *arguments, name=f"ascend {minimiser!r} {steps}", keep=not posterior.own)(*arguments)
    return np.asarray(psi, np.float64)[: len(elevation)], float(value)
