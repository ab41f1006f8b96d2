"""A stem stands upright but for the lean it was drawn with: −½(a/.08)²; the stems of a shrub spread: −½(a/.5)².

a is the angle between the stem's first segment and its drawn direction, which is |ψ|.
"""

import equinox as eqx
from jaxtyping import Array, Float, Int

SD = 0.08  # radians
SHRUB_SD = 0.5


class Stem(eqx.Module):
    """One factor a stem."""

    row: Int[Array, " stem"]  # first segment
    sd: Float[Array, " stem"]  # radians
    present: Float[Array, " stem"]

    def log_potential(self, assignment, theta) -> Float[Array, " stem"]:
        """The Gaussian in ψ."""
        return -0.5 * self.present * (assignment.elevation[self.row] / self.sd) ** 2
