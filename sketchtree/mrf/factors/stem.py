"""A stem stands upright but for the lean it was drawn with: −½(a/.08)².

a is the angle between the stem's first segment and its drawn direction, which is |ψ|.
"""

import equinox as eqx
from jaxtyping import Array, Float, Int

SD = 0.08  # radians


class Stem(eqx.Module):
    """One factor a stem."""

    row: Int[Array, " stem"]  # first segment
    present: Float[Array, " stem"]

    def log_potential(self, assignment, theta) -> Float[Array, " stem"]:
        """The Gaussian in ψ."""
        return -0.5 * self.present * (assignment.elevation[self.row] / SD) ** 2
