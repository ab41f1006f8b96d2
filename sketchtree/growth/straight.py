"""How is a tree of curved rows one of straight pieces, and back?

A drawn row may be a curve. Growth and bending go piece by piece, so every drawn point between two tips becomes a row of its own
here, with a radius between those of the row's ends, and is put back as a drawn point afterwards.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton


@dataclass(frozen=True, eq=False)
class Straight:
    """A tree, and the same tree without curves."""

    tree: TreeSkeleton
    pieces: TreeSkeleton  # one row a straight piece; the tree itself where nothing is curved
    row: Int[np.ndarray, " piece"]  # which row of the tree each piece is of
    last: Int[np.ndarray, " segment"]  # the piece that ends at each row's tip

    @classmethod
    def of(cls, tree: TreeSkeleton) -> "Straight":
        """The straight pieces of a tree."""
        count = np.diff(tree.curve_start) + 1
        last = np.cumsum(count) - 1
        row = np.repeat(np.arange(len(tree)), count)
        if len(tree.curve_points) == 0:
            return cls(tree, tree, row, last)
        return cls(tree, _cut(tree, row, last, count), row, last)

    def back(self, tip: Float[np.ndarray, "piece 3"], radius: Float[np.ndarray, " piece"], grown: Float[np.ndarray, " piece"]) -> TreeSkeleton:
        """The tree with its pieces ending where `tip` says, as far as they have grown (0-1): rows that have not begun are left out."""
        count = np.diff(self.tree.curve_start) + 1
        first = self.last - count + 1
        inner = np.ones(len(self.row), bool)
        inner[self.last] = False
        ended = (grown >= 1) & inner
        begun = (grown[first] > 0) | self.tree.is_base
        grows_on = np.r_[grown[1:] > 0, False]  # the next piece of the same row, for all but the last
        points = ended & grows_on
        start = np.r_[0, np.cumsum(np.bincount(self.row[points], minlength=len(self.tree)))]
        grown_tree = self.tree.replace(tip=tip[self.last], radius=radius[self.last], curve_points=tip[points], curve_start=start)
        return grown_tree if begun.all() else grown_tree.select(begun)


def straightened(tree: TreeSkeleton) -> TreeSkeleton:
    """The tree with every drawn point as a row of its own."""
    return Straight.of(tree).pieces


def radius_at_start(tree: TreeSkeleton) -> Float[np.ndarray, " segment"]:
    """Radius where each row starts, metres: its parent's where it carries that one's limb on or leaves the ground, else its own."""
    above = np.where(tree.is_base, np.arange(len(tree)), tree.parent)
    goes_on = (tree.limb[above] == tree.limb) | tree.is_base[above]
    return np.where(goes_on, np.maximum(tree.radius[above], tree.radius), tree.radius)


def _cut(tree: TreeSkeleton, row, last, count) -> TreeSkeleton:
    number = np.arange(len(row)) - (last - count + 1)[row]
    is_last = number == count[row] - 1
    parent = np.where(number > 0, np.arange(len(row)) - 1, np.where(tree.parent[row] == NULL, NULL, last[tree.parent[row]]))
    tip = np.empty((len(row), 3))
    tip[is_last], tip[~is_last] = tree.tip, tree.curve_points
    way = np.where((parent == NULL)[:, None], 0.0, tip - tip[parent])
    run = np.cumsum(np.linalg.norm(way, axis=1))
    before = (run - np.linalg.norm(way, axis=1))[last - count + 1][row]
    share = (run - before) / np.maximum(run[last][row] - before, 1e-300)
    radius = (1 - share) * radius_at_start(tree)[row] + share * tree.radius[row]
    columns = {name: getattr(tree, name)[row] for name in ("order", "limb", "stroke", "tree", "kind", "depth_sd", "age")}
    return TreeSkeleton.from_columns(parent, tip, np.where(is_last, tree.radius[row], radius), **columns)
