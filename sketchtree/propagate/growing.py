"""The tree while it grows: what has been made, and what is still open.

    spacing    of the nodes of a limb: the habit's, or as wide as on the exemplar, less `_CLOSER`
    drawn      generation 0; its long rows are split at the nodes that may bear laterals
    open       the branches that the next generation grows
    parts      the rows of every generation done
"""

import dataclasses
from dataclasses import replace
from functools import lru_cache

import numpy as np
from jaxtyping import Float, Int

from sketchtree import keys
from sketchtree.parameters import Habit
from sketchtree.propagate.blocks.attach_block import MINIMUM_LENGTH, Nodes, attach
from sketchtree.propagate.blocks.block import blocks_of, blocks_of_parameters
from sketchtree.propagate.drawn.drawn_laterals import DrawnLaterals
from sketchtree.propagate.drawn.ends import BEARING, bare_length, drawn_nodes, open_tips, rank_of_drawn
from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.space.obstacles import Obstacles
from sketchtree.propagate.space.space import Space
from sketchtree.propagate.fill import GAP, HALO, HOLLOW, HOLLOW_GAP, emptiness, empty_around, empty_points, towards
from sketchtree.propagate.drawn.gaps import into_gaps
from sketchtree.propagate.drawn.implied import WEEPING, implied_crown
from sketchtree.propagate.drawn.laterals import split_long
from sketchtree.propagate.drawn.leaders import leaders
from sketchtree.propagate.blocks.library import library
from sketchtree.propagate.blocks.likened import likened, thoroughness
from sketchtree.propagate.limb_growth import NODES, grow, plan
from sketchtree.propagate.blocks.open_branch import OpenBranches, frames, limb_arcs
from sketchtree.propagate.wanted import Wanted
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import generations

_BARE_NODES = 4  # about, of a limb that bears none: enough for its curve
_TRUNK_SPACING = 1.6  # of the habit's spacing of laterals
_WEEPS = 1.2  # times as far apart where limbs hang: whips of neighbouring nodes hang side by side all the way down
_CLOSER = 0.72  # times the habit's spacing, nodes lie closer than on the exemplar, which is a skeleton without its twigs
_SPARSEST = 4.0  # times the habit's spacing, at most
_ROUND = 2  # generations of one round of filling; what is then still open grows on in the next
_DRAWN_NODES = 4  # of a drawn limb, at least, if that is not closer than the habit's spacing
_LARGEST_SCALE = 1.25  # of a habit's lengths: a larger tree has more twigs, not larger ones
_LIKE_BLOCK = 1.5  # times the length its block says, a new limb on the trunk is no longer than that
_PRESSES = 1.08  # times its straight way to the crown: a branch that bends still meets the surface
_GROUND = (0.015, 0.1)  # of the tree's height: undrawn limbs stay this far above the ground, and up to that much more
_NEARS = (0.6, 1.05)  # of its way to the crown's surface: a leader's lateral is at least as long as between these
_GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)  # steps of this part of a circle leave its points as evenly apart as may be, however many
_SPREAD = 0.35  # κ of `attach`: the share of Θ's spread that is added to what the blocks differ by themselves
_ANY_RATIO = 0.6  # of lateral to limb, that any tree may have
_LONG = (0.5, 2.0)  # of the tree's height: on nine measured trees shorter limbs bear fewer laterals a metre, by about this power
_SHORT = 1.15  # of two spaces: a limb that is shorter has two nodes all the same, and bears on fewer of them
_LIKE_DRAWN = 1.1  # times the drawn laterals around it, a new one on a drawn limb is no longer


