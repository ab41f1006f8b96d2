"""What has grown so far? Nodes in the order in which they came, each with the cycle in which it was born and that in which it was shed."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL

NEVER = np.iinfo(np.int64).max


@dataclass(frozen=True, eq=False)
class Wood:
    """Nodes, parents first; a row stays where it is for good."""

    parent: Int[np.ndarray, " node"]  # NULL at a root
    place: Float[np.ndarray, "node 3"]
    born: Int[np.ndarray, " node"]  # cycle, 0 for what growth began with
    gone: Int[np.ndarray, " node"]  # cycle; NEVER while it stands

    def __len__(self) -> int:
        return len(self.parent)

    @classmethod
    def of(cls, parent: Int[np.ndarray, " node"], place: Float[np.ndarray, "node 3"]) -> "Wood":
        """What growth begins with."""
        return cls(parent, place, np.zeros(len(parent), np.int64), np.full(len(parent), NEVER))

    def with_nodes(self, parent: Int[np.ndarray, " new"], place: Float[np.ndarray, "new 3"], cycle: int) -> "Wood":
        """The same and what grew in a cycle; `parent` numbers rows of the result."""
        born, gone = np.full(len(parent), cycle), np.full(len(parent), NEVER)
        return Wood(np.r_[self.parent, parent], np.concatenate([self.place, place]), np.r_[self.born, born], np.r_[self.gone, gone])

    def without(self, shed: Bool[np.ndarray, " node"], cycle: int) -> "Wood":
        """The same, some of it shed."""
        return Wood(self.parent, self.place, self.born, np.where(shed & (self.gone == NEVER), cycle, self.gone))

    def standing(self, cycle: int | None = None) -> Int[np.ndarray, " row"]:
        """Rows that stand after a cycle, or now."""
        if cycle is None:
            return np.flatnonzero(self.gone == NEVER)
        return np.flatnonzero((self.born <= cycle) & (self.gone > cycle))

    def step(self) -> Float[np.ndarray, " node"]:
        """From every node's parent to it; 0 at a root."""
        return np.where(self.parent == NULL, 0.0, np.linalg.norm(self.place - self.place[self.parent], axis=1))
