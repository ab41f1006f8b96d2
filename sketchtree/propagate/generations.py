"""How does the tree fill in what the sketch left out?

Chen et al. 2008, §6. Generation 0 is the drawing. In every further one all open branches grow to their
length at once, node by node along replication blocks; the laterals of those blocks are the open branches of the
next. Each generation is one set of array operations, linear in the segments it makes.

Growth ends with the generations asked for, at the habit's deepest order, at branches as short as its twigs,
at the crown's surface, or at `max_segments`.
"""

import dataclasses
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree import keys
from sketchtree.errors import OptionError
from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.attach_block import MINIMUM_LENGTH, Nodes, attach
from sketchtree.propagate.block import blocks_of, blocks_of_parameters
from sketchtree.propagate.drawn import DrawnLaterals, bare_length, drawn_nodes, implied_crown, open_tips
from sketchtree.propagate.envelope import Envelope
from sketchtree.propagate.fill import GAP, ROUNDS, empty_points, towards
from sketchtree.propagate.gaps import into_gaps
from sketchtree.propagate.laterals import split_long
from sketchtree.propagate.library import library
from sketchtree.propagate.limb_growth import NODES, grow, plan
from sketchtree.propagate.open_branch import OpenBranches, frames, limb_arcs
from sketchtree.skeleton import Kind, TreeSkeleton

GENERATIONS = 5  # without a crown (Chen §6)
CROWN_GENERATIONS = 12  # with one, at most
_BEARING = 1.8  # twig lengths: a shorter limb bears no laterals
_TRUNK_SPACING = 1.6  # of the habit's spacing of laterals
_CLOSER = 0.65  # times the habit's spacing, nodes lie closer than on the exemplar, which is a skeleton without its twigs
_SPARSEST = 4.0  # times the habit's spacing, at most
_LARGEST_SCALE = 1.25
_LIKE_BLOCK = 1.5  # times the length its block says, a new limb on the trunk is no longer than that
_PRESSES = 1.08  # times its straight way to the crown: a branch that bends still meets the surface
_GROUND = (0.015, 0.1)  # of the tree's height: undrawn limbs stay this far above the ground, and up to that much more
_LIKE_DRAWN = 1.1  # times the drawn laterals around it, a new one on a drawn limb is no longer


@dataclass(frozen=True, eq=False)
class Propagation:
    """A tree and how it came about."""

    skeleton: TreeSkeleton
    generation: Int[np.ndarray, " segment"]  # of every row; 0 for what was drawn
    drawn_row: Int[np.ndarray, " segment"]  # row of the result, for every row of the tree that was given
    generations_done: int
    stopped_by: str  # generations | habit | max_segments
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class Propagate:
    """The stage: a drawn skeleton in, a complete one out (Chen §6)."""

    habit: Habit
    theta: TreeParameters
    crown: tuple = ()  # closed outlines, each (point 2), world metres
    generations: int | None = None  # 0-50; None: 5 without a crown, at most 12 with one
    fill: bool = False  # keep on until the crown is evenly filled
    max_segments: int = 200_000  # of the result, drawn ones included; ≥ 1
    exemplar: TreeSkeleton | None = None  # lends its blocks where the drawing has too few

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""]) -> TreeSkeleton:
        return self.run(tree, key=key).skeleton

    def run(self, tree: TreeSkeleton, *, key: Key[Array, ""]) -> Propagation:
        """As the call, with the generations, warnings and what ended the growth."""
        return propagate(
            tree,
            self.habit,
            self.theta,
            crown=self.crown,
            generations=self.generations,
            fill=self.fill,
            max_segments=self.max_segments,
            exemplar=self.exemplar,
            key=key,
        )


def propagate(
    tree: TreeSkeleton,
    habit: Habit,
    theta: TreeParameters,
    *,
    crown: tuple = (),
    generations: int | None = None,
    fill: bool = False,
    max_segments: int = 200_000,
    exemplar: TreeSkeleton | None = None,
    key: Key[Array, ""],
) -> Propagation:
    """Grow what the sketch left out. Options as in `Propagate`; the given rows are kept as they are, long ones split."""
    limit = _limits(generations, max_segments, bool(crown))
    if len(tree) == 0 or limit == 0:
        return Propagation(tree, np.zeros(len(tree), int), np.arange(len(tree)), 0, "generations", ())
    growth = _Growth(tree, _to_scale(habit, tree), theta, exemplar, crown, max_segments, key)
    growth.run(limit)
    for round_ in range(ROUNDS if fill else 0):
        if not growth.fill(round_, limit):
            break
    return growth.result()


