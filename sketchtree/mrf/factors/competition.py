"""Tips compete for light: log P_d(p_i) = −w_d Σ_k m_k exp(−λ |p_i − p_k| / R_c).

Chen et al. 2008, §5.2.1, name this field but the formula is lost in our copy; this one is ours, with their default
attenuation λ = 5.

    R_c   half the drawn width      m_k = 1      w_d = 1      each pair once

It must stay local: extent and crown hold the scale of the depths.
"""

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

ATTENUATION = 5.0  # λ
WEIGHT = 1.0  # w_d


class Competition(eqx.Module):
    """One factor a competing tip, for its half of the pairs."""

    point: Int[Array, " point"]  # row
    rival: Int[Array, "point rival"]  # points
    present: Float[Array, "point rival"]
    crown_radius: Float[Array, ""]  # R_c

    def log_potential(self, assignment, theta) -> Float[Array, " point"]:
        """−½ w_d Σ_k exp(−λ d / R_c). The gradient by p_k comes from k's own factor, so here it is held."""
        tip = assignment.tip[self.point]
        apart = tip[:, None] - jax.lax.stop_gradient(tip)[self.rival]
        distance = jnp.sqrt(jnp.sum(apart**2, axis=-1) + 1e-8)
        twice = -WEIGHT * jnp.sum(self.present * jnp.exp(-ATTENUATION * distance / self.crown_radius), axis=1)
        return twice - 0.5 * jax.lax.stop_gradient(twice)
