"""How does the tree fill in what the sketch left out?

Chen et al. 2008, §6. Generation 0 is the drawing. In every further one all open branches grow to their
length at once, node by node along replication blocks; the laterals of those blocks are the open branches of the
next. Each generation is one set of array operations, linear in the segments it makes.

A crown that is still hollow then is filled by a few rounds more (`fill`). Growth ends with the generations asked for, at the habit's deepest order, at branches as short as its twigs,
at the crown's surface, at what a neighbour holds, or at `max_segments`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.after.level import cut_back
from sketchtree.propagate.assembled import assembled
from sketchtree.propagate.drawn.whose_crown import outlines_of_trees
from sketchtree.propagate.growing import Growing
from sketchtree.propagate.space.obstacles import Obstacles
from sketchtree.propagate.space.space import Space
from sketchtree.propagate.together import Member, Together
from sketchtree.propagate.wanted import Wanted
from sketchtree.roots import is_root, with_roots, without_roots
from sketchtree.skeleton import TreeSkeleton

_ENDS = ("max_segments", "generations", "habit")


@dataclass(frozen=True, eq=False)
class Propagation:
    """A tree and how it came about."""

    skeleton: TreeSkeleton
    generation: Int[np.ndarray, " segment"]  # of every row; 0 for what was drawn
    drawn_row: Int[np.ndarray, " segment"]  # row of the result, for every row of the tree that was given
    generations_done: int
    stopped_by: str  # generations | habit | max_segments
    warnings: tuple[str, ...]
    tip_weight: Float[np.ndarray, " segment"] | None = None  # pipes that start in each row; None: one in every tip
    space: Space = Space()  # where it grew; of several trees, the first
    spaces: dict[int, Space] = field(default_factory=dict)  # the same of every tree, by its number in the column `tree`


@dataclass(frozen=True)
class Propagate(Wanted):
    """The stage: a drawn skeleton in, a complete one out (Chen §6)."""

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""]) -> TreeSkeleton:
        return self.run(tree, key=key).skeleton

    def run(self, tree: TreeSkeleton, *, key: Key[Array, ""], pulse: Callable[[], None] = lambda: None) -> Propagation:
        """As the call, with the generations, warnings and what ended the growth. `pulse` is called before every generation; what it raises ends the growth."""
        return propagate_together([Planted(tree, self, key)], pulse)[0]


def propagate(tree: TreeSkeleton, habit: Habit, theta: TreeParameters, *, key: Key[Array, ""], **wanted) -> Propagation:
    """Grow what the sketch left out. Options as in `Wanted`; the given rows are kept as they are, long ones split."""
    return Propagate(habit, theta, **wanted).run(tree, key=key)


@dataclass(frozen=True, eq=False)
class Planted:
    """A drawing and where it stands among others."""

    tree: TreeSkeleton  # in the drawing's own frame, metres; roots and several trees allowed
    wanted: Wanted
    key: Key[Array, ""]
    place: Float[np.ndarray, " 3"] = field(default_factory=lambda: np.zeros(3))  # of its frame in the world, metres


def propagate_together(planted: Sequence[Planted], pulse: Callable[[], None] = lambda: None) -> list[Propagation]:
    """Grow what several drawings left out, in lockstep, competing for space and light (`together`); each in its own frame.

    The trees of one drawing compete likewise. The order of the drawings changes nothing."""
    trees = [_trees(one) for one in planted]
    growing = iter(Together([member for members, _ in trees for member in members], pulse).complete())
    return [_found(one, [next(growing) for _ in members], rows) for one, (members, rows) in zip(planted, trees, strict=True)]


def _trees(planted: Planted) -> tuple[list[Member], list]:
    """(the trees of a drawing, the rows above the ground that each is made of); none where nothing is to grow."""
    tree, _ = without_roots(planted.tree)
    if len(tree) == 0 or planted.wanted.limit == 0:
        return [], []
    names = np.unique(tree.tree)
    rows = [np.flatnonzero(tree.tree == name) for name in names]
    parts = [tree] if len(names) == 1 else [tree.select(tree.tree == name) for name in names]
    crowns = outlines_of_trees(parts, planted.wanted.crown)
    most = max(planted.wanted.max_segments // len(parts), 1)
    like = planted.wanted.like if len(parts) == 1 else None
    wanted = [replace(planted.wanted, crown=crown, max_segments=most, like=like) for crown in crowns]
    return [Member(part, its, planted.key, planted.place) for part, its in zip(parts, wanted, strict=True)], rows


def _found(planted: Planted, growing: list[Growing], rows: list) -> Propagation:
    """What became of one drawing."""
    whole, wanted = planted.tree, planted.wanted
    if not growing:
        return Propagation(whole, np.zeros(len(whole), int), np.arange(len(whole)), 0, "generations", ())
    _, above = without_roots(whole)
    grown, generation, drawn = assembled(growing, rows)
    row = np.zeros(len(whole), np.int64)
    row[above] = drawn
    row[is_root(whole)] = len(grown) + np.arange(len(whole) - len(above))
    found = Propagation(
        skeleton=with_roots(grown, whole, row),
        generation=np.r_[generation, np.zeros(len(whole) - len(above), int)],
        drawn_row=row,
        generations_done=max(one.done for one in growing),
        stopped_by=min(map(_ended, growing), key=_ENDS.index),
        warnings=tuple(dict.fromkeys(warning for one in growing for warning in _warnings(one))),
        space=growing[0].space,
        spaces={int(one.drawn.tree.tree[0]): one.space for one in growing},
    )
    return found if wanted.generations in (None, wanted.limit) else _at_level(found, wanted.generations)


def _ended(growing: Growing) -> str:
    """What ended the growth of one tree."""
    return "habit" if growing.stopped_by == "generations" and len(growing.open) == 0 else growing.stopped_by


def _at_level(found: Propagation, level: float) -> Propagation:
    """The same with its last generation cut back to a level between two generations."""
    whole = int(level)
    cut = cut_back(found.skeleton, found.generation, whole + 1, level - whole)
    place = np.zeros(len(found.skeleton), np.int64)
    place[cut.rows] = np.arange(len(cut.rows))
    return replace(
        found,
        skeleton=cut.skeleton,
        generation=found.generation[cut.rows],
        drawn_row=place[found.drawn_row],
        tip_weight=cut.tip_weight,
    )


def _warnings(growing: Growing) -> tuple[str, ...]:
    """What the user should know."""
    found = []
    if growing.outside:
        found.append(
            "All drawn branches lie outside the crown, so nothing grew. "
            "Draw the crown around the tips, or use --crown off."
        )
    else:
        found += _aside(*growing.limbs_aside())
    if growing.obstacles is not None:
        found += _warnings_of(growing.obstacles, growing.drawn.tree)
    if growing.stopped_by == "max_segments":
        found.append(
            f"Growth stopped at max_segments = {growing.wanted.max_segments} in generation {growing.done}: "
            "its branches were thinned evenly. Raise --max-segments, or ask for fewer generations."
        )
    return tuple(found)


def _aside(limbs: int, shown: bool) -> list[str]:
    """What is said of a crown that holds the tips of none of so many drawn limbs, though the page may show them in it."""
    if limbs == 0:
        return []
    if shown:
        return [
            f"None of the {limbs} drawn limbs ends inside the crown: their tips lie nearer or farther than it is deep there, so they bear little. "
            "Draw the crown wider around them, or use --crown off."
        ]
    return [
        f"None of the {limbs} drawn limbs ends inside the crown, so none of them bears anything new. "
        "Draw the crown around their tips, or use --crown off."
    ]


def _warnings_of(obstacles: Obstacles, drawn: TreeSkeleton) -> list[str]:
    """The same of obstacles."""
    found = [
        f"{name} is out of the tree's reach and changes nothing. If it should stand by the tree: its file "
        "counts in metres, y up, and the root is its origin."
        for name in obstacles.out_of_reach
    ]
    touched = obstacles.touched(drawn)
    if touched:
        some = "1 drawn branch comes" if touched == 1 else f"{touched} drawn branches come"
        found.append(
            f"{some} nearer than {obstacles.clearance:.2f} m to an obstacle, or into it. "
            "What was drawn stays as it is; nothing grows on from where it is so near."
        )
    return found
