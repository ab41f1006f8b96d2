"""In what manner does this tree branch? How far apart, on which nodes, by which blocks.

    spacing    of the nodes of a limb: the habit's, or as wide as on the exemplar, less `_CLOSER`
    share      of the nodes that bear: all, but where `density` is below 1 or the drawing is thorough (`blocks.likened`)
    lot        of a node, 0-1: it bears where this is below the share.  lot = (u + k / golden ratio) mod 1

    u          the limb's own number;  k  the node's: however many bear, they are spread evenly along the limb, and with a
               larger share those of a smaller one bear all the same
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree import keys
from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.blocks.attach_block import Nodes, attach
from sketchtree.propagate.blocks.block import blocks_of, blocks_of_parameters
from sketchtree.propagate.blocks.library import Library, library
from sketchtree.propagate.blocks.likened import likened, thoroughness
from sketchtree.propagate.blocks.open_branch import OpenBranches
from sketchtree.propagate.drawn.ends import BEARING
from sketchtree.propagate.drawn.implied import WEEPING
from sketchtree.propagate.limb_growth import NODES
from sketchtree.propagate.scale import height, to_scale
from sketchtree.propagate.wanted import Wanted
from sketchtree.skeleton import TreeSkeleton

_TRUNK_SPACING = 1.6  # of the habit's spacing of laterals
_WEEPS = 1.2  # times as far apart where limbs hang: whips of neighbouring nodes hang side by side all the way down
_CLOSER = 0.72  # times the habit's spacing, nodes lie closer than on the exemplar, which is a skeleton without its twigs
_SPARSEST = 4.0  # times the habit's spacing, at most
_DRAWN_NODES = 4  # of a drawn limb, at least, if that is not closer than the habit's spacing
_GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)  # steps of this part of a circle leave its points as evenly apart as may be, however many
_SPREAD = 0.35  # κ of `attach`: the share of Θ's spread that is added to what the blocks differ by themselves
_ANY_RATIO = 0.6  # of lateral to limb, that any tree may have
_ANY_BARE = 0.1  # of a limb that bears nothing before its first lateral, on the measured trees
_LONG = (0.5, 2.0)  # of the tree's height: on nine measured trees shorter limbs bear fewer laterals a metre, by about this power
_SHORT = 1.15  # of two spaces: a limb that is shorter has two nodes all the same, and bears on fewer of them


@dataclass(frozen=True, eq=False)
class Manner:
    """By what one tree grows: its habit to scale, the blocks to choose from, and how thoroughly it was drawn."""

    habit: Habit  # lengths to the tree's scale
    theta: TreeParameters
    library: Library
    scale: float  # the tree's height, metres
    thorough: float  # 0-1, `blocks.likened.thoroughness`
    density: float  # laterals a metre, over the habit's

    @classmethod
    def of(cls, tree: TreeSkeleton, wanted: Wanted) -> "Manner":
        """The manner of a drawn tree: the exemplar's, made more like what was drawn; the habit's where there is none to lend."""
        habit = to_scale(wanted.habit, tree, wanted.crown)
        own, (lender, supplement) = blocks_of(tree) if wanted.like is None else wanted.like, _supplement(wanted, habit)
        thorough = _thorough(wanted, own, supplement, lender)
        if not wanted.fixed:
            supplement = likened(supplement, own, thorough)
        habit = _as_drawn(habit, thorough)
        chosen = library(own, supplement, wanted.theta, habit.max_order, lender, likened=not wanted.fixed)
        bare = chosen.bare + thorough * np.minimum(_ANY_BARE - chosen.bare, 0.0)
        chosen = replace(chosen, bare=bare, longest=np.inf * chosen.longest if thorough > 0.5 else chosen.longest)
        return cls(habit, wanted.theta, chosen, height(tree, wanted.crown), thorough, wanted.density)

    @property
    def apart(self) -> float:
        """How far laterals lie apart, metres, where gaps are looked for."""
        return self.habit.lateral_spacing / np.sqrt(min(self.density, 1.0))

    def spacing(self, order: Int[np.ndarray, " limb"], whole: Float[np.ndarray, " limb"]) -> Float[np.ndarray, " limb"]:
        """Metres between the nodes of limbs of these orders and whole lengths: the habit's, or wider where the exemplar
        has few laterals; never more than a hundred or so nodes a limb."""
        habit = self.habit.lateral_spacing
        wide = np.where((order == 0) & (self.habit.arrangement != "whorled"), _TRUNK_SPACING, 1.0) * habit
        lent = self.library.spacing[np.minimum(order, self.habit.max_order)] * self.scale
        lent = np.clip(lent - _CLOSER * habit, habit, _SPARSEST * habit)
        apart = (_WEEPS if self.habit.gravitropism > WEEPING else 1.0) / max(self.density, 1.0)
        return np.maximum(np.where(np.isnan(lent), wide, lent) * apart, whole / (4 * NODES))

    def drawn_spacing(self, order: Int[np.ndarray, " limb"], whole: Float[np.ndarray, " limb"]) -> Float[np.ndarray, " limb"]:
        """As `spacing`, but a drawn limb that bears has `_DRAWN_NODES` nodes or more, as close as the habit's."""
        return np.minimum(self.spacing(order, whole), np.maximum(whole / _DRAWN_NODES, self.habit.lateral_spacing))

    def bears(self, order: Int[np.ndarray, " limb"], whole: Float[np.ndarray, " limb"]) -> Bool[np.ndarray, " limb"]:
        """Whether limbs of these orders and whole lengths (metres) bear laterals."""
        return (order < self.habit.max_order) & (whole >= BEARING * self.habit.twig_length)

    def share(self, nodes: Nodes, drawn: Bool[np.ndarray, " node"]) -> Float[np.ndarray, " node"]:
        """How likely each node is to bear, 0-1: `density`, where that is below 1; and where the drawing is thorough, so
        that what it lacks is not there, nothing on the trunk, none at a limb's last node, less on limbs that are shorter
        than two spaces, and on `drawn` limbs the less the shorter they are (`_LONG`)."""
        limb = nodes.order > 0
        spaces = np.minimum(_SHORT * nodes.whole / (2.0 * self.spacing(nodes.order, nodes.whole)), 1.0)
        long = np.where(drawn, np.minimum(nodes.whole / (_LONG[0] * self.scale), 1.0) ** _LONG[1], 1.0)
        as_drawn = np.where(limb, spaces * long * (nodes.position < 1.0), 0.0)
        return min(self.density, 1.0) * (1.0 - self.thorough + self.thorough * as_drawn)

    def laterals(self, nodes: Nodes, drawn: Bool[np.ndarray, " node"], key: np.uint64) -> OpenBranches:
        """The branches that the blocks on these nodes open."""
        lib = self.library
        able = self.bears(nodes.order, nodes.whole) & (nodes.zone >= 0)
        nodes, drawn = nodes.select(able), drawn[able]
        lot = (keys.uniform(key, nodes.limb, 30) + nodes.number * _GOLDEN) % 1.0
        nodes = nodes.select(lot < self.share(nodes, drawn))
        block = lib.choose(lib.lateral, nodes.order, nodes.zone, keys.uniform(key, nodes.id, 10))
        opened = attach(nodes, block, lib.blocks, self.habit, self.theta, key, spread=_SPREAD * (1.0 - self.thorough))
        longest = lib.longest[np.minimum(opened.order, len(lib.longest) - 1)] * self.scale
        return replace(opened, length=np.minimum(opened.length, longest))


_lent_blocks = lru_cache(maxsize=32)(blocks_of)  # an exemplar is one frozen object for all the trees it lends to


def _supplement(wanted: Wanted, habit: Habit):
    """(the exemplar, its blocks); none and the habit's blocks where there is no exemplar that branches."""
    supplement = None if wanted.exemplar is None else _lent_blocks(wanted.exemplar)
    if supplement is None or not (supplement.lateral_count.any() and supplement.has_apical.any()):
        return None, blocks_of_parameters(wanted.theta, habit)
    return wanted.exemplar, supplement


def _thorough(wanted: Wanted, own, supplement, lender) -> float:
    if wanted.thorough is not None:
        return wanted.thorough
    return 0.0 if wanted.fixed or lender is None else thoroughness(own, supplement)


def _as_drawn(habit: Habit, thorough: float) -> Habit:
    """The habit, its rules of how long laterals may be loosened as far as a thorough drawing shows that itself."""
    return replace(
        habit,
        apical_control=habit.apical_control * (1.0 - thorough),
        lateral_ratio=max(habit.lateral_ratio, thorough * _ANY_RATIO),
    )
