"""The limbs that show in the photo, as one table: parents first."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL


@dataclass(frozen=True, eq=False)
class Traced:
    """One tree's visible limbs in the picture. Row 0 is the root. Pixels, y DOWN."""

    parent: Int[np.ndarray, " joint"]  # row; NULL at the root
    xy: Float[np.ndarray, "joint 2"]
    radius: Float[np.ndarray, " joint"]  # half the thickness of the limb that ends here
    generation: Int[np.ndarray, " joint"]  # 0 on the trunk
    stroke: Int[np.ndarray, " joint"]  # the stroke it was traced from (number in `Marked.branches`)
    drawn: Bool[np.ndarray, " joint"] | None = None  # lies on its stroke; the others were found in the picture. None: all do
    warnings: tuple[str, ...] = ()

    def __post_init__(self):
        assert len(self.parent) and self.parent[0] == NULL and (self.parent < np.arange(len(self.parent))).all(), "parents must precede children"

    def __len__(self) -> int:
        return len(self.parent)
