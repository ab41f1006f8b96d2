"""How does a quantity change along a limb, or a crown's radius with its height?

A profile is piecewise linear through knots (position, value) and constant beyond the ends. A recipe
writes it as one number, or as `[[position, value], ...]`.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Profile:
    """value(u), piecewise linear; knots in rising order of position."""

    knots: tuple[tuple[float, float], ...]

    @classmethod
    def constant(cls, value: float) -> "Profile":
        """The same value everywhere."""
        return cls(((0.0, float(value)),))

    def __call__(self, position):
        """Value at `position` (a number or an array)."""
        at, value = zip(*self.knots, strict=True)
        return np.interp(position, at, value)

    @property
    def values(self) -> tuple[float, ...]:
        """The values at the knots."""
        return tuple(value for _, value in self.knots)
