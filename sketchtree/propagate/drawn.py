"""What of the drawn tree may grow on?

Generation 0 is what was drawn (Chen et al. 2008, §6). It offers two things to the first generation:

    open tips   the ends of drawn limbs, which grow on by `EXTENSION` of their length, or to the crown
    nodes       every h metres along the limbs, from their bare base on (`laterals`), unless a lateral was
                drawn just there, in the same direction

A drawn trunk is bare up to its first drawn limb: where the drawing begins to branch, so does the tree.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.parameters import Habit
from sketchtree.propagate.attach_block import Nodes
from sketchtree.propagate.envelope import Envelope
from sketchtree.propagate.laterals import Split
from sketchtree.propagate.library import Library
from sketchtree.propagate.open_branch import OpenBranches, arc_length, frames, limb_arcs
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import is_tip

EXTENSION = np.array([0.04, 0.12])  # of a drawn limb's length, without a crown; by order 0, 1+
_EXTENSION_TWIGS = 3.5  # twig lengths, at most, without a crown
CROWN_EXTENSION = 0.5  # of a drawn limb's length, at most, towards the crown
_PRESSES = 1.08  # times its straight way to the crown: a limb that bends still meets the surface
BEARING = 2.2  # twig lengths: a shorter limb bears no laterals
_BEGINS = 0.06  # of the trunk's length: a palm's new fronds may start this far below its first drawn one
_APART = np.cos(np.radians(25.0))  # a new lateral this close to a drawn one's direction is not grown


def open_tips(
    tree: TreeSkeleton, spacing: Float[np.ndarray, " segment"], habit: Habit, envelope: Envelope | None, key: Key[Array, ""]
) -> OpenBranches:
    """The ends of drawn limbs as open branches. Tips outside the crown are closed, and so are limbs of
    the deepest order: what was drawn there is their whole length."""
    arc, whole = limb_arcs(tree)
    grows = (tree.order < habit.max_order) & ((tree.order > 0) | (habit.max_order > 1))
    rows = np.flatnonzero(is_tip(tree.parent) & ~tree.is_base & grows)
    frame = frames(tree)[rows]
    length = EXTENSION[np.minimum(tree.order[rows], 1)] * whole[rows] * (0.7 + 0.6 * keys.uniform(key, tree.limb[rows], 8))
    length = np.minimum(length, _EXTENSION_TWIGS * habit.twig_length)
    if envelope is not None and envelope.binding:
        far = CROWN_EXTENSION * whole[rows]
        reach = envelope.exit_fraction(tree.tip[rows], tree.tip[rows] + far[:, None] * frame[:, :, 1])
        length = np.where(envelope.inside(tree.tip[rows]), np.minimum(_PRESSES * reach, 1.0) * far, 0.0)
    keep = length > 0.3 * habit.twig_length
    rows, frame, length = rows[keep], frame[keep], length[keep]
    return OpenBranches(
        row=rows,
        origin=tree.tip[rows],
        frame=frame,
        limb=tree.limb[rows],
        order=tree.order[rows],
        tree=tree.tree[rows],
        length=length,
        grown=arc[rows],
        node=np.rint(arc[rows] / spacing[rows]).astype(np.int64) + 1,
        radius=tree.radius[rows],
        bends=np.ones(len(rows), bool),
    )


def drawn_nodes(
    split: Split,
    open_: OpenBranches,
    library: Library,
    habit: Habit,
    envelope: Envelope | None,
    led: dict[int, float] | None = None,
) -> Nodes:
    """The nodes along drawn limbs that may bear new laterals (`position` counts what the tip will yet grow, and `led`
    the length of limbs that go on into the crown as leaders, by limb id)."""
    tree = split.tree
    arc, whole = limb_arcs(tree)
    grows = dict(zip(open_.limb.tolist(), open_.length.tolist(), strict=True))
    whole = whole + np.array([grows.get(limb, 0.0) for limb in tree.limb.tolist()])
    whole = np.maximum(whole, np.array([(led or {}).get(limb, 0.0) for limb in tree.limb.tolist()]))
    rows = np.flatnonzero((split.number != NULL) & (tree.order < len(library.bare)))
    bare = bare_length(tree, library, envelope)
    rows = rows[arc[rows] >= bare[rows] - 1e-9]
    end = whole
    if habit.max_order == 1:  # a palm: what its trunk's stroke draws beyond the last frond is a frond
        last = _drawn_laterals_end(tree, arc)
        end = np.where((tree.order == 0) & np.isfinite(last), last, whole)
    rows = rows[arc[rows] <= end[rows] + 1e-9]
    if envelope is not None and envelope.binding:
        rows = rows[envelope.inside(tree.tip[rows])]
    return Nodes(
        row=rows,
        tip=tree.tip[rows],
        frame=frames(tree)[rows],
        limb=tree.limb[rows],
        order=tree.order[rows],
        tree=tree.tree[rows],
        number=split.number[rows],
        position=arc[rows] / end[rows],
        zone=np.clip((arc[rows] - bare[rows]) / np.maximum(end[rows] - bare[rows], 1e-9), 0.0, 1.0),
        whole=end[rows],
        radius=tree.radius[rows],
    )


def bare_length(tree: TreeSkeleton, library: Library, envelope: Envelope | None = None) -> Float[np.ndarray, " segment"]:
    """Metres of each row's limb, from its insertion on, that bear no new lateral. A trunk without drawn limbs is bare
    up to the drawn crown, if there is one, as far as the exemplar's where there is none."""
    arc, whole = limb_arcs(tree)
    share = library.bare[np.minimum(tree.order, len(library.bare) - 1)]
    bare = share * whole
    first = first_drawn_lateral(tree, arc)
    below = _BEGINS if len(library.bare) == 2 else 0.0  # max_order 1: a palm
    if envelope is not None and envelope.binding:
        bare = np.where(tree.order == 0, _enters(tree, arc, envelope), bare)
    begins = np.where(np.isfinite(first), np.maximum(first - below * whole, 0.0), bare)
    return np.where(tree.order == 0, begins, bare)