class Growing:
    """The tree while it grows: the rows made so far and the branches still open."""

    def __init__(self, tree, wanted: Wanted, key):
        crown, exemplar = wanted.crown, wanted.exemplar
        self.wanted, self.theta = wanted, wanted.theta
        self.key = keys.draw_key(key)
        usual = to_scale(wanted.habit, tree, crown)
        self.envelope = Envelope.from_outlines(crown) if len(crown) else implied_crown(tree, usual, exemplar)
        self.habit = usual
        self.apart = usual.lateral_spacing / np.sqrt(min(wanted.density, 1.0))
        self.scale = _height(tree, crown)
        self.obstacles = self._in_the_way(tree, wanted)
        self.space = self._space()
        own = blocks_of(tree)
        lender, supplement = _supplement(wanted, self.habit)
        self.thorough = _thorough(wanted, own, supplement, lender)
        supplement = supplement if wanted.fixed else likened(supplement, own, self.thorough)
        self.habit = _as_drawn(self.habit, self.thorough)
        self.library = library(own, supplement, self.theta, self.habit.max_order, lender, likened=not wanted.fixed)
        bare = self.library.bare + self.thorough * np.minimum(0.1 - self.library.bare, 0.0)
        self.library = replace(self.library, bare=bare)
        self.ground = float(tree.tip[tree.is_base, 1].min())
        self.order_of = dict(zip(tree.limb.tolist(), tree.order.tolist(), strict=True))
        self.drawn = self._split(tree.replace(order=rank_of_drawn(tree, self.habit)))
        self.parts, self.rows, self.done, self.stopped_by = [], len(self.drawn.tree), 0, "generations"
        self.segments = self.drawn.tree.segment_count
        self.leaders = self._lead()
        self.open = self._first_generation()
        self.outside = len(self.open) == 0 and len(crown) > 0 and not self.envelope.inside(tree.tip).any()

    def _in_the_way(self, tree, wanted) -> Obstacles | None:
        """The obstacles in the tree's reach, if any were given."""
        if not (wanted.obstacles or wanted.regions):
            return None
        return Obstacles.build(wanted.obstacles, wanted.regions, Domain.of(tree, self.envelope, self.habit, self.scale))

    def _space(self) -> Space:
        """The crown and the obstacles; those out of reach change nothing."""
        crown = () if self.envelope is None else (self.envelope,)
        return Space((*crown, self.obstacles), (self.obstacles,)) if self.obstacles else Space(crown)

    def _split(self, tree):
        arc, whole = limb_arcs(tree)
        self.spacing = self._drawn_spacing(tree.order, whole)
        bears = (tree.order < self.habit.max_order) & (arc > bare_length(tree, self.library, self.envelope))
        split = split_long(tree, self.spacing, bears)
        _, whole = limb_arcs(split.tree)
        self.spacing = self._drawn_spacing(split.tree.order, whole)
        return split

    def _drawn_spacing(self, order, whole):
        """As `_spacing`, but a drawn limb that bears has `_DRAWN_NODES` nodes or more, as close as the habit's."""
        return np.minimum(self._spacing(order, whole), np.maximum(whole / _DRAWN_NODES, self.habit.lateral_spacing))

    def _lead(self):
        """The limbs that go on into a crown which the drawing left empty: the first generation, if there are any."""
        most = self.wanted.max_segments - self.segments
        found = leaders(self.drawn.tree, self.envelope, self.habit, self.spacing, self.key, most=most, obstacles=self.obstacles)
        if found is not None:
            self.parts.append((found.nodes, found.parent))
            self.rows, self.segments, self.done = self.rows + len(found), self.segments + len(found), 1
        return found

    def _first_generation(self) -> OpenBranches:
        tree = self.drawn.tree
        led = self.leaders.grown if self.leaders else {}
        tips = open_tips(tree, self.spacing, self.habit, self.envelope, self.key)
        tips = tips.select(~np.isin(tips.limb, list(led)) & (self.thorough < 0.5))
        self.drawn_nodes = drawn_nodes(self.drawn, tips, self.library, self.habit, self.envelope, led)
        new = self._laterals(self.drawn_nodes)
        drawn = DrawnLaterals.of(tree)
        usual = drawn.usual_length(new)
        at_most = np.minimum(new.length, _LIKE_DRAWN * usual)
        like = usual * (0.8 + 0.25 * keys.uniform(self.key, new.limb, 12))
        like = np.where(new.order == 1, np.minimum(like, _LIKE_BLOCK * new.length), at_most)
        length = np.where(np.isnan(usual), new.length, like)
        new = replace(new, length=length).select(~drawn.beside(new, self.spacing))
        if self.habit.max_order > 0 and self.thorough < 0.5:
            new = new.join(self._free(into_gaps(tree, frames(tree), drawn, new, self.key)))
        if self.leaders:
            new = self._to_surface(new, np.isin(tree.limb[new.row], list(led)))
            beside = self._laterals(self.leaders.nodes)
            new = new.join(self._to_surface(beside, np.ones(len(beside), bool)))
        return tips.join(new)

    def _to_surface(self, opened: OpenBranches, led) -> OpenBranches:
        """The same, those on `led` limbs as long as it takes to come near the crown's surface, half the crown at most."""
        widest = 0.5 * max(lobe.reach for lobe in self.envelope.lobes)
        way = self.space.exit_fraction(opened.origin, opened.origin + widest * opened.frame[:, :, 1], bisections=7) * widest
        way = way * (_NEARS[0] + (_NEARS[1] - _NEARS[0]) * keys.uniform(self.key, opened.limb, 15))
        return replace(opened, length=np.where(led, np.maximum(opened.length, way), opened.length))

    def _spacing(self, order, whole):
        """Metres between the nodes of limbs of these orders and whole lengths: the habit's, or wider where the exemplar
        has few laterals; never more than a hundred or so nodes a limb."""
        habit = self.habit.lateral_spacing
        wide = np.where((order == 0) & (self.habit.arrangement != "whorled"), _TRUNK_SPACING, 1.0) * habit
        lent = self.library.spacing[np.minimum(order, self.habit.max_order)] * self.scale
        lent = np.clip(lent - _CLOSER * habit, habit, _SPARSEST * habit)
        apart = _WEEPS if self.habit.gravitropism > WEEPING else 1.0
        apart = apart / max(self.wanted.density, 1.0)
        return np.maximum(np.where(np.isnan(lent), wide, lent) * apart, whole / (4 * NODES))

    def run(self, limit: int) -> None:
        """Generation after generation, until `limit` of them are done or nothing is open."""
        while self.done < limit and self.generation():
            pass

    def fill(self, round_: int, limit: int, gap: float = GAP) -> bool:
        """One round of growth into what is still empty (farther than `gap` spacings of laterals from every node);
        False where nothing is, or no more may be grown."""
        if self.envelope is None or self.done >= limit or self.stopped_by == "max_segments":
            return False
        nodes = self._nodes()
        empty = empty_points(self.envelope, nodes.tip, gap * self.apart)
        outside = ~self.envelope.inside(nodes.tip)
        if not self.envelope.binding:
            drawn = nodes.select(outside & (nodes.order > 0) & (nodes.row < len(self.drawn.tree)))
            reach = np.minimum(HALO[0] * drawn.whole, HALO[1] * self.apart)
            empty = np.concatenate([empty, empty_around(drawn, reach, nodes.tip, gap * self.apart)])
        empty = empty[self.space.inside(empty)]
        bears = (nodes.order < self.habit.max_order) & ~(outside & self.envelope.binding)
        new = towards(empty, nodes.select(bears), self.habit, self.theta, round_, self.key)
        self.open = self.open.join(self._free(new) if self.space.guides else new)
        before = self.rows
        self.run(min(limit, self.done + _ROUND))
        return self.rows > before

    def is_hollow(self) -> bool:
        """Whether much of the crown is still empty: of an implied one, or of one drawn around next to nothing. Limbs
        drawn into a crown say themselves where it is full; what grows from each is then its own alone."""
        if self.envelope is None or self.habit.max_order < 2 or (self.envelope.binding and not self.leaders):
            return False
        if self.leaders:
            return True
        wood = np.concatenate([self.drawn.tree.tip] + [part.tip for part, _ in self.parts])
        return emptiness(self.envelope, wood, HOLLOW_GAP * self.apart, self.space) > HOLLOW + (1.0 - HOLLOW) * min(2.0 * self.thorough, 1.0)

    def _nodes(self) -> Nodes:
        """All nodes that may bear laterals."""
        nodes = self.drawn_nodes
        for part, _ in self.parts:
            nodes = nodes.join(part)
        return nodes

    def generation(self) -> bool:
        """Grow all open branches; False where there was nothing to grow."""
        if self.stopped_by == "max_segments":
            return False
        if len(self.open) == 0:
            self.stopped_by = "habit"
            return False
        whole = self.open.length + self.open.grown
        spacing = self._spacing(self.open.order, whole)
        spacing = np.where(self._bears(self.open.order, whole), spacing, np.maximum(spacing, whole / _BARE_NODES))
        nodes = plan(self.open, self.library, spacing, self.key)
        keep = self._within_limit(nodes.count)
        if not keep.all():
            self.open = self.open.select(keep)
            nodes = plan(self.open, self.library, spacing[keep], self.key)
            self.stopped_by = "max_segments"
        uneven = _GROUND[0] + _GROUND[1] * keys.uniform(self.key, self.open.limb, 11) ** 2
        ground = self.ground + uneven * self.scale
        grown, parent = grow(
            self.open, nodes, self.library, self.habit, self.theta, self.space, ground, self.key,
            first_row=self.rows,
        )  # fmt: skip
        self.parts.append((grown, parent))
        self.rows, self.segments, self.done = self.rows + len(grown), self.segments + len(grown), self.done + 1
        if self.stopped_by == "max_segments":
            self.open = self.open.select(slice(0, 0))
            return False
        self.open = self._laterals(grown)
        return True

    def _laterals(self, nodes: Nodes) -> OpenBranches:
        """The branches that the blocks on these nodes open."""
        lib = self.library
        nodes = nodes.select(self._bears(nodes.order, nodes.whole) & (nodes.zone >= 0))
        lot = (keys.uniform(self.key, nodes.limb, 30) + nodes.number * _GOLDEN) % 1.0
        nodes = nodes.select(lot < self._share(nodes))
        block = lib.choose(lib.lateral, nodes.order, nodes.zone, keys.uniform(self.key, nodes.id, 10))
        opened = attach(nodes, block, lib.blocks, self.habit, self.theta, self.key, spread=_SPREAD * (1.0 - self.thorough))
        longest = lib.longest[np.minimum(opened.order, len(lib.longest) - 1)] * self.scale
        longest = np.where(self.thorough > 0.5, np.inf, longest)
        return self._free(replace(opened, length=np.minimum(opened.length, longest)))

    def _share(self, nodes: Nodes) -> Float[np.ndarray, " node"]:
        """How likely each node is to bear, 0-1: `density`, where that is below 1; and where the drawing is thorough, so
        that what it lacks is not there, next to nothing on the trunk, none at a limb's last node, less on limbs that are shorter
        than two spaces, and on drawn limbs the less the shorter they are (`_LONG`)."""
        limb = nodes.order > 0
        spaces = np.minimum(_SHORT * nodes.whole / (2.0 * self._spacing(nodes.order, nodes.whole)), 1.0)
        drawn = limb & (nodes.row < len(self.drawn.tree))
        long = np.where(drawn, np.minimum(nodes.whole / (_LONG[0] * self.scale), 1.0) ** _LONG[1], 1.0)
        as_drawn = np.where(limb, spaces * long * (nodes.position < 1.0), 0.0)
        return min(self.wanted.density, 1.0) * (1.0 - self.thorough + self.thorough * as_drawn)

    def _bears(self, order, whole):
        """Whether limbs of these orders and whole lengths (metres) bear laterals."""
        return (order < self.habit.max_order) & (whole >= BEARING * self.habit.twig_length)

    def enter(self, space: Space) -> None:
        """Grow on in this space: what is open is planned no longer than its barriers say."""
        self.space = space
        self.open = self._free(self.open)

    def _free(self, opened: OpenBranches) -> OpenBranches:
        """The same, each no longer than its way to a barrier; those left too short are not opened."""
        if not self.space.barriers:
            return opened
        end = opened.origin + opened.length[:, None] * opened.frame[:, :, 1]
        reach = _PRESSES * self.space.reach(opened.origin, end, bisections=7)
        length = opened.length * np.minimum(reach, 1.0)
        opened = replace(opened, length=length)
        return opened.select(length >= MINIMUM_LENGTH * self.habit.twig_length)

    def _within_limit(self, count):
        """Which open branches are grown so that the whole keeps to `max_segments`: thinned evenly, by limb id."""
        left = self.wanted.max_segments - self.segments
        if count.sum() <= left:
            return np.ones(len(count), bool)
        lot = np.argsort(keys.uniform(self.key, self.open.limb, 9), kind="stable")
        keep = np.zeros(len(count), bool)
        keep[lot] = np.cumsum(count[lot]) <= left
        return keep

    def skeleton(self) -> TreeSkeleton:
        """The drawn rows and all that grew."""
        drawn = self.drawn.tree
        drawn = drawn.replace(order=np.array([self.order_of[limb] for limb in drawn.limb.tolist()], np.int64))
        if not self.parts:
            return drawn
        names = ("tip", "radius", "limb", "tree")
        columns = {name: np.concatenate([getattr(part, name) for part, _ in self.parts]) for name in names}
        parent = np.concatenate([parent for _, parent in self.parts])
        rank = np.concatenate([drawn.order] + [part.order for part, _ in self.parts])
        columns["order"] = _orders(np.r_[drawn.parent, parent], np.r_[drawn.limb, columns["limb"]], rank, len(drawn))[len(drawn) :]
        return drawn.append(columns | {"parent": parent, "kind": np.full(len(parent), int(Kind.PROPAGATED))})

    def generation_of_rows(self) -> Int[np.ndarray, " segment"]:
        """The generation of every row of `skeleton()`."""
        count = [len(self.drawn.tree)] + [len(part) for part, _ in self.parts]
        return np.repeat(np.arange(len(count)), count)


