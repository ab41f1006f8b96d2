"""Tips compete for light: log P_d(p_i) = −w_d Σ_k m_k exp(−λ |p_i − p_k| / R_c).

Chen et al. 2008, §5.2.1, name this field but the formula is lost in our copy; this one is ours, with their default
attenuation λ = 5.

    R_c   half the drawn width      m_k = 1      w_d = 1      each pair once

It must stay local: extent and crown hold the scale of the depths.
"""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

ATTENUATION = 5.0  # λ
WEIGHT = 1.0  # w_d


class Competition(eqx.Module):
    """One factor a pair of competing tips."""

    pair: Int[Array, "competition_pair 2"]  # rows
    present: Float[Array, " competition_pair"]
    crown_radius: Float[Array, ""]  # R_c

    def log_potential(self, assignment, theta) -> Float[Array, " competition_pair"]:
        """−w_d exp(−λ d / R_c)."""
        apart = assignment.tip[self.pair[:, 0]] - assignment.tip[self.pair[:, 1]]
        distance = jnp.sqrt(jnp.sum(apart**2, axis=-1) + 1e-8)
        return -WEIGHT * self.present * jnp.exp(-ATTENUATION * distance / self.crown_radius)
