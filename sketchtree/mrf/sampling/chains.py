"""Many Markov chains at once over the elevations, at any sequence of temperatures.

One step is a Langevin or a mirror proposal, or an exchange between two chains, taken or not by Metropolis & Hastings' rule
at exp(E/T): a single evaluation of E and its gradient for all chains. The step length ε of each chain adapts until 57 % of its
Langevin proposals are taken. A state that was never evaluated has E = −inf, so its first proposal is taken.
"""

from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from sketchtree.mrf.sampling import proposals
from sketchtree.mrf.log_posterior import LogPosterior
from sketchtree.mrf.sampling.proposals import Draws, Moves

LANGEVIN, MIRROR, EXCHANGE = 1, 0, 2
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
    kind: Int[Array, " step"],
) -> tuple[Chains, Float[Array, "step chain segment"], Float[Array, "step chain"]]:
    """As many steps as there are temperatures, each of one kind: LANGEVIN, MIRROR or EXCHANGE.
    Returns the chains after the last step, and ψ and E after every step."""

    def step(chains, scheduled):
        after = _step(posterior, moves, chains, *scheduled)
        return after, (after.elevation, after.value)

    after, (elevation, value) = jax.lax.scan(step, chains, (draws, temperature, kind))
    return after, elevation, value


def _step(posterior, moves, chains, draws, temperature, kind):
    """One step of all chains."""
    me = jnp.arange(len(chains.value))
    pair = jax.tree.map(lambda x: x[jnp.minimum(me, draws.partner)], draws)  # both of a pair draw as the first of them
    y = jax.vmap(lambda c, other, d, shared: _proposed(posterior, moves, c, other, d, shared, temperature, kind))(
        chains, chains.elevation[draws.partner], draws, pair
    )
    value, gradient = jax.vmap(jax.value_and_grad(lambda at: posterior(at)))(y)
    gradient = jnp.where(jnp.isfinite(gradient), gradient, 0.0)
    density = jax.vmap(lambda c, y, g: _density_ratio(moves, c, y, g, temperature))(chains, y, gradient)
    better = value - chains.value
    both = jnp.where(draws.partner == me, better, better + better[draws.partner])
    log_ratio = jnp.where(kind == EXCHANGE, both, better) / temperature + jnp.where(kind == LANGEVIN, density, 0.0)
    chance = jnp.exp(jnp.minimum(jnp.where(jnp.isnan(log_ratio), -jnp.inf, log_ratio), 0.0))
    take = jnp.where(kind == EXCHANGE, pair.accept, draws.accept) < chance
    return Chains(
        jnp.where(take[:, None], y, chains.elevation),
        jnp.where(take, value, chains.value),
        jnp.where(take[:, None], gradient, chains.gradient),
        chains.log_step + jnp.where(kind == LANGEVIN, ADAPT * (chance - TAKEN), 0.0),
    )


def _proposed(posterior, moves, chain, other, draws, shared, temperature, kind):
    psi, step = chain.elevation, jnp.exp(chain.log_step) * jnp.sqrt(temperature)
    return jnp.where(
        kind == LANGEVIN,
        proposals.langevin(moves, psi, chain.gradient, step, temperature, draws),
        jnp.where(
            kind == MIRROR,
            proposals.mirror(moves, posterior.page, psi, draws),
            proposals.exchange(moves, posterior.page, psi, other, shared),
        ),
    )


def _density_ratio(moves, chain, y, gradient, temperature):
    """log q(ψ | y) − log q(y | ψ) of a Langevin step."""
    psi, step = chain.elevation, jnp.exp(chain.log_step) * jnp.sqrt(temperature)
    back = proposals.langevin_log_density(moves, psi, y, gradient, step, temperature)
    return back - proposals.langevin_log_density(moves, y, psi, chain.gradient, step, temperature)
