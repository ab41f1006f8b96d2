"""How does a quantity change along a limb, or a crown's radius with its height?

A profile is piecewise linear through knots (position, value) and constant beyond the ends. A recipe
writes it as one number, or as `[[position, value], ...]`.
"""

from dataclasses import dataclass
from itertools import pairwise


@dataclass(frozen=True)
class Profile:
    """value(u), piecewise linear; knots in rising order of position."""

    knots: tuple[tuple[float, float], ...]

    @classmethod
    def constant(cls, value: float) -> "Profile":
        """The same value everywhere."""
        return cls(((0.0, float(value)),))

    def __call__(self, position: float) -> float:
        """Value at `position`."""
        if position <= self.knots[0][0]:
            return self.knots[0][1]
        for (a, low), (b, high) in pairwise(self.knots):
            if position <= b:
                return low + (high - low) * (position - a) / (b - a)
        return self.knots[-1][1]

    @property
    def values(self) -> tuple[float, ...]:
        """The values at the knots."""
        return tuple(value for _, value in self.knots)
