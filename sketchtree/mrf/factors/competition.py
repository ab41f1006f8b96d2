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

from sketchtree.mrf.factors.angles import total

ATTENUATION = 5.0  # λ
WEIGHT = 1.0  # w_d


class Competition(eqx.Module):
    """One factor a competing tip, for its half of the pairs."""

    point: Int[Array, " point"]  # row
    rival: Int[Array, "rival point"]  # points
    present: Float[Array, "rival point"]
    page_square: Float[Array, "rival point"]  # squared distance on the page, which no ψ changes
    crown_radius: Float[Array, ""]  # R_c

    def log_potential(self, assignment, theta) -> Float[Array, " point"]:
        """−½ w_d Σ_k exp(−λ d / R_c). The gradient by p_k comes from k's own factor, so here it is held."""
        twice = _field(assignment.tip.z[self.point], self)
        return twice - 0.5 * jax.lax.stop_gradient(twice)


@jax.custom_vjp
def _field(z: Float[Array, " point"], rivals: Competition) -> Float[Array, " point"]:
    """−w_d Σ_k exp(−λ d / R_c) at every point, the rivals held."""
    return _field_forward(z, rivals)[0]


def _field_forward(z, rivals):
    apart = z - z[rivals.rival]
    distance = jnp.sqrt(rivals.page_square + apart**2 + 1e-8)
    rate = ATTENUATION / rivals.crown_radius
    each = WEIGHT * rivals.present * jnp.exp(-rate * distance)
    return -total(each), total(rate * each * apart / distance)


def _field_backward(slope_by_z, slope):
    return slope * slope_by_z, None


_field.defvjp(_field_forward, _field_backward)

