"""A stem stands upright but for the lean it was drawn with: −½(a/.08)²; the stems of a shrub spread: −½(a/.5)².

a is the angle between the stem's first segment and its drawn direction, which is |ψ|.
"""

import equinox as eqx
import numpy as np
from jaxtyping import Array, Float, Int

from sketchtree.axes import NULL
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.padding import Padding

SD = 0.08  # radians
SHRUB_SD = 0.5


class Stem(eqx.Module):
    """One factor a stem."""

    row: Int[Array, " stem"]  # first segment
    sd: Float[Array, " stem"]  # radians
    present: Float[Array, " stem"]

    @classmethod
    def of(cls, graph: FactorGraph, pad: Padding) -> "Stem":
        """The factors of a drawing."""
        stem = np.flatnonzero(graph.limb_parent == NULL)
        return cls(
            row=pad.index(graph.limb_first[stem], pad.limbs),
            sd=pad.real(np.where(graph.limb_spreads[stem], SHRUB_SD, SD), pad.limbs, fill=1.0),
            present=pad.real(np.ones(len(stem)), pad.limbs),
        )

    def log_potential(self, assignment, theta) -> Float[Array, " stem"]:
        """The Gaussian in ψ."""
        return -0.5 * self.present * (assignment.elevation[self.row] / self.sd) ** 2
