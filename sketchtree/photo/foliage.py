"""Which pixels are foliage? What the other steps are told of it; `foliage_mask` finds it."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool

from sketchtree.photo.appearance import Mixture


@dataclass(frozen=True, eq=False)
class Foliage:
    """The foliage of one tree in the photo."""

    mask: Bool[np.ndarray, "row column"]  # of the photo's size; True: foliage
    region: Bool[np.ndarray, "row column"]  # where it was looked for: within the crown's stroke, dilated
    leaf: Mixture  # colours of the foliage
    background: Mixture  # and of what is between it
    warnings: tuple[str, ...] = ()
    bare: bool = False  # a tree without leaves: the mask is what its twigs span, and `leaf` has the colours of wood
