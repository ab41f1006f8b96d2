"""Which branches run through each other?

Every row is taken for a capsule: its axis, through its drawn points, thickened by r, the mean of its radii at start and tip. Two rows
overlap where the axes come nearer than both are thick,

    |p − q| < r_i + r_j        p, q  the points of the two axes that are nearest to each other;  depth = r_i + r_j − |p − q|

and they are not made of one piece of wood anyway. No pair counts

    of one limb; that shares a node; within a grandparent (of parent, sibling, uncle, grandparent)
    whose nearest points lie in the wood of the fork that both come from: |p − o| < 1.5 R, where o is where the limb of one starts, R
    the radius of the limb it starts on, and the other is of that limb too, or of another that starts on it
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.propagate.after.capsules import Balls, Capsules
from sketchtree.propagate.after.cutting import pieces, start_radius
from sketchtree.propagate.after.nearest import nearest
from sketchtree.skeleton import Kind, TreeSkeleton

FORK = 1.5  # radii of the limb that bears it, a fork's wood reaches


@dataclass(frozen=True, eq=False)
class Overlaps:
    """Pairs that run through each other, each once: of the pieces of two rows the deepest."""

    one: Int[np.ndarray, " pair"]  # row
    other: Int[np.ndarray, " pair"]
    depth: Float[np.ndarray, " pair"]  # metres by which they are too near
    at_one: Float[np.ndarray, "pair 3"]  # nearest point on the axis of `one`, metres
    at_other: Float[np.ndarray, "pair 3"]
    owner: Int[np.ndarray, " pair"]  # of the piece of `one`: which of the pieces asked about it is of

    def __len__(self) -> int:
        return len(self.one)

    def select(self, which) -> "Overlaps":
        """Some of the pairs."""
        return Overlaps(*(getattr(self, name)[which] for name in _COLUMNS))

    def swapped(self, which: Bool[np.ndarray, " pair"]) -> "Overlaps":
        """The same pairs, in some of them `one` and `other` exchanged."""
        one, other = np.where(which, self.other, self.one), np.where(which, self.one, self.other)
        at_one = np.where(which[:, None], self.at_other, self.at_one)
        at_other = np.where(which[:, None], self.at_one, self.at_other)
        return Overlaps(one, other, self.depth, at_one, at_other, self.owner)

    @classmethod
    def join(cls, parts: list["Overlaps"]) -> "Overlaps":
        """All pairs of several."""
        return cls(*(np.concatenate([getattr(part, name) for part in parts]) for name in _COLUMNS)) if parts else _NONE

    def deepest(self) -> "Overlaps":
        """Of several entries of the same owner and rows the deepest, in their order."""
        order = np.lexsort((*self.at_one.T, -self.depth, self.other, self.one, self.owner))
        names = ("owner", "one", "other")
        new = np.any([np.diff(getattr(self, name)[order]) != 0 for name in names], axis=0)
        return self.select(order[np.r_[True, new]]) if len(order) else self


_COLUMNS = ("one", "other", "depth", "at_one", "at_other", "owner")
_ROWS = np.zeros(0, np.int64)
_NONE = Overlaps(_ROWS, _ROWS, np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), _ROWS)


@dataclass(frozen=True, eq=False)
class Kinship:
    """Which rows are one piece of wood anyway."""

    parent: Int[np.ndarray, " segment"]
    limb: Int[np.ndarray, " segment"]
    node: Int[np.ndarray, " segment"]  # row at whose tip each row's limb starts; of a stem, its base
    thick: Float[np.ndarray, " segment"]  # R there, metres
    crotch: float = FORK  # radii R that a limb may take to leave the limb that bears it

    @classmethod
    def of(cls, tree: TreeSkeleton, crotch: float = FORK) -> "Kinship":
        """That of a tree with its radii."""
        first = first_rows(tree.parent, goes_on(tree))
        node = np.where(tree.is_base, np.arange(len(tree)), tree.parent)[first]
        return cls(tree.parent, tree.limb, node, tree.radius[node], crotch)

    def near(self, i: Int[np.ndarray, " pair"], j: Int[np.ndarray, " pair"]) -> Bool[np.ndarray, " pair"]:
        """Rows of one limb, that share a node, or within a grandparent of each other."""
        above_i, above_j = self.parent[i], self.parent[j]
        over_i, over_j = self.parent[above_i], self.parent[above_j]
        kin = (self.limb[i] == self.limb[j]) | (above_i == above_j) | (above_i == j) | (above_j == i)
        return kin | (over_i == j) | (over_j == i) | (over_i == above_j) | (over_j == above_i)

    def in_a_fork(self, i, at, j, tip: Float[np.ndarray, "segment 3"]) -> Bool[np.ndarray, " pair"]:
        """Points `at` (pair 3) of rows i in the wood of the fork that their limbs and those of rows j come from."""
        starts = self.node[i]
        radii = np.linalg.norm(at - tip[starts], axis=1) / self.thick[i]
        bears, beside = self.limb[j] == self.limb[starts], self.limb[self.node[j]] == self.limb[starts]
        return ((radii < FORK) & (bears | beside)) | ((radii < self.crotch) & bears)


def overlapping(tree: TreeSkeleton, *, swell: float = 1.0) -> Overlaps:
    """All pairs of rows that overlap, `one` the lower row. `swell` times the radii count."""
    row, start, end, _ = pieces(tree)
    wood = Capsules.cut(row, start, end, swell * capsule_radius(tree)[row], usual_length(tree))
    kin = Kinship.of(tree)
    found = [touching(kin, tree.tip, wood, i, wood, j) for i, j in Balls.of(wood).each_other()]
    pairs = Overlaps.join(found)
    pairs = pairs.swapped(pairs.one > pairs.other)
    return replace(pairs, owner=pairs.one).deepest()


def touching(kin: Kinship, tip, wood: Capsules, i, others: Capsules, j) -> Overlaps:
    """Of pairs of pieces (i of `wood`, j of `others`) those that overlap and are not one piece of wood anyway. `tip` (segment 3): of all rows."""
    apart = ~kin.near(wood.row[i], others.row[j])
    i, j = i[apart], j[apart]
    s, t = nearest(wood.start[i], wood.vector[i], others.start[j], others.vector[j])
    p, q = wood.at(i, s), others.at(j, t)
    depth = wood.radius[i] + others.radius[j] - np.linalg.norm(p - q, axis=1)
    one, other = wood.row[i], others.row[j]
    hit = np.flatnonzero(depth > 0)
    hit = hit[~(kin.in_a_fork(one[hit], p[hit], other[hit], tip) | kin.in_a_fork(other[hit], q[hit], one[hit], tip))]
    return Overlaps(one[hit], other[hit], depth[hit], p[hit], q[hit], wood.owner[i[hit]])


def usual_length(tree: TreeSkeleton) -> float:
    """The median length of a row, metres: how long pieces are best cut for the search."""
    length = tree.length[tree.length > 0]
    return float(np.median(length)) if len(length) else 1.0


def capsule_radius(tree: TreeSkeleton) -> Float[np.ndarray, " segment"]:
    """The mean of each row's radii at start and tip, metres."""
    return 0.5 * (start_radius(tree) + tree.radius)


