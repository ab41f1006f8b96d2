"""How far does a limb diverge from the segment it grows from?

    −½((a − μ_o)/σ_o)² − log σ_o − log(sin a + .02)

    a   angle between V of the limb's first segment and V of its parent segment      o   order of the limb

The last term makes the density one over the angle: a sphere has 2π sin a directions at angle a.
"""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.padding import Padding


class Lateral(eqx.Module):
    """One factor a segment; 0 where it is not the first of a limb that grows from another."""

    kind: Float[Array, "segment 2"]  # 1 in the column of its order (1, 2+), 0 elsewhere

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding) -> "Lateral":
        """The factors of a drawing."""
        return cls(pad.real(np.eye(2)[np.clip(graph.order, 1, 2) - 1] * graph.is_lateral[:, None], pad.segments))

    def log_potential(self, assignment, theta) -> Float[Array, " segment"]:
        """The Gaussian in a, per solid angle."""
        a = assignment.turn
        gauss = -0.5 * ((a[:, None] - theta.divergence_mean) / theta.divergence_sd) ** 2 - jnp.log(theta.divergence_sd)
        return jnp.sum(self.kind * (gauss - jnp.log(jnp.sin(a) + 0.02)[:, None]), axis=1)
