"""How long is a limb, compared with the one it grows from?

    −½((r_j − a_o − b (u_j − ½))/ς_o)² − log ς_o,     r_j = log Λ_j − log Λ_parent,   b = −0.8

    Λ   length in 3D      u_j   insertion along the parent limb      o   order of the limb

A prior on whole limbs, not on segments, whose lengths are dominated by where laterals happen to sit.
"""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from sketchtree.axes import NULL
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.padding import Padding

SLOPE = -0.8  # b


class LimbLength(eqx.Module):
    """One factor a limb; 0 where it does not grow from another."""

    parent: Int[Array, " limb"]  # itself at a stem
    kind: Float[Array, "limb 2"]  # 1 in the column of its order (1, 2+), 0 elsewhere
    insertion: Float[Array, " limb"]

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding) -> "LimbLength":
        """The factors of a drawing."""
        lateral = graph.limb_parent != NULL
        return cls(
            parent=pad.index(np.where(lateral, graph.limb_parent, np.arange(graph.limb_count)), pad.limbs),
            kind=pad.real(np.eye(2)[np.clip(graph.limb_order, 1, 2) - 1] * lateral[:, None], pad.limbs),
            insertion=pad.real(graph.insertion, pad.limbs),
        )

    def excess(self, assignment) -> Float[Array, " limb"]:
        """r_j − b (u_j − ½)."""
        length = jnp.log(assignment.limb_length + 1e-9)
        return length - length[self.parent] - SLOPE * (self.insertion - 0.5)

    def log_potential(self, assignment, theta) -> Float[Array, " limb"]:
        """The Gaussian in the log ratio."""
        away = (self.excess(assignment)[:, None] - theta.length_mean) / theta.length_sd
        return jnp.sum(self.kind * (-0.5 * away**2 - jnp.log(theta.length_sd)), axis=1)
