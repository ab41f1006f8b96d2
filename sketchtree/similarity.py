"""From the page to the world and back: a uniform scale and a shift."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float


@dataclass(frozen=True)
class Similarity:
    """world = scale · sketch + translate. A sketch has no scale of its own: the height decides it."""

    scale: float  # metres per sketch unit, > 0
    translate: tuple[float, float, float]  # metres

    def to_world(self, point: Float[np.ndarray, "*point axis"]) -> Float[np.ndarray, "*point axis"]:
        """Sketch units (2 or 3 columns, y up) → metres."""
        return self.scale * point + np.asarray(self.translate)[: point.shape[-1]]

    def to_sketch(self, point: Float[np.ndarray, "*point axis"]) -> Float[np.ndarray, "*point axis"]:
        """Metres → sketch units (y up)."""
        return (point - np.asarray(self.translate)[: point.shape[-1]]) / self.scale
