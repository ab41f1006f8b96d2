"""Which pieces of wood are near each other? Straight pieces, each in a ball, found by k-d trees.

A piece is cut into shorter ones, about as long as a usual one or as it is thick, and every one of those lies in the ball

    |x − m| ≤ R        m  its middle,  R = ℓ/2 + r

Balls of like size (a class each doubling of R) share a tree. Only pieces whose balls meet are named. Memory is bounded:
`_CHUNK` balls ask at a time, neighbours together.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

_CHUNK = 20_000  # balls that ask at a time
_AT_ONCE = 150_000  # balls of one class that may all ask each other at once
_USUAL = 0.9  # of all balls are in the class of the smallest

Pairs = tuple[Int[np.ndarray, " pair"], Int[np.ndarray, " pair"]]


@dataclass(frozen=True, eq=False)
class Capsules:
    """Short straight pieces of wood."""

    row: Int[np.ndarray, " piece"]  # of the tree
    owner: Int[np.ndarray, " piece"]  # which of the pieces given it is of
    start: Float[np.ndarray, "piece 3"]  # metres
    vector: Float[np.ndarray, "piece 3"]
    radius: Float[np.ndarray, " piece"]  # of the wood, metres

    @classmethod
    def cut(
        cls,
        row: Int[np.ndarray, " whole"],
        start: Float[np.ndarray, "whole 3"],
        end: Float[np.ndarray, "whole 3"],
        radius: Float[np.ndarray, " whole"],
        usual: float,
    ) -> "Capsules":
        """The pieces from `start` to `end`, none much longer than `usual` (metres) or twice its radius; those without length are left out."""
        long = np.linalg.norm(end - start, axis=1)
        count = np.ceil(long / np.maximum(usual, 2.0 * radius)).astype(np.int64)
        owner = np.repeat(np.arange(len(long)), count)
        number = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
        vector = ((end - start) / np.maximum(count, 1)[:, None])[owner]
        return cls(row[owner], owner, start[owner] + number[:, None] * vector, vector, radius[owner])

    def join(self, other: "Capsules") -> "Capsules":
        """These pieces, then the others."""
        return Capsules(*(np.concatenate([getattr(self, name), getattr(other, name)]) for name in _COLUMNS))

    def __len__(self) -> int:
        return len(self.row)

    def select(self, which) -> "Capsules":
        """Some of the pieces."""
        return Capsules(*(getattr(self, name)[which] for name in _COLUMNS))

    def at(self, piece: Int[np.ndarray, " point"], share: Float[np.ndarray, " point"]) -> Float[np.ndarray, "point 3"]:
        """The point at a share of the axis of each of these pieces, metres."""
        return self.start[piece] + share[:, None] * self.vector[piece]


_COLUMNS = ("row", "owner", "start", "vector", "radius")


@dataclass(frozen=True, eq=False)
class Balls:
    """The balls about pieces, a tree for each class of size."""

    middle: Float[np.ndarray, "piece 3"]
    reach: Float[np.ndarray, " piece"]
    classes: tuple[Int[np.ndarray, " piece"], ...]  # pieces of each class, the smallest first
    trees: tuple[cKDTree, ...]

    @classmethod
    def of(cls, pieces: Capsules) -> "Balls":
        """The balls of these pieces."""
        half = 0.5 * pieces.vector
        middle = pieces.start + half
        reach = np.sqrt(np.einsum("bi,bi->b", half, half)) + pieces.radius
        size = np.ceil(np.log2(np.maximum(reach / np.quantile(reach, _USUAL), 1.0))) if len(reach) else reach
        classes = tuple(np.flatnonzero(size == one) for one in np.unique(size))
        return cls(middle, reach, classes, tuple(cKDTree(middle[one]) for one in classes))

    def each_other(self) -> Iterator[Pairs]:
        """Every pair of pieces whose balls meet, once."""
        for a, members in enumerate(self.classes):
            if len(members) <= _AT_ONCE:
                first, second = members[self.trees[a].query_pairs(2 * self.reach[members].max(), output_type="ndarray")].T
                yield self._meeting(self, first, second)
            else:
                for first, second in self._of_class(self, a, range(a, a + 1)):
                    yield first[first < second], second[first < second]
            yield from self._of_class(self, a, range(a + 1, len(self.classes)))

    def meeting(self, others: "Balls") -> Iterator[Pairs]:
        """Every piece of these and every one of the others whose balls meet."""
        for a in range(len(self.classes)):
            yield from self._of_class(others, a, range(len(others.classes)))

    def _of_class(self, others: "Balls", a: int, its_classes) -> Iterator[Pairs]:
        asking = self.classes[a][self.trees[a].indices]  # neighbours stand together
        for begin in range(0, len(asking) if its_classes else 0, _CHUNK):
            chunk, near = asking[begin : begin + _CHUNK], self.trees[a]
            if len(chunk) < len(asking):
                near = cKDTree(self.middle[chunk])
            else:
                chunk = self.classes[a]
            widest = self.reach[chunk].max()
            for b in its_classes:
                members = others.classes[b]
                met = near.sparse_distance_matrix(others.trees[b], widest + others.reach[members].max(), output_type="ndarray")
                yield self._meeting(others, chunk[met["i"]], members[met["j"]])

    def _meeting(self, others: "Balls", first, second) -> Pairs:
        between = self.middle[first] - others.middle[second]
        meet = np.einsum("bi,bi->b", between, between) < (self.reach[first] + others.reach[second]) ** 2
        return first[meet], second[meet]
