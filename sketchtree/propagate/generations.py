"""How does the tree fill in what the sketch left out?

Chen et al. 2008, §6. Generation 0 is the drawing. In every further one all open branches grow to their
length at once, node by node along replication blocks; the laterals of those blocks are the open branches of the
next. Each generation is one set of array operations, linear in the segments it makes.

A crown that is still hollow then is filled by a few rounds more (`fill`). Growth ends with the generations asked for, at the habit's deepest order, at branches as short as its twigs,
at the crown's surface, or at `max_segments`.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Int, Key

from sketchtree.errors import OptionError
from sketchtree.parameters import Habit, TreeParameters
from sketchtree.propagate.fill import COARSE_GAP, GAP, HOLLOW_ROUNDS, LED_GAP, ROUNDS
from sketchtree.propagate.growing import Growing, to_scale
from sketchtree.roots import is_root, with_roots, without_roots
from sketchtree.skeleton import TreeSkeleton

GENERATIONS = 5  # without a crown (Chen §6)
CROWN_GENERATIONS = 12  # with one, or where a hollow one is filled, at most


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
    whole = tree
    tree, above = without_roots(whole)
    if len(tree) == 0 or limit == 0:
        return Propagation(whole, np.zeros(len(whole), int), np.arange(len(whole)), 0, "generations", ())
    growing = Growing(tree, to_scale(habit, tree, crown), theta, exemplar, crown, max_segments, key)
    growing.run(limit)
    limit = CROWN_GENERATIONS if generations is None else limit
    gaps = HOLLOW_ROUNDS * [LED_GAP if growing.leaders else COARSE_GAP] if growing.is_hollow() else []
    gaps = gaps[: 1 if fill else None] + (ROUNDS * [GAP] if fill else [])
    for round_, gap in enumerate(gaps):
        growing.fill(round_, limit, gap)
    if gaps:
        growing.run(limit)
    ended = "habit" if growing.stopped_by == "generations" and len(growing.open) == 0 else growing.stopped_by
    grown, row = growing.skeleton(), np.zeros(len(whole), np.int64)
    row[above] = growing.drawn.row
    row[is_root(whole)] = len(grown) + np.arange(len(whole) - len(above))
    return Propagation(
        skeleton=with_roots(grown, whole, row),
        generation=np.r_[growing.generation_of_rows(), np.zeros(len(whole) - len(above), int)],
        drawn_row=row,
        generations_done=growing.done,
        stopped_by=ended,
        warnings=_warnings(growing),
    )


def _warnings(growing: Growing) -> tuple[str, ...]:
    """What the user should know."""
    found = []
    if growing.outside:
        found.append(
            "All drawn branches lie outside the crown, so nothing grew. "
            "Draw the crown around the tips, or use --crown off."
        )
    if growing.stopped_by == "max_segments":
        found.append(
            f"Growth stopped at max_segments = {growing.max_segments} in generation {growing.done}: "
            "its branches were thinned evenly. Raise --max-segments, or ask for fewer generations."
        )
    return tuple(found)


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
