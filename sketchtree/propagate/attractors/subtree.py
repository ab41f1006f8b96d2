"""What may a branch be replaced by? A subtree with a supporting branch from (0, 0, 0) to (0, 1, 0) (Tan et al. 2008, §3.1, Figure 4).

    type I    new branches grow at the end of the supporting branch
    type II   new branches grow along it

A branch is a chain of straight pieces, so that it can bow; each generation of branches has `RATIO` times the radius of the one that bears it.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL

RATIO = 0.75  # of the parent's radius (§2, last lines)
PIECES = 3  # of a branch


@dataclass(frozen=True, eq=False)
class Subtree:
    """New branches on a supporting branch. Requirements: parents precede their children."""

    name: str
    parent: Int[np.ndarray, " piece"]  # NULL: on the supporting branch
    vector: Float[np.ndarray, "piece 3"]  # from its start to its end; the supporting branch is 1 long
    share: Float[np.ndarray, " piece"]  # where on the supporting branch its lowest ancestor starts, 0-1
    branch: Int[np.ndarray, " piece"]  # which branch of the subtree it is a piece of, from 0
    along: Float[np.ndarray, " piece"]  # how far along its branch it ends, 0-1
    generation: Int[np.ndarray, " piece"]  # 1 on the supporting branch

    def __len__(self) -> int:
        return len(self.parent)

    @property
    def branches(self) -> int:
        """How many new branches it has."""
        return int(self.branch.max()) + 1

    @property
    def is_type_one(self) -> bool:
        """Whether all new branches grow at the end of the supporting branch."""
        return bool((self.share >= 1.0).all())

    @property
    def end(self) -> Float[np.ndarray, "piece 3"]:
        """Where each piece ends, the supporting branch being straight."""
        end = np.zeros((len(self), 3))
        for piece, above in enumerate(self.parent):
            end[piece] = self.vector[piece] + (end[above] if above != NULL else [0.0, self.share[piece], 0.0])
        return end

    @cached_property
    def reach(self) -> float:
        """How far its farthest end is from the middle of the supporting branch; the supporting branch is 1 long."""
        return float(np.linalg.norm(self.end - [0.0, 0.5, 0.0], axis=1).max())


class Sprouting:
    """A subtree while it is written down: branch after branch."""

    def __init__(self, name: str):
        self.name = name
        self._pieces: list[tuple] = []

    def branch(self, share: float, angle: float, azimuth: float, length: float, bow: float = 0.35, on: int | None = None, pieces: int = PIECES) -> int:
        """One branch more: `angle` degrees off the branch that bears it, `azimuth` degrees about it; it bows towards that by `bow` of the angle. `on`: the piece at whose
        end it grows; None: on the supporting branch. The number of its first piece."""
        axis = np.array([0.0, 1.0, 0.0]) if on is None else self._pieces[on][1]
        first, number = len(self._pieces), 1 + max((piece[3] for piece in self._pieces), default=-1)
        generation = 1 if on is None else self._pieces[on][5] + 1
        share = share if on is None else self._pieces[on][2]
        for piece in range(pieces):
            lean = angle * (1.0 - bow * piece / max(pieces - 1, 1))
            above = first + piece - 1 if piece else (NULL if on is None else on)
            self._pieces.append((above, length / pieces * _off(axis, lean, azimuth), share, number, (piece + 1) / pieces, generation))
        return first

    def chain(self, share: float, vectors, on: int | None = None) -> int:
        """One branch more, of these pieces. The number of its first piece."""
        first, number = len(self._pieces), 1 + max((piece[3] for piece in self._pieces), default=-1)
        generation = 1 if on is None else self._pieces[on][5] + 1
        share = share if on is None else self._pieces[on][2]
        for piece, vector in enumerate(vectors):
            above = first + piece - 1 if piece else (NULL if on is None else on)
            self._pieces.append((above, np.asarray(vector, float), share, number, (piece + 1) / len(vectors), generation))
        return first

    def done(self) -> Subtree:
        """The subtree."""
        parent, vector, share, branch, along, generation = zip(*self._pieces, strict=True)
        return Subtree(self.name, np.array(parent), np.array(vector), np.array(share, float), np.array(branch), np.array(along, float), np.array(generation))


def _off(axis, angle: float, azimuth: float):
    """The unit direction `angle` degrees off an axis, `azimuth` degrees about it."""
    y = axis / np.linalg.norm(axis)
    side = np.array([1.0, 0.0, 0.0]) if abs(y[0]) < 0.9 else np.array([0.0, 0.0, 1.0])
    x = side - (side @ y) * y
    x /= np.linalg.norm(x)
    z = np.cross(x, y)
    a, b = np.radians(angle), np.radians(azimuth)
    return np.cos(a) * y + np.sin(a) * (np.cos(b) * x + np.sin(b) * z)
