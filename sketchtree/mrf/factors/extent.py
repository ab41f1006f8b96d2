"""Is the crown as deep as it is wide, and as deep in front as behind?

    extent    −½(r/.2)²,    r = ½ log(Σ z_t² / Σ (x_t − x_trunk)²)
    balance   −½(mean z_t / rms (x_t − x_trunk) / .35)²

over the tips t of a tree's laterals. `weight` is less than 1 for a tree drawn on one side only, 0 for a planar one.
"""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

EXTENT_SD = 0.2
BALANCE_SD = 0.35


class Extent(eqx.Module):
    """Two factors a tree: its extent, then its balance."""

    tip: Int[Array, " limb"]  # row
    tree: Int[Array, " limb"]  # 0 … limb − 1
    lateral: Float[Array, " limb"]  # 1 where the limb counts
    width_square: Float[Array, " tree"]  # Σ (x_t − x_trunk)²
    weight: Float[Array, " tree"]  # 0 at padding

    def log_ratio(self, assignment) -> Float[Array, " tree"]:
        """r of every tree; 0 at padding."""
        z = assignment.tip[self.tip, 2] * self.lateral
        depth_square = jnp.zeros_like(self.weight).at[self.tree].add(z**2)
        ratio = jnp.where(self.weight > 0, (depth_square + 1e-6) / (self.width_square + 1e-6), 1.0)
        return 0.5 * jnp.log(ratio)

    def log_potential(self, assignment, theta) -> Float[Array, " two_trees"]:
        """Extent of every tree, then balance of every tree."""
        z = assignment.tip[self.tip, 2] * self.lateral
        count = jnp.zeros_like(self.weight).at[self.tree].add(self.lateral)
        mean = jnp.zeros_like(self.weight).at[self.tree].add(z) / jnp.maximum(count, 1.0)
        rms = jnp.sqrt(self.width_square / jnp.maximum(count, 1.0) + 1e-6)
        extent = -0.5 * self.weight * (self.log_ratio(assignment) / EXTENT_SD) ** 2
        balance = -0.5 * self.weight * (mean / rms / BALANCE_SD) ** 2
        return jnp.concatenate([extent, balance])