def rank_of_drawn(tree: TreeSkeleton, habit: Habit) -> Int[np.ndarray, " segment"]:
    """The order each drawn row grows by: its own, or a lower one where its limb is too long for that.

    Forks drawn one upon the other give limbs of high orders that are no twigs. A limb as long as one that bears, ℓ_1,
    still bears laterals; with each 1 / lateral_ratio longer, one order more stands between it and the deepest:

        rank = min(order, max(max_order − 1 − ⌊log(ℓ / ℓ_1) / log(1 / lateral_ratio)⌋, 2))        ℓ ≥ ℓ_1
    """
    _, whole = limb_arcs(tree)
    times = np.maximum(whole / (BEARING * habit.twig_length), 1e-9)
    more = np.floor(np.log(times) / np.log(1.0 / np.clip(habit.lateral_ratio, 0.2, 0.7)))
    by_length = np.maximum(habit.max_order - 1 - more, 2).astype(np.int64)
    return np.where((times >= 1.0) & (habit.max_order > 2), np.minimum(tree.order, by_length), tree.order)


def _enters(tree, arc, envelope):
    """Arc where every row's limb first comes into the crown, metres: at the start of the first row that ends inside,
    the limb's end if none does."""
    limbs, of_row = np.unique(tree.limb, return_inverse=True)
    within = ~tree.is_base & envelope.inside(tree.tip)
    first, end = np.full(len(limbs), np.inf), np.zeros(len(limbs))
    np.minimum.at(first, of_row[within], arc[within] - arc_length(tree)[within])
    np.maximum.at(end, of_row, arc)
    return np.where(np.isfinite(first), first, end)[of_row]


def _drawn_laterals_end(tree, arc):
    """Arc of the last drawn lateral of every row's limb, metres; -inf where there is none."""
    at, limbs, of_row = _lateral_nodes(tree)
    last = np.full(limbs, -np.inf)
    np.maximum.at(last, of_row[at], arc[at])
    return last[of_row]


