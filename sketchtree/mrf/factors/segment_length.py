"""How long is a segment, compared with the others of its order?

    −½((log L_i − m_o)/s_o)² − log s_o

    L   length in 3D, H = 1      o   order of the limb: 1, 2+

Drawn segments run from bend to bend or from fork to fork, and those of one drawing are of like length: one that is much
shorter on the page is likely foreshortened. Without this kind the prior on log L is even, and a short segment may as well
be short.
"""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.padding import Padding


class SegmentLength(eqx.Module):
    """One factor a segment; 0 on stems."""

    kind: Float[Array, "segment 2"]  # 1 in the column of its order (1, 2+), 0 elsewhere

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding) -> "SegmentLength":
        """The factors of a drawing."""
        lateral = (graph.order > 0) & ~graph.is_base
        return cls(pad.real(np.eye(2)[np.clip(graph.order, 1, 2) - 1] * lateral[:, None], pad.segments))

    def log_length(self, assignment) -> Float[Array, " segment"]:
        """log L."""
        return jnp.log(assignment.length + 1e-9)

    def log_potential(self, assignment, theta) -> Float[Array, " segment"]:
        """The Gaussian in log L."""
        away = (self.log_length(assignment)[:, None] - theta.segment_mean) / theta.segment_sd
        return jnp.sum(self.kind * (-0.5 * away**2 - jnp.log(theta.segment_sd)), axis=1)
