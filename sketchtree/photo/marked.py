"""What the user marked in the photo: for each tree one stroke round its crown, and strokes along its limbs, the trunk's first (§2, "User interface")."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float


@dataclass(frozen=True, eq=False)
class Marked:
    """The strokes of one tree; pixels, y DOWN (`photo`)."""

    crown: Float[np.ndarray, "point 2"]  # closed, first point not repeated
    branches: tuple[Float[np.ndarray, "point 2"], ...]  # each from its lower end; the trunk's first, from the root. May be empty: then the trunk is not known
    names: tuple[str, ...] = ()  # id of each branch stroke, in the file
    crown_name: str = "crown"
    warnings: tuple[str, ...] = ()  # of the whole file, on its first tree
