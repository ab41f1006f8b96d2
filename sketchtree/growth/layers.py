"""In what order are all rows of one generation next to each other, and all children of one row?

Rows in this order turn every pass over the tree into a few operations on slices, for any number of times at once. Sums
go over children in one fixed order: what grows in every part grows in every sum, to the last bit.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.traverse import generations


@dataclass(frozen=True, eq=False)
class Layers:
    """Rows by generation, siblings together."""

    order: Int[np.ndarray, " segment"]  # row of the tree at each place
    place: Int[np.ndarray, " segment"]  # place of each row
    parent: Int[np.ndarray, " segment"]  # place of the parent of the row at each place; NULL at a base
    cut: Int[np.ndarray, " layer+1"]  # places of layer k: cut[k] … cut[k + 1]

    @classmethod
    def of(cls, parent: Int[np.ndarray, " segment"]) -> "Layers":
        """The layers of a `parent` column whose parents precede their children."""
        place = np.full(len(parent), NULL)
        order, cut = [np.zeros(0, np.int64)], [0]
        for rows in generations(parent):
            if parent[rows[0]] != NULL:
                rows = rows[np.argsort(place[parent[rows]], kind="stable")]
            place[rows] = cut[-1] + np.arange(len(rows))
            cut.append(cut[-1] + len(rows))
            order.append(rows)
        order = np.concatenate(order)
        above = parent[order]
        return cls(order, place, np.where(above == NULL, NULL, place[above]), np.array(cut))

    @property
    def ground(self) -> int:
        """How many rows are bases: they stand first."""
        return int(self.cut[1]) if len(self.cut) > 1 else 0

    def downwards(self):
        """The slices of all layers but the bases', from the ground to the tips."""
        return [slice(low, high) for low, high in zip(self.cut[1:-1], self.cut[2:], strict=True)]

    def sum_to_root(self, value: Float[np.ndarray, "segment time"]) -> None:
        """Add to every row, in place, all that its descendants have. Rows stand at their places."""
        for layer in reversed(self.downwards()):
            above = self.parent[layer]
            first = np.flatnonzero(np.r_[True, np.diff(above) != 0])
            value[above[first]] += np.add.reduceat(value[layer], first, axis=0)