class _Growth:
    """The tree while it grows: the rows made so far and the branches still open."""

    def __init__(self, tree, habit, theta, exemplar, crown, max_segments, key):
        self.habit, self.theta, self.max_segments = habit, theta, max_segments
        self.key = keys.draw_key(key)
        self.warnings = []
        self.envelope = Envelope.from_outlines(crown) if len(crown) else implied_crown(tree, habit)
        self.library = _library(tree, habit, theta, exemplar)
        self.scale = tree.height
        self.ground = float(tree.tip[tree.is_base, 1].min())
        self.drawn = self._split(tree)
        self.parts, self.rows, self.done, self.stopped_by = [], len(self.drawn.tree), 0, "generations"
        self.segments = self.drawn.tree.segment_count
        self.open = self._first_generation()
        if len(self.open) == 0 and len(crown) and not self.envelope.inside(tree.tip).any():
            self.warnings.append(
                "All drawn branches lie outside the crown, so nothing grew. "
                "Draw the crown around the tips, or use --crown off."
            )

    def _split(self, tree):
        _, whole = limb_arcs(tree)
        self.spacing = self._spacing(tree.order, whole)
        arc, _ = limb_arcs(tree)
        bears = (tree.order < self.habit.max_order) & (arc > bare_length(tree, self.library))
        split = split_long(tree, self.spacing, bears)
        _, whole = limb_arcs(split.tree)
        self.spacing = self._spacing(split.tree.order, whole)
        return split

    def _first_generation(self) -> OpenBranches:
        tree = self.drawn.tree
        tips = open_tips(tree, self.spacing, self.habit, self.envelope, self.key)
        self.drawn_nodes = drawn_nodes(self.drawn, tips, self.library, self.habit, self.envelope)
        new = self._laterals(self.drawn_nodes)
        drawn = DrawnLaterals.of(tree)
        usual = drawn.usual_length(new)
        at_most = np.minimum(new.length, _LIKE_DRAWN * usual)
        like = usual * (0.8 + 0.25 * keys.uniform(self.key, new.limb, 12))
        length = np.where(np.isnan(usual), new.length, np.where(new.order == 1, np.minimum(like, _LIKE_BLOCK * new.length), at_most))
        new = replace(new, length=length).select(~drawn.beside(new, self.spacing))
        if self.habit.max_order > 0:
            new = new.join(self._free(into_gaps(tree, frames(tree), drawn, new, self.key)))
        return tips.join(new)

    def _spacing(self, order, whole):
        """Metres between the nodes of limbs of these orders and whole lengths: the habit's, or wider where the exemplar
        has few laterals; never more than a hundred or so nodes a limb."""
        habit = self.habit.lateral_spacing
        wide = np.where((order == 0) & (self.habit.arrangement != "whorled"), _TRUNK_SPACING, 1.0) * habit
        lent = self.library.spacing[np.minimum(order, self.habit.max_order)] * self.scale
        lent = np.clip(lent - _CLOSER * habit, habit, _SPARSEST * habit)
        return np.maximum(np.where(np.isnan(lent), wide, lent), whole / (4 * NODES))

    def run(self, limit: int) -> None:
        """Generation after generation, until `limit` of them are done or nothing is open."""
        while self.done < limit and self.generation():
            pass

    def fill(self, round_: int, limit: int) -> bool:
        """One round of growth into what is still empty; False where nothing is, or no more may be grown."""
        if self.envelope is None or self.done >= limit or self.stopped_by == "max_segments":
            return False
        nodes = self.drawn_nodes
        for part, _ in self.parts:
            nodes = nodes.join(part)
        empty = empty_points(self.envelope, nodes.tip, GAP * self.habit.lateral_spacing)
        bears = (nodes.order < self.habit.max_order) & self.envelope.inside(nodes.tip)
        self.open = towards(empty, nodes.select(bears), self.habit, round_, self.key)
        before = self.rows
        self.run(limit)
        return self.rows > before

    def generation(self) -> bool:
        """Grow all open branches; False where there was nothing to grow."""
        if len(self.open) == 0:
            self.stopped_by = "habit"
            return False
        whole = self.open.length + self.open.grown
        nodes = plan(self.open, self.library, self._spacing(self.open.order, whole), self.key)
        keep = self._within_limit(nodes.count)
        if not keep.all():
            self.open = self.open.select(keep)
            nodes = plan(self.open, self.library, self._spacing(self.open.order, whole[keep]), self.key)
            self.stopped_by = "max_segments"
        uneven = _GROUND[0] + _GROUND[1] * keys.uniform(self.key, self.open.limb, 11) ** 2
        ground = self.ground + uneven * self.scale
        grown, parent = grow(
            self.open, nodes, self.library, self.habit, self.theta, self.envelope, ground, self.key,
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
        bears = (nodes.order < self.habit.max_order) & (nodes.whole >= _BEARING * self.habit.twig_length)
        nodes = nodes.select(bears & (nodes.zone >= 0))
        block = lib.choose(lib.lateral, nodes.order, nodes.zone, keys.uniform(self.key, nodes.id, 10))
        opened = attach(nodes, block, lib.blocks, self.habit, self.theta, self.key)
        longest = lib.longest[np.minimum(opened.order, len(lib.longest) - 1)] * self.scale
        return self._free(replace(opened, length=np.minimum(opened.length, longest)))

    def _free(self, opened: OpenBranches) -> OpenBranches:
        """The same, each no longer than its way to the crown; those left too short are not opened."""
        if self.envelope is None:
            return opened
        end = opened.origin + opened.length[:, None] * opened.frame[:, :, 1]
        reach = _PRESSES * self.envelope.exit_fraction(opened.origin, end, bisections=7)
        length = opened.length * np.minimum(reach, 1.0)
        opened = replace(opened, length=length)
        return opened.select(length >= MINIMUM_LENGTH * self.habit.twig_length)

    def _within_limit(self, count):
        """Which open branches are grown so that the whole keeps to `max_segments`: thinned evenly, by limb id."""
        left = self.max_segments - self.segments
        if count.sum() <= left:
            return np.ones(len(count), bool)
        lot = np.argsort(keys.uniform(self.key, self.open.limb, 9), kind="stable")
        keep = np.zeros(len(count), bool)
        keep[lot] = np.cumsum(count[lot]) <= left
        return keep

    def result(self) -> Propagation:
        """The whole skeleton."""
        tree = self.drawn.tree
        drawn_count = len(tree)
        if self.parts:
            tree = tree.append(_columns(self.parts, self.tree_of_rows()))
        generation = np.repeat(np.arange(len(self.parts) + 1), [drawn_count] + [len(part) for part, _ in self.parts])
        if self.stopped_by == "generations" and len(self.open) == 0:
            self.stopped_by = "habit"
        if self.stopped_by == "max_segments":
            self.warnings.append(
                f"Growth stopped at max_segments = {self.max_segments} in generation {self.done}: "
                "its branches were thinned evenly. Raise --max-segments, or ask for fewer generations."
            )
        return Propagation(
            tree, generation, self.drawn.row, self.done, self.stopped_by, tuple(self.warnings)
        )

    def tree_of_rows(self):
        return np.concatenate([part.tree for part, _ in self.parts])


_lent_blocks = lru_cache(maxsize=32)(blocks_of)  # an exemplar is one frozen object for all the trees it lends to


def _library(tree, habit, theta, exemplar):
    """The tree's own blocks and those of the exemplar; the habit's where there is none to lend."""
    supplement = None if exemplar is None else _lent_blocks(exemplar)
    if supplement is None or not (supplement.lateral_count.any() and supplement.has_apical.any()):
        exemplar, supplement = None, blocks_of_parameters(theta, habit)
    return library(blocks_of(tree), supplement, theta, habit.max_order, exemplar)


def _columns(parts, tree):
    columns = {name: np.concatenate([getattr(part, name) for part, _ in parts]) for name in ("tip", "radius", "order", "limb")}
    columns["parent"] = np.concatenate([parent for _, parent in parts])
    columns["tree"] = tree
    columns["kind"] = np.full(len(tree), int(Kind.PROPAGATED))
    return columns


def _to_scale(habit: Habit, tree: TreeSkeleton) -> Habit:
    """The habit's lengths for a tree of another height: a small tree has smaller twigs, a large one
    more of them."""
    scale = float(np.clip(tree.height / habit.height, 0.01, _LARGEST_SCALE))
    return dataclasses.replace(
        habit,
        lateral_spacing=habit.lateral_spacing * scale,
        twig_length=habit.twig_length * scale,
        gravitropism=habit.gravitropism / scale,
    )


def _limits(generations: int | None, max_segments: int, crown: bool) -> int:
    if max_segments < 1:
        raise OptionError(f"max_segments is {max_segments}, but must be 1 or more.", remedy="Give a positive number.")
    if generations is None:
        return CROWN_GENERATIONS if crown else GENERATIONS
    if not 0 <= generations <= 50:
        raise OptionError(
            f"generations is {generations}, but must lie between 0 and 50.", remedy="5 to 12 make a full tree."
        )
    return generations
