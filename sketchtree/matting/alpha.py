"""How much of each pixel is tree? The matte that every method makes."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float32


@dataclass(frozen=True, eq=False)
class Matte:
    """The opacity of the tree at every pixel. Requirements, checked at construction: every alpha lies in 0 to 1."""

    alpha: Float32[np.ndarray, "row column"]
    method: str
    course: tuple[float, ...] = ()  # the method's objective after each iteration
    warnings: tuple[str, ...] = ()

    def __post_init__(self):
        alpha = np.array(self.alpha, np.float32)
        assert alpha.ndim == 2 and np.isfinite(alpha).all() and (alpha >= 0).all() and (alpha <= 1).all(), "a matte lies in 0 to 1"
        alpha.flags.writeable = False
        object.__setattr__(self, "alpha", alpha)
