"""How much does a limb bend from one segment to the next?

    −½(a/τ_o)² − 2 log τ_o

    a   angle between a segment and the one it continues      o   order of the limb: 0, 1, 2+

Two log τ because a bend is a Gaussian step in two directions.
"""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.padding import Padding


class Apical(eqx.Module):
    """One factor a segment; 0 where it does not continue another of its limb."""

    kind: Float[Array, "segment 3"]  # 1 in the column of its order, 0 elsewhere and where it continues none

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding) -> "Apical":
        """The factors of a drawing."""
        return cls(pad.real(np.eye(3)[np.minimum(graph.order, 2)] * graph.is_apical[:, None], pad.segments))

    def log_potential(self, assignment, theta) -> Float[Array, " segment"]:
        """The Gaussian in two directions."""
        return -0.5 * assignment.turn**2 * (self.kind @ theta.bend_sd**-2) - self.kind @ (2 * jnp.log(theta.bend_sd))
