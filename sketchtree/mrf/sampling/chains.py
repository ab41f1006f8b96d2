"""Many Markov chains at once over the elevations, at any sequence of temperatures.

One step is a Langevin or a mirror proposal, taken or not by Metropolis & Hastings' rule at exp(E/T):
a single evaluation of E and its gradient for all chains. The step length ε of each chain adapts until 57 % of its
Langevin proposals are taken. A state that was never evaluated has E = −inf, so its first proposal is taken.
"""

from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from sketchtree.mrf.sampling import proposals
from sketchtree.mrf.log_posterior import LogPosterior
from sketchtree.mrf.sampling.proposals import Draws, Moves

TAKEN = 0.57
ADAPT = 0.15


class Chains(NamedTuple):
    """The state of every chain."""

    elevation: Float[Array, "chain segment"]  # ψ
    value: Float[Array, " chain"]  # E
    gradient: Float[Array, "chain segment"]
    log_step: Float[Array, " chain"]  # log ε


def start(elevation: Float[Array, "chain segment"]) -> Chains:
    """Chains that were not evaluated yet."""
    count = elevation.shape[0]
    kind = elevation.dtype
    return Chains(elevation, np.full(count, -np.inf, kind), np.zeros_like(elevation), np.full(count, -0.7, kind))


def run(
    posterior: LogPosterior,
    moves: Moves,
    chains: Chains,
    draws: Draws,
    temperature: Float[Array, " step"],
    langevin: Float[Array, " step"],
) -> tuple[Chains, Float[Array, "step chain segment"], Float[Array, "step chain"]]:
    """As many steps as there are temperatures; `langevin` is 1 at Langevin steps and 0 at mirror moves.
    Returns the chains after the last step, and ψ and E after every step."""

    def step(chains, scheduled):
        draws, t, is_langevin = scheduled
        after = jax.vmap(lambda c, d: _step(posterior, moves, c, d, t, is_langevin))(chains, draws)
        return after, (after.elevation, after.value)

    after, (elevation, value) = jax.lax.scan(step, chains, (draws, temperature, langevin))
    return after, elevation, value


def _step(posterior, moves, chain, draws, temperature, is_langevin):
    psi = chain.elevation
    step = jnp.exp(chain.log_step) * jnp.sqrt(temperature)
    y = jnp.where(
        is_langevin > 0,
        proposals.langevin(moves, psi, chain.gradient, step, temperature, draws),
        proposals.mirror(moves, posterior.page, psi, draws),
    )
    value, gradient = jax.value_and_grad(lambda at: posterior(at))(y)
    gradient = jnp.where(jnp.isfinite(gradient), gradient, 0.0)
    back = proposals.langevin_log_density(moves, psi, y, gradient, step, temperature)
    there = proposals.langevin_log_density(moves, y, psi, chain.gradient, step, temperature)
    log_ratio = (value - chain.value) / temperature + is_langevin * (back - there)
    chance = jnp.exp(jnp.minimum(jnp.where(jnp.isnan(log_ratio), -jnp.inf, log_ratio), 0.0))
    take = draws.accept < chance
    return Chains(
        jnp.where(take, y, psi),
        jnp.where(take, value, chain.value),
        jnp.where(take, gradient, chain.gradient),
        chain.log_step + is_langevin * ADAPT * (chance - TAKEN),
    )
