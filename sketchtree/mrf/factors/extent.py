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
    count: Float[Array, " tree"]  # limbs that count, at least 1
    width_square: Float[Array, " tree"]  # Σ (x_t − x_trunk)²
    weight: Float[Array, " tree"]  # 0 at padding

    def log_potential(self, assignment, theta) -> Float[Array, " two_trees"]:
        """Extent of every tree, then balance of every tree."""
        z = assignment.tip.z[self.tip] * self.lateral
        sums = jnp.zeros((len(self.weight), 2), z.dtype).at[self.tree].add(jnp.stack([z, z**2], axis=1))
        ratio = jnp.where(self.weight > 0, (sums[:, 1] + 1e-6) / (self.width_square + 1e-6), 1.0)
        extent = 0.5 * jnp.log(ratio) / EXTENT_SD
        balance = sums[:, 0] / self.count / jnp.sqrt(self.width_square / self.count + 1e-6) / BALANCE_SD
        return -0.5 * jnp.concatenate([self.weight * extent**2, self.weight * balance**2])
