"""No direction in space is likelier than another: Σ log cos ψ_i.

A direction drawn evenly from the sphere has elevation density ∝ cos ψ; with a scale-free prior on segment lengths
the page's ℓ_i adds nothing more. Without this Jacobian steep depths are overrated.
"""

import equinox as eqx
import jax.numpy as jnp
from jaxtyping import Array, Float

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.padding import Padding


class SolidAngle(eqx.Module):
    """One factor a segment."""

    present: Float[Array, " segment"]

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding) -> "SolidAngle":
        """The factors of a drawing."""
        return cls(pad.real(~graph.is_base, pad.segments))

    def log_potential(self, assignment, theta) -> Float[Array, " segment"]:
        """log cos ψ."""
        return self.present * jnp.log(jnp.cos(assignment.elevation))
