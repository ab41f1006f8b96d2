"""How do the limbs that grew become rows of the skeleton again?

Where a new limb grows on a given one, that row is split, at the point of its drawn curve (`split_at`): the projection and every point drawn stay. A new limb has a row for each of its pieces, and where
others grow on it between their ends one row more. Parents precede their children because limbs do.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.propagate.attractors.wood import Limb, Wood
from sketchtree.propagate.drawn.laterals import Split, split_at
from sketchtree.skeleton import Kind, TreeSkeleton

_SNAP = 0.02  # of a limb's length: a node this near to where a limb grows takes its place


def assembled(tree: TreeSkeleton, wood: Wood) -> tuple[TreeSkeleton, Int[np.ndarray, " segment"], Int[np.ndarray, " given"]]:
    """(the tree with all that grew on it, the generation of every row, where the rows of the tree given are). Generation 0 is what was given."""
    split, foot = _split(tree, wood)
    nodes = _Nodes(wood, foot, len(split.tree))
    for number in range(wood.given, len(wood)):
        nodes.take(number)
    grown = split.tree.append(nodes.columns(int(tree.tree[0]))) if nodes.parent else split.tree
    return grown, np.r_[np.zeros(len(split.tree), np.int64), np.array(nodes.generation, np.int64)], split.row


class _Nodes:
    """The new rows, limb after limb."""

    def __init__(self, wood: Wood, foot: dict[int, int], first: int):
        self.wood, self.foot, self.first = wood, foot, first
        self.parent, self.tip, self.radius, self.order, self.limb, self.generation = [], [], [], [], [], []
        self.arcs: dict[int, tuple[Float[np.ndarray, " node"], int]] = {}  # of each limb: metres along it of its nodes, its first row
        self.borne: dict[int, list[float]] = {}
        for limb in wood.limbs[wood.given :]:
            self.borne.setdefault(limb.parent, []).append(limb.at)

    def take(self, number: int) -> None:
        """The rows of one new limb."""
        limb = self.wood.limbs[number]
        arc = _with(limb.arc[1:], np.array(self.borne.get(number, [])), _SNAP * limb.length)
        row = self.first + len(self.parent)
        self.arcs[number] = arc, row
        self.parent += [self._row_at(number, limb), *range(row, row + len(arc) - 1)]
        self.tip.append(limb.place(arc))
        for column, value in ((self.radius, limb.radius), (self.order, limb.order), (self.limb, limb.identity), (self.generation, limb.generation - 1)):
            column += [value] * len(arc)

    def _row_at(self, number: int, limb: Limb) -> int:
        """The row that a limb grows on."""
        if limb.parent < self.wood.given:
            return self.foot[number]
        arc, row = self.arcs[limb.parent]
        return row + int(np.argmin(np.abs(arc - limb.at)))

    def columns(self, tree: int) -> dict:
        """The rows as columns of a skeleton."""
        count = len(self.parent)
        return {
            "parent": np.array(self.parent), "tip": np.concatenate(self.tip), "radius": np.array(self.radius), "order": np.array(self.order), "limb": np.array(self.limb, np.int64),
            "tree": np.full(count, tree), "kind": np.full(count, int(Kind.PROPAGATED)),
        }  # fmt: skip


def _with(node: Float[np.ndarray, " node"], more: Float[np.ndarray, " more"], snap: float) -> Float[np.ndarray, " node"]:
    """The nodes and those that aren't within `snap` of one, rising."""
    for arc in np.sort(more):
        if np.abs(node - arc).min() > snap:
            node = np.sort(np.r_[node, arc])
    return node


def _split(tree: TreeSkeleton, wood: Wood) -> tuple[Split, dict[int, int]]:
    """(the tree with a node wherever a new limb grows on it, the row of the split tree that each of those grows on)."""
    owner, at, who, at_tip = [], [], [], {}
    for number in range(wood.given, len(wood)):
        limb = wood.limbs[number]
        if limb.parent >= wood.given:
            continue
        bearer = wood.limbs[limb.parent]
        snap = _SNAP * bearer.length
        k = int(np.argmin(np.abs(bearer.row_end - limb.at)))
        if abs(bearer.row_end[k] - limb.at) <= snap:
            at_tip[number] = bearer.rows[k]
            continue
        k = min(int(np.searchsorted(bearer.row_end, limb.at)), len(bearer.rows) - 1)
        begin = bearer.row_end[k - 1] if k else 0.0
        owner.append(bearer.rows[k]), at.append(limb.at - begin), who.append(number)
    split, rows = split_at(tree, np.array(owner, np.int64), np.array(at, float))
    return split, {number: int(split.row[row]) for number, row in at_tip.items()} | dict(zip(who, rows.tolist(), strict=True))