def first_drawn_lateral(tree, arc):
    """Arc of the first drawn lateral of every row's limb, metres; inf where there is none."""
    at, limbs, of_row = _lateral_nodes(tree)
    first = np.full(limbs, np.inf)
    np.minimum.at(first, of_row[at], arc[at])
    return first[of_row]


def _lateral_nodes(tree):
    """(rows that bear a drawn lateral, number of limbs, dense limb number of every row)."""
    above = np.where(tree.parent == NULL, 0, tree.parent)
    lateral = np.flatnonzero((tree.parent != NULL) & (tree.limb != tree.limb[above]))
    limbs, of_row = np.unique(tree.limb, return_inverse=True)
    return tree.parent[lateral], len(limbs), of_row


@dataclass(frozen=True, eq=False)
class DrawnLaterals:
    """The drawn laterals, sorted along one axis on which every limb has a stretch of its own."""

    place: Float[np.ndarray, " lateral"]  # limb · stretch + arc of the node, rising
    limb: Int[np.ndarray, " lateral"]  # dense number of the parent limb
    node: Int[np.ndarray, " lateral"]  # row it grows from
    heading: Float[np.ndarray, "lateral 3"]  # unit
    end: Float[np.ndarray, "lateral 3"]  # tip of the whole lateral, metres
    length: Float[np.ndarray, " lateral"]  # of the whole lateral, metres
    at: Float[np.ndarray, " segment"]  # the same axis for the tip of every row of the tree
    of_row: Int[np.ndarray, " segment"]

    @classmethod
    def of(cls, tree: TreeSkeleton) -> "DrawnLaterals":
        """All laterals of a drawn tree."""
        arc, whole = limb_arcs(tree)
        _, of_row = np.unique(tree.limb, return_inverse=True)
        at = of_row * (2.0 * arc.max(initial=0.0) + 1.0) + arc
        above = np.where(tree.parent == NULL, 0, tree.parent)
        rows = np.flatnonzero((tree.parent != NULL) & (tree.limb != tree.limb[above]) & (tree.length > 0))
        rows = rows[np.argsort(at[tree.parent[rows]], kind="stable")]
        node = tree.parent[rows]
        tip = np.zeros(of_row.max(initial=-1) + 1, np.int64)
        tip[of_row] = np.arange(len(tree))
        heading = tree.vector[rows] / tree.length[rows][:, None]
        return cls(at[node], of_row[node], node, heading, tree.tip[tip[of_row[rows]]], whole[rows], at, of_row)

    def beside(
        self, new: OpenBranches, spacing: Float[np.ndarray, " segment"]
    ) -> Bool[np.ndarray, " branch"]:
        """Which new branches start near a drawn lateral of the same limb and point its way."""
        clash = np.zeros(len(new), bool)
        if not len(self.place):
            return clash
        at = self.at[new.row]
        following = np.searchsorted(self.place, at)
        for offset in (-2, -1, 0, 1):
            other = np.clip(following + offset, 0, len(self.place) - 1)
            near = np.abs(self.place[other] - at) < 1.2 * spacing[new.row]
            clash |= near & (np.einsum("bi,bi->b", self.heading[other], new.frame[:, :, 1]) > _APART)
        return clash

    def usual_length(self, new: OpenBranches) -> Float[np.ndarray, " branch"]:
        """How long the drawn laterals are where each new branch starts, interpolated along the limb; NaN
        on limbs with none. On the page a limb is as long as it was drawn or longer in depth, never shorter."""
        usual = np.full(len(new), np.nan)
        if not len(self.place):
            return usual
        at, limb = self.at[new.row], self.of_row[new.row]
        right = np.clip(np.searchsorted(self.place, at), 0, len(self.place) - 1)
        left = np.maximum(right - 1, 0)
        right_on, left_on = self.limb[right] == limb, self.limb[left] == limb
        span = self.place[right] - self.place[left]
        t = np.clip(np.where(span > 0, (at - self.place[left]) / np.where(span > 0, span, 1.0), 1.0), 0.0, 1.0)
        t = np.where(left_on & right_on, t, np.where(right_on, 1.0, 0.0))
        between = (1 - t) * self.length[left] + t * self.length[right]
        return np.where(left_on | right_on, between, np.nan)
