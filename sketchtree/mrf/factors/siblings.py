"""Siblings grow round their parent limb, not on top of each other: −κ c_d w_j · w_k.

    w_j   V of limb j's first segment minus its part along its parent segment, normalised
    d     gap in rank along the parent limb: 1, 2, 3        c = (1, .5, .25)        κ = .5

The phase of the spiral is marginalised: only differences of azimuth matter.
"""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.padding import Padding
from sketchtree.mrf.factors.angles import Vectors, dot, total

KAPPA = 0.5
DECAY = (0.0, 1.0, 0.5, 0.25)


class Siblings(eqx.Module):
    """One factor a limb, for its half of the pairs."""

    first: Int[Array, " limb"]  # row
    sibling: Int[Array, "6 limb"]  # limbs up to three ranks before and after
    strength: Float[Array, "6 limb"]  # κ c_d; 0 where there is none

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding, *, shape: float) -> "Siblings":
        """The factors of a drawing: every limb's siblings up to three ranks away, each pair from both ends."""
        sibling, strength = np.zeros((pad.limbs, 6), int), np.zeros((pad.limbs, 6))
        for (a, b), gap in zip(graph.sibling, graph.rank_gap, strict=True):
            for limb, other, slot in ((a, b, gap - 1), (b, a, gap + 2)):
                sibling[limb, slot], strength[limb, slot] = other, shape * KAPPA * DECAY[gap]
        return cls(pad.index(graph.limb_first, pad.limbs), pad.index(sibling, pad.limbs).T, pad.real(strength, pad.limbs).T)

    def log_potential(self, assignment, theta) -> Float[Array, " limb"]:
        """−½ κ Σ_k c_d w_j · w_k. The gradient by w_k comes from k's own factor, so here it is held."""
        v, axis = assignment.direction.at(self.first), assignment.parent_direction.at(self.first)
        along = dot(v, axis)
        across = Vectors(*(a - along * b for a, b in zip(v, axis, strict=True)))
        scale = 1 / jnp.sqrt(dot(across, across) + 1e-6)
        w = Vectors(*(scale * a for a in across))
        held = Vectors(*map(jax.lax.stop_gradient, w))
        others = Vectors(*(total(self.strength * column) for column in held.at(self.sibling)))
        twice = -dot(w, others)
        return twice - 0.5 * jax.lax.stop_gradient(twice)
