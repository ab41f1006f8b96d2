"""Where the leaves are: one row a leaf, needle tuft or leaflet."""

from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Float, Int

from sketchtree.foliage.printed import Print


@dataclass(frozen=True, eq=False)
class Leaves:
    """All leaves of a tree. Metres, world frame; every vector is of unit length."""

    model: str  # name of the leaf model
    position: Float[np.ndarray, "leaf 3"]  # where the petiole meets the wood's surface, or a short shoot
    direction: Float[np.ndarray, "leaf 3"]  # from the petiole to the leaf's tip
    normal: Float[np.ndarray, "leaf 3"]  # out of the upper face; perpendicular to `direction`
    size: Float[np.ndarray, " leaf"]  # blade length, metres
    tint: Float[np.ndarray, " leaf"]  # 0-1, place in the model's range of colours
    segment: Int[np.ndarray, " leaf"]  # row of the skeleton that carries it
    shoot: Float[np.ndarray, "shoot 2 3"] = field(default_factory=lambda: np.zeros((0, 2, 3)))
    # start (on the wood's surface) and end of the short shoots that some leaves stand on
    kept: float = 1.0  # share of the leaves that the cap left; the sizes of these make up for the rest
    seen: Float[np.ndarray, "leaf 3"] | None = None  # colour that each was seen in, in a photo; linear, 0-1; None: the model's
    printed: Print | None = None  # a picture that the finest mesh of them bears

    def __len__(self) -> int:
        return len(self.position)

    @classmethod
    def none(cls, model: str) -> "Leaves":
        """No leaf at all, as in winter."""
        vectors, numbers = np.zeros((0, 3)), np.zeros(0)
        return cls(model, vectors, vectors, vectors, numbers, numbers, np.zeros(0, np.int64))


def select(leaves: Leaves, keep) -> Leaves:
    """Only some of the leaves, by mask or by rows; the short shoots stay as they are."""
    columns = ("position", "direction", "normal", "size", "tint", "segment")
    seen = None if leaves.seen is None else leaves.seen[keep]
    return replace(leaves, seen=seen, **{name: getattr(leaves, name)[keep] for name in columns})
