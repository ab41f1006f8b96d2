"""How far does a limb diverge from the segment it grows from?

    −½((a − μ_o)/σ_o)² − log σ_o − log(sin a + .02)

    a   angle between V of the limb's first segment and V of its parent segment      o   order of the limb

The last term makes the density one over the angle: a sphere has 2π sin a directions at angle a.
"""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from sketchtree.mrf.factors.angles import angle


class Lateral(eqx.Module):
    """One factor a limb that grows from another."""

    row: Int[Array, " lateral"]  # first segment
    parent: Int[Array, " lateral"]
    order: Int[Array, " lateral"]  # 0 for order 1, 1 above
    present: Float[Array, " lateral"]

    def divergence(self, assignment) -> Float[Array, " lateral"]:
        """a, radians."""
        return angle(assignment.direction[self.row], assignment.direction[self.parent])

    def log_potential(self, assignment, theta) -> Float[Array, " lateral"]:
        """The Gaussian in a, per solid angle."""
        a = self.divergence(assignment)
        sd = theta.divergence_sd[self.order]
        gauss = -0.5 * ((a - theta.divergence_mean[self.order]) / sd) ** 2 - jnp.log(sd)
        return self.present * (gauss - jnp.log(jnp.sin(a) + 0.02))
