"""Many Markov chains at once over the elevations, at any sequence of temperatures.

One step is a Langevin or a mirror proposal, or an exchange between two chains, taken or not by Metropolis & Hastings' rule
at exp(E/T): a single evaluation of E and its gradient for all chains. The step length ε of each chain adapts until 57 % of its
Langevin proposals are taken. A state that was never evaluated has E = −inf, so its first proposal is taken.

Below the temperature `COLD` there is nothing to sample: each chain climbs to its peak by the steps of Barzilai & Borwein (1988),
in the metric of the proposals' paces P,

    y = ψ + α P ∇E,     α = Σ s²/P / Σ s d,     s = ψ − ψ',  d = ∇E' − ∇E,  ' at the place before

which need no line search and no more evaluations than one a step; a step that falls by more than `DIP` is not taken.
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
COLD = 0.15  # temperature
DIP = 1.0  # nats
SHORTER = 0.7  # log ε less after a climb that was not taken
FARTHEST = 0.3  # radians that a row may climb in a step
STEEPEST = np.radians(79.0)
SIZES = (1e-4, 20.0)  # of α


class Chains(NamedTuple):
    """The state of every chain."""

    elevation: Float[Array, "chain segment"]  # ψ
    value: Float[Array, " chain"]  # E
    gradient: Float[Array, "chain segment"]
    log_step: Float[Array, " chain"]  # log ε
    before: Float[Array, "chain segment"]  # ψ' of a climb; ψ itself where it begins
    gradient_before: Float[Array, "chain segment"]


def start(elevation: Float[Array, "chain segment"]) -> Chains:
    """Chains that were not evaluated yet."""
    count = elevation.shape[0]
    kind = elevation.dtype
    zero = np.zeros_like(elevation)
    return Chains(elevation, np.full(count, -np.inf, kind), zero, np.full(count, -0.7, kind), elevation, zero)


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
    climbs = (kind == LANGEVIN) & (temperature < COLD)
    take = jnp.where(climbs, (better > -DIP) & (draws.accept <= 1), jnp.where(kind == EXCHANGE, pair.accept, draws.accept) < chance)
    pace = jnp.where(climbs, jnp.where(take, 0.0, -SHORTER), jnp.where(kind == LANGEVIN, ADAPT * (chance - TAKEN), 0.0))
    after = jnp.where(take[:, None], y, chains.elevation)
    climbed = (climbs & take)[:, None]
    return Chains(
        after,
        jnp.where(take, value, chains.value),
        jnp.where(take[:, None], gradient, chains.gradient),
        chains.log_step + pace,
        jnp.where(climbed, chains.elevation, after),
        jnp.where(climbed, chains.gradient, chains.gradient_before),
    )


def _proposed(posterior, moves, chain, other, draws, shared, temperature, kind):
    psi, step = chain.elevation, jnp.exp(chain.log_step) * jnp.sqrt(temperature)
    return jnp.where(
        kind == LANGEVIN,
        jnp.where(temperature < COLD, _uphill(moves, chain), proposals.langevin(moves, psi, chain.gradient, step, temperature, draws)),
        jnp.where(
            kind == MIRROR,
            proposals.mirror(moves, posterior.page, psi, draws),
            proposals.exchange(moves, posterior.page, psi, other, shared),
        ),
    )


def _uphill(moves, chain):
    """y of a climb; where there is no place before, or E bends the wrong way, a plain step of ½ε²P∇E."""
    square = moves.pace**2
    s, d = chain.elevation - chain.before, chain.gradient_before - chain.gradient
    along, curve = jnp.sum(jnp.where(square > 0, s**2 / jnp.where(square > 0, square, 1.0), 0.0)), jnp.sum(s * d)
    bends = curve > 1e-9
    size = jnp.where(bends, jnp.clip(along / jnp.where(bends, curve, 1.0), *SIZES), 0.5 * jnp.exp(2 * chain.log_step))
    move = jnp.clip(size * square * chain.gradient, -FARTHEST, FARTHEST)
    return jnp.clip(chain.elevation + move, -STEEPEST, STEEPEST)


def _density_ratio(moves, chain, y, gradient, temperature):
    """log q(ψ | y) − log q(y | ψ) of a Langevin step."""
    psi, step = chain.elevation, jnp.exp(chain.log_step) * jnp.sqrt(temperature)
    back = proposals.langevin_log_density(moves, psi, y, gradient, step, temperature)
    return back - proposals.langevin_log_density(moves, y, psi, chain.gradient, step, temperature)
