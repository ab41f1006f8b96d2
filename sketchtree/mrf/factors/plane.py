"""The tree grew flat (an espalier, a wall fruit): −½(ψ_i/.1)². Only under the `planar` switch."""

import equinox as eqx
from jaxtyping import Array, Float

SD = 0.1  # radians


class Plane(eqx.Module):
    """One factor a segment."""

    present: Float[Array, " segment"]

    def log_potential(self, assignment, theta) -> Float[Array, " segment"]:
        """The Gaussian in ψ."""
        return -0.5 * self.present * (assignment.elevation / SD) ** 2
