"""What of the drawn tree may grow on?

Generation 0 is what was drawn (Chen et al. 2008, §6). It offers two things to the first generation:

    open tips   the ends of drawn limbs, which grow on by `EXTENSION` of their length, or to the crown
    nodes       every h metres along the limbs, from their bare base on (`laterals`), unless a lateral was
                drawn just there, in the same direction

A drawn trunk is bare up to its first drawn limb: where the drawing begins to branch, so does the tree.
"""

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree import keys
from sketchtree.axes import NULL
from sketchtree.parameters import Habit
from sketchtree.propagate.blocks.attach_block import Nodes
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.drawn.laterals import Split
from sketchtree.propagate.blocks.library import Library
from sketchtree.propagate.blocks.open_branch import OpenBranches, arc_length, frames, limb_arcs
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import is_tip

EXTENSION = np.array([0.04, 0.12])  # of a drawn limb's length, without a crown; by order 0, 1+
_EXTENSION_TWIGS = 3.5  # twig lengths, at most, without a crown
CROWN_EXTENSION = 0.5  # of a drawn limb's length, at most, towards the crown
_PRESSES = 1.08  # times its straight way to the crown: a limb that bends still meets the surface
BEARING = 2.2  # twig lengths: a shorter limb bears no laterals
_BEGINS = 0.06  # of the trunk's length: a palm's new fronds may start this far below its first drawn one


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
