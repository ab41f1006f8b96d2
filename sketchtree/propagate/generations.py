"""How does the tree fill in what the sketch left out?

Chen et al. 2008, §6. Generation 0 is the drawing. In every further one all open branches grow to their
length at once, node by node along replication blocks; the laterals of those blocks are the open branches of the
next. Each generation is one set of array operations, linear in the segments it makes.

A crown that is still hollow then is filled by a few rounds more (`fill`). Growth ends with the generations asked for, at the habit's deepest order, at branches as short as its twigs,
at the crown's surface, or at `max_segments`.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.after.level import cut_back
from sketchtree.propagate.growing import Growing
from sketchtree.propagate.space.obstacles import Obstacles
from sketchtree.propagate.space.space import Space
from sketchtree.propagate.together import Member, Together
from sketchtree.propagate.wanted import Wanted
from sketchtree.roots import is_root, with_roots, without_roots
from sketchtree.skeleton import TreeSkeleton


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
    space: Space = Space()  # where it grew


@dataclass(frozen=True)
class Propagate(Wanted):
    """The stage: a drawn skeleton in, a complete one out (Chen §6)."""

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""]) -> TreeSkeleton:
        return self.run(tree, key=key).skeleton

    def run(self, tree: TreeSkeleton, *, key: Key[Array, ""]) -> Propagation:
        """As the call, with the generations, warnings and what ended the growth."""
        return _complete(tree, self, key)


def propagate(tree: TreeSkeleton, habit: Habit, theta: TreeParameters, *, key: Key[Array, ""], **wanted) -> Propagation:
    """Grow what the sketch left out. Options as in `Wanted`; the given rows are kept as they are, long ones split."""
    return Propagate(habit, theta, **wanted).run(tree, key=key)


def _complete(whole: TreeSkeleton, wanted: Wanted, key) -> Propagation:
    limit = wanted.limit
    tree, above = without_roots(whole)
    if len(tree) == 0 or limit == 0:
        return Propagation(whole, np.zeros(len(whole), int), np.arange(len(whole)), 0, "generations", ())
    growing = Together([Member(tree, wanted, key)]).complete()[0]
    ended = "habit" if growing.stopped_by == "generations" and len(growing.open) == 0 else growing.stopped_by
    grown, row = growing.skeleton(), np.zeros(len(whole), np.int64)
    row[above] = growing.drawn.row
    row[is_root(whole)] = len(grown) + np.arange(len(whole) - len(above))
    found = Propagation(
        skeleton=with_roots(grown, whole, row),
        generation=np.r_[growing.generation_of_rows(), np.zeros(len(whole) - len(above), int)],
        drawn_row=row,
        generations_done=growing.done,
        stopped_by=ended,
        warnings=_warnings(growing),
        space=growing.space,
    )
    return found if wanted.generations in (None, limit) else _at_level(found, wanted.generations)


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
    if growing.obstacles is not None:
        found += _warnings_of(growing.obstacles, growing.drawn.tree)
    if growing.stopped_by == "max_segments":
        found.append(
            f"Growth stopped at max_segments = {growing.wanted.max_segments} in generation {growing.done}: "
            "its branches were thinned evenly. Raise --max-segments, or ask for fewer generations."
        )
    return tuple(found)


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
