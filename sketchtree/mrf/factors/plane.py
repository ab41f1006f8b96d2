"""The tree grew flat (an espalier, a wall fruit): −½(ψ_i/.1)². Only under the `planar` switch."""

import equinox as eqx
from jaxtyping import Array, Float

from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.padding import Padding

SD = 0.1  # radians


class Plane(eqx.Module):
    """One factor a segment."""

    present: Float[Array, " segment"]

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding, *, shape: float) -> "Plane":
        """The factors of a drawing; `shape` is 0 for a tree that grew flat, 1 for any other."""
        return cls(pad.real((1 - shape) * ~graph.is_base, pad.segments))

    def log_potential(self, assignment, theta) -> Float[Array, " segment"]:
        """The Gaussian in ψ."""
        return -0.5 * self.present * (assignment.elevation / SD) ** 2
