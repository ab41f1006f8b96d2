"""How long is a limb, compared with the one it grows from?

    −½((r_j − a_o − b (u_j − ½))/ς_o)² − log ς_o,     r_j = log Λ_j − log Λ_parent,   b = −0.8

    Λ   length in 3D      u_j   insertion along the parent limb      o   order of the limb

A prior on whole limbs, not on segments, whose lengths are dominated by where laterals happen to sit.
"""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

SLOPE = -0.8  # b


class LimbLength(eqx.Module):
    """One factor a limb that grows from another."""

    limb: Int[Array, " lateral"]
    parent: Int[Array, " lateral"]  # limb
    order: Int[Array, " lateral"]  # 0 for order 1, 1 above
    insertion: Float[Array, " lateral"]
    present: Float[Array, " lateral"]

    def excess(self, assignment) -> Float[Array, " lateral"]:
        """r_j − b (u_j − ½)."""
        length = jnp.log(assignment.limb_length + 1e-9)
        return length[self.limb] - length[self.parent] - SLOPE * (self.insertion - 0.5)

    def log_potential(self, assignment, theta) -> Float[Array, " lateral"]:
        """The Gaussian in the log ratio."""
        sd = theta.length_sd[self.order]
        gauss = -0.5 * ((self.excess(assignment) - theta.length_mean[self.order]) / sd) ** 2 - jnp.log(sd)
        return self.present * gauss