def share_overlapping(tree: TreeSkeleton, found: Overlaps | None = None) -> tuple[float, float]:
    """The shares of the undrawn segments that overlap with another undrawn one, and with any, 0-1."""
    found = overlapping(tree) if found is None else found
    new = is_undrawn(tree) & ~tree.is_base
    both = new[found.one] & new[found.other]
    among_new, with_any = np.zeros((2, len(tree)), bool)
    for rows in (found.one, found.other):
        among_new[rows[both]] = True
        with_any[rows] = True
    count = max(int(new.sum()), 1)
    return float(among_new.sum() / count), float((with_any & new).sum() / count)


def is_undrawn(tree: TreeSkeleton) -> Bool[np.ndarray, " segment"]:
    """Rows that were grown, not drawn or seen."""
    return np.isin(tree.kind, (int(Kind.PROPAGATED), int(Kind.GROWN)))


def first_rows(parent: Int[np.ndarray, " segment"], goes_on: Bool[np.ndarray, " segment"]) -> Int[np.ndarray, " segment"]:
    """The row that each row's run starts with, where `goes_on` says which rows are of one run with their parents."""
    first = np.where(goes_on, parent, np.arange(len(parent)))
    while (first[first] != first).any():
        first = first[first]
    return first


def goes_on(tree: TreeSkeleton) -> Bool[np.ndarray, " segment"]:
    """Rows that are of their parent's limb."""
    return ~tree.is_base & (tree.limb[tree.parent] == tree.limb)
