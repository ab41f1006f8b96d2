"""What moves as one piece, and in what order do branches find their places?

A *branch* is the undrawn part of a limb: it starts where it leaves another limb, or where drawn wood ends, and turns about that
place with all it bears. What is drawn, or bears anything drawn, is in no branch and stays.

Branches are taken in *ranks*, the heavy before the light and the bearing before the borne:

    rank = max(class, rank of the branch that bears it + 1)       class = −⌊log₄ w⌋
    w      wood of the branch and of all it bears, in whole micrometres, so that sums are the same in any order

Everything a rank depends on lies in the branch itself and below it, so that a stroke drawn elsewhere changes none.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.propagate.after.cutting import bears
from sketchtree.propagate.after.overlaps import first_rows, goes_on, is_undrawn
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import children, generations

GRAIN = 1e-6  # metres
_LIGHTEST = 32  # class of a branch of no wood


@dataclass(frozen=True, eq=False)
class Branches:
    """The branches of a tree. Columns of rows, then of branches."""

    moves: Bool[np.ndarray, " segment"]
    of_row: Int[np.ndarray, " segment"]  # its branch; NULL of what stays
    wood: Float[np.ndarray, " segment"]  # of the row and of all it bears, whole micrometres; infinite of what stays
    place: Int[np.ndarray, " segment"]  # in an order in which all that a row bears stands just after it
    size: Int[np.ndarray, " segment"]  # rows of that, with the row itself
    at_place: Int[np.ndarray, " segment"]  # the row at each place
    first: Int[np.ndarray, " branch"]  # its first row
    node: Int[np.ndarray, " branch"]  # row at whose tip it starts
    above: Int[np.ndarray, " branch"]  # the branch that bears it, NULL if none does
    rank: Int[np.ndarray, " branch"]

    @classmethod
    def of(cls, tree: TreeSkeleton) -> "Branches":
        """Those of a tree. Rows with drawn points, and what bears any, stay too."""
        steps = generations(tree.parent)
        stays = tree.is_base | ~is_undrawn(tree) | (np.diff(tree.curve_start) > 0)
        moves = ~bears(tree.parent, stays)
        wood, size = np.rint(tree.length / GRAIN), np.ones(len(tree), np.int64)
        for rows in reversed(steps[1:]):
            np.add.at(wood, tree.parent[rows], wood[rows])
            np.add.at(size, tree.parent[rows], size[rows])
        row = first_rows(tree.parent, goes_on(tree) & moves & moves[tree.parent])
        first, of_row = np.unique(np.where(moves, row, NULL), return_inverse=True)
        if len(first) and first[0] == NULL:
            first, of_row = first[1:], of_row - 1
        node = tree.parent[first]
        place = _places(tree.parent, steps, size)
        at_place = np.argsort(place)
        above = of_row[node]
        return cls(
            moves, of_row, np.where(moves, wood, np.inf), place, size, at_place, first, node, above, _ranks(wood[first], above)
        )

    def borne(self, rows: Int[np.ndarray, " row"]) -> tuple[Int[np.ndarray, " all"], Int[np.ndarray, " all"]]:
        """(which of these rows, row) of all that each of them bears, itself first."""
        count = self.size[rows]
        which = np.repeat(np.arange(len(rows)), count)
        return which, self.at_place[self.place[rows][which] + np.arange(len(which)) - (np.cumsum(count) - count)[which]]


def _ranks(wood, above):
    rank = _LIGHTEST - np.floor(0.5 * np.log2(np.maximum(wood, 1.0))).astype(np.int64)
    for rows in generations(above)[1:]:
        rank[rows] = np.maximum(rank[rows], rank[above[rows]] + 1)
    return rank


def _places(parent, steps, size):
    """The place of every row, each before all that it bears."""
    child, start = children(parent)
    run = np.cumsum(size[child]) - size[child]
    before, place = np.zeros((2, len(parent)), np.int64)
    before[child] = run - run[start[parent[child]]]
    bases = np.flatnonzero(parent == NULL)
    place[bases] = np.cumsum(size[bases]) - size[bases]
    for rows in steps[1:]:
        place[rows] = place[parent[rows]] + 1 + before[rows]
    return place
