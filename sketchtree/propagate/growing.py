"""The tree while it grows: what has been made, and what is still open.

    manner     how it branches: spacing, blocks, which nodes bear
    drawn      generation 0; its long rows are split at the nodes that may bear laterals
    open       the branches that the next generation grows
    parts      the rows of every generation done
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Int

from sketchtree import keys
from sketchtree.parameters import Habit
from sketchtree.propagate.blocks.attach_block import MINIMUM_LENGTH, Nodes
from sketchtree.propagate.blocks.open_branch import OpenBranches, frames, limb_arcs
from sketchtree.propagate.drawn.drawn_laterals import DrawnLaterals
from sketchtree.propagate.drawn.ends import bare_length, drawn_nodes, open_tips, rank_of_drawn
from sketchtree.propagate.drawn.gaps import into_gaps
from sketchtree.propagate.drawn.implied import implied_crown
from sketchtree.propagate.drawn.laterals import split_long
from sketchtree.propagate.drawn.leaders import leaders, to_surface
from sketchtree.propagate.fill import GAP, HALO, HOLLOW, HOLLOW_GAP, emptiness, empty_around, empty_points, towards
from sketchtree.propagate.limb_growth import grow, plan
from sketchtree.propagate.manner import Manner
from sketchtree.propagate.space.domain import Domain
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.space.obstacles import Obstacles
from sketchtree.propagate.space.space import Space
from sketchtree.propagate.wanted import Wanted
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import generations, is_tip

_BARE_NODES = 4  # about, of a limb that bears none: enough for its curve
_ROUND = 2  # generations of one round of filling; what is then still open grows on in the next
_PRESSES = 1.08  # times its straight way to the crown: a branch that bends still meets the surface
_GROUND = (0.015, 0.1)  # of the tree's height: undrawn limbs stay this far above the ground, and up to that much more


class Growing:
    """The tree while it grows: the rows made so far and the branches still open."""

    def __init__(self, tree, wanted: Wanted, key):
        self.wanted, self.key = wanted, keys.draw_key(key)
        self.manner = Manner.of(tree, wanted)
        self.envelope = _crown(tree, wanted, self.habit)
        self.obstacles = self._in_the_way(tree, wanted)
        self.space = self._space()
        self.ground = float(tree.tip[tree.is_base, 1].min())
        self.order_of = dict(zip(tree.limb.tolist(), tree.order.tolist(), strict=True))
        self.drawn = self._split(tree.replace(order=rank_of_drawn(tree, self.habit)))
        self.parts, self.rows, self.done, self.stopped_by = [], len(self.drawn.tree), 0, "generations"
        self.segments = self.drawn.tree.segment_count
        self.leaders = self._lead()
        self.open = self._first_generation()
        self.outside = len(self.open) == 0 and len(wanted.crown) > 0 and not self.envelope.inside(tree.tip).any()

    @property
    def habit(self) -> Habit:
        """The tree's habit, its lengths to scale."""
        return self.manner.habit

    @property
    def scale(self) -> float:
        """The tree's height, metres."""
        return self.manner.scale

    def limbs_aside(self) -> tuple[int, bool]:
        """How many drawn limbs there are, if the user's crown holds the tips of none of them, else 0 (a lone one may lead to
        it); and whether the page shows one in it, so that only their depths take them out."""
        tree = self.drawn.tree
        tips = tree.tip[is_tip(tree.parent) & (tree.order > 0)]
        if len(self.wanted.crown) == 0 or len(tips) < 2 or self.envelope.inside(tips).any():
            return 0, False
        return len(tips), bool(self.envelope.on_page(tips).any())

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
        self.spacing = self.manner.drawn_spacing(tree.order, whole)
        bears = (tree.order < self.habit.max_order) & (arc > bare_length(tree, self.manner.library, self.envelope))
        split = split_long(tree, self.spacing, bears)
        _, whole = limb_arcs(split.tree)
        self.spacing = self.manner.drawn_spacing(split.tree.order, whole)
        return split

    def _lead(self):
        """The limbs that go on into a crown which the drawing left empty: the first generation, if there are any."""
        if self.wanted.only is not None:
            return None
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
        tips = tips.select(~np.isin(tips.limb, list(led)) & (self.manner.thorough < 0.5))
        self.drawn_nodes = drawn_nodes(self.drawn, tips, self.manner.library, self.habit, self.envelope, led)
        if self.wanted.only is not None:
            mine = np.array(sorted(self.wanted.only), np.int64)
            tips = tips.select(np.isin(tips.limb, mine))
            self.drawn_nodes = self.drawn_nodes.select(np.isin(self.drawn_nodes.limb, mine))
        new = self._laterals(self.drawn_nodes)
        drawn = DrawnLaterals.of(tree)
        new = drawn.fitted(new, self.key).select(~drawn.beside(new, self.spacing))
        if self.habit.max_order > 0 and self.manner.thorough < 0.5 and self.wanted.only is None:
            new = new.join(self._free(into_gaps(tree, frames(tree), drawn, new, self.key)))
        if self.leaders:
            beside = self._laterals(self.leaders.nodes)
            led = np.r_[np.isin(tree.limb[new.row], list(led)), np.ones(len(beside), bool)]
            new = to_surface(new.join(beside), led, self.envelope, self.space, self.key)
        return tips.join(new)

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
        empty = empty_points(self.envelope, nodes.tip, gap * self.manner.apart)
        outside = ~self.envelope.inside(nodes.tip)
        if not self.envelope.binding:
            drawn = nodes.select(outside & (nodes.order > 0) & (nodes.row < len(self.drawn.tree)))
            reach = np.minimum(HALO[0] * drawn.whole, HALO[1] * self.manner.apart)
            empty = np.concatenate([empty, empty_around(drawn, reach, nodes.tip, gap * self.manner.apart)])
        empty = empty[self.space.inside(empty)]
        bears = (nodes.order < self.habit.max_order) & ~(outside & self.envelope.binding)
        new = towards(empty, nodes.select(bears), self.habit, self.manner.theta, round_, self.key)
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
        return emptiness(self.envelope, wood, HOLLOW_GAP * self.manner.apart, self.space) > HOLLOW + (1.0 - HOLLOW) * min(2.0 * self.manner.thorough, 1.0)

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
        spacing = self.manner.spacing(self.open.order, whole)
        spacing = np.where(self.manner.bears(self.open.order, whole), spacing, np.maximum(spacing, whole / _BARE_NODES))
        nodes = plan(self.open, self.manner.library, spacing, self.key)
        keep = self._within_limit(nodes.count)
        if not keep.all():
            self.open = self.open.select(keep)
            nodes = plan(self.open, self.manner.library, spacing[keep], self.key)
            self.stopped_by = "max_segments"
        uneven = _GROUND[0] + _GROUND[1] * keys.uniform(self.key, self.open.limb, 11) ** 2
        ground = self.ground + uneven * self.scale
        grown, parent = grow(
            self.open, nodes, self.manner.library, self.habit, self.manner.theta, self.space, ground, self.key,
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
        """The branches that the blocks on these nodes open, as long as there is room."""
        return self._free(self.manner.laterals(nodes, nodes.row < len(self.drawn.tree), self.key))

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


def _crown(tree: TreeSkeleton, wanted: Wanted, habit: Habit) -> Envelope | None:
    """The drawn crown, or the one that the drawing implies."""
    return Envelope.from_outlines(wanted.crown) if len(wanted.crown) else implied_crown(tree, habit, wanted.exemplar)
