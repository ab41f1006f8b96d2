"""Is the crown as deep as it is wide, and as deep in front as behind?

    extent    −½(r/.2)²,    r = ½ log(Σ z_t² / Σ (x_t − x_trunk)²)
    balance   −½(mean z_t / rms (x_t − x_trunk) / .35)²

over the tips t of a tree's laterals. `weight` is less than 1 for a tree drawn on one side only, 0 for a planar one.
"""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.padding import Padding

EXTENT_SD = 0.2
BALANCE_SD = 0.35
ONE_SIDED = (0.7, 0.9)  # |mean dx| / rms dx at which extent and crown begin to weaken, and have


def sidedness(graph: FactorGraph) -> Float[np.ndarray, " tree"]:
    """Weight of extent and crown per tree: 1, falling to .15 where every tip is on one side."""
    lateral = graph.limb_spreads
    tree = graph.tree[graph.limb_tip][lateral]
    aside = graph.tip_aside[lateral]
    count = np.maximum(np.bincount(tree, minlength=graph.tree.max() + 1), 1)
    mean = np.bincount(tree, aside, minlength=len(count)) / count
    rms = np.sqrt(np.bincount(tree, aside**2, minlength=len(count)) / count)
    low, high = ONE_SIDED
    return 1 - 0.85 * np.clip((np.abs(mean) / np.maximum(rms, 1e-9) - low) / (high - low), 0, 1)


class Extent(eqx.Module):
    """Two factors a tree: its extent, then its balance."""

    tip: Int[Array, " limb"]  # row
    tree: Int[Array, " limb"]  # 0 … limb − 1
    lateral: Float[Array, " limb"]  # 1 where the limb counts
    count: Float[Array, " tree"]  # limbs that count, at least 1
    width_square: Float[Array, " tree"]  # Σ (x_t − x_trunk)²
    weight: Float[Array, " tree"]  # 0 at padding

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding, *, shape: float) -> "Extent":
        """The factors of a drawing."""
        lateral = graph.limb_spreads
        tree = graph.tree[graph.limb_tip] % pad.limbs
        square = np.bincount(tree[lateral], graph.tip_aside[lateral] ** 2, minlength=pad.limbs)
        some = np.bincount(tree[lateral], minlength=pad.limbs) > 0
        weight = np.zeros(pad.limbs)
        weight[: graph.tree.max() + 1] = sidedness(graph)[: pad.limbs]
        return cls(
            tip=pad.index(graph.limb_tip, pad.limbs), tree=pad.index(tree, pad.limbs), lateral=pad.real(lateral, pad.limbs),
            count=pad.real(np.maximum(np.bincount(tree[lateral], minlength=pad.limbs), 1), pad.limbs),
            width_square=pad.real(square, pad.limbs), weight=pad.real(shape * some * weight, pad.limbs),
        )  # fmt: skip

    def log_potential(self, assignment, theta) -> Float[Array, " two_trees"]:
        """Extent of every tree, then balance of every tree."""
        z = assignment.tip.z[self.tip] * self.lateral
        sums = jnp.zeros((len(self.weight), 2), z.dtype).at[self.tree].add(jnp.stack([z, z**2], axis=1))
        ratio = jnp.where(self.weight > 0, (sums[:, 1] + 1e-6) / (self.width_square + 1e-6), 1.0)
        extent = 0.5 * jnp.log(ratio) / EXTENT_SD
        balance = sums[:, 0] / self.count / jnp.sqrt(self.width_square / self.count + 1e-6) / BALANCE_SD
        return -0.5 * jnp.concatenate([self.weight * extent**2, self.weight * balance**2])
