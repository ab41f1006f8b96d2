"""Siblings grow round their parent limb, not on top of each other: −κ c_d w_j · w_k.

    w_j   V of limb j's first segment minus its part along its parent segment, normalised
    d     gap in rank along the parent limb: 1, 2, 3        c = (1, .5, .25)        κ = .35

The phase of the spiral is marginalised: only differences of azimuth matter.
"""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

KAPPA = 0.35
DECAY = (0.0, 1.0, 0.5, 0.25)


class Siblings(eqx.Module):
    """One factor a pair of siblings."""

    pair: Int[Array, "sibling_pair 2"]  # first segments of the two limbs
    strength: Float[Array, " sibling_pair"]  # κ c_d; 0 at padding

    def log_potential(self, assignment, theta) -> Float[Array, " sibling_pair"]:
        """−κ c_d w_j · w_k."""
        v, axis = assignment.direction, assignment.parent_direction
        across = v - axis * jnp.sum(v * axis, axis=-1, keepdims=True)
        w = across / jnp.sqrt(jnp.sum(across**2, axis=-1, keepdims=True) + 1e-6)
        return -self.strength * jnp.sum(w[self.pair[:, 0]] * w[self.pair[:, 1]], axis=-1)
