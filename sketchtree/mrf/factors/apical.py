"""How much does a limb bend from one segment to the next?

    −½(a/τ_o)² − 2 log τ_o

    a   angle between a segment and the one it continues      o   order of the limb: 0, 1, 2+

Two log τ because a bend is a Gaussian step in two directions.
"""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from sketchtree.mrf.factors.angles import angle


class Apical(eqx.Module):
    """One factor a segment that continues another of its limb."""

    row: Int[Array, " apical"]
    parent: Int[Array, " apical"]
    order: Int[Array, " apical"]  # 0, 1, 2+
    present: Float[Array, " apical"]

    def bend(self, assignment) -> Float[Array, " apical"]:
        """a, radians."""
        return angle(assignment.direction[self.row], assignment.direction[self.parent])

    def log_potential(self, assignment, theta) -> Float[Array, " apical"]:
        """The Gaussian in two directions."""
        tau = theta.bend_sd[self.order]
        return self.present * (-0.5 * (self.bend(assignment) / tau) ** 2 - 2 * jnp.log(tau))