def _orders(parent, limb, order, drawn: int):
    """The order of every row: a new row has its parent's, and one more where a limb begins."""
    order = order.copy()
    for rows in generations(parent)[1:]:
        new = rows[rows >= drawn]
        above = parent[new]
        order[new] = order[above] + (limb[new] != limb[above])
    return order


_lent_blocks = lru_cache(maxsize=32)(blocks_of)  # an exemplar is one frozen object for all the trees it lends to


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


def _supplement(wanted: Wanted, habit):
    """(the exemplar, its blocks); none and the habit's blocks where there is no exemplar that branches."""
    supplement = None if wanted.exemplar is None else _lent_blocks(wanted.exemplar)
    if supplement is None or not (supplement.lateral_count.any() and supplement.has_apical.any()):
        return None, blocks_of_parameters(wanted.theta, habit)
    return wanted.exemplar, supplement


def _height(tree: TreeSkeleton, crown) -> float:
    """Metres from the ground to the top of the drawing, its crown included."""
    top = max((float(np.max(np.asarray(outline)[:, 1])) for outline in crown), default=-np.inf)
    return max(tree.height, top - float(tree.tip[tree.is_base, 1].min()))


def to_scale(habit: Habit, tree: TreeSkeleton, crown: tuple = ()) -> Habit:
    """The habit's lengths for a tree of another height (its crown's, if that is higher): a small tree has smaller
    twigs, a large one more of them."""
    scale = float(np.clip(_height(tree, crown) / habit.height, 0.01, _LARGEST_SCALE))
    return dataclasses.replace(
        habit,
        lateral_spacing=habit.lateral_spacing * scale,
        twig_length=habit.twig_length * scale,
        gravitropism=habit.gravitropism / scale,
    )

