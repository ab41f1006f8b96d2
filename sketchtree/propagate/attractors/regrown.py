"""What if boughs that grew run through one another? While they grow they are thin; all that they come to bear makes them thick, and those that then touch must part (`after.untangle`).

What is cut off left foliage without wood. So the tree is freed here, and grows once more to where it has none, round limbs that are as thick as they will be: shorter, and with predefined
subtrees alone. Where foliage still has wood near by the tree stays as it grew. (Ours.)
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.geometry.radii import PipeRadii
from sketchtree.parameters import Habit
from sketchtree.propagate.after.untangle import Untangle
from sketchtree.propagate.attractors.attractors import Attractors
from sketchtree.propagate.attractors.stage import Attract, Attraction, Grown
from sketchtree.propagate.attractors.state import Course
from sketchtree.propagate.attractors.wood import Wood
from sketchtree.roots import without_roots
from sketchtree.skeleton import TreeSkeleton

LITTLE = 0.04  # of the attractors on the page: so many may be farther than a leaf is long from what is left
_SHARE = 0.3  # of the rounds, the second growth has at most
_RANKS = 1 << 21  # ranks of limbs that grow then


def grown_free(
    stage: Attract, tree: TreeSkeleton, radius: Float[np.ndarray, " segment"], habit: Habit, scaled: Habit, *, key: Key[Array, ""], pulse: Callable[[], None] = lambda: None
) -> Attraction:
    """As `stage.run`, with what crossings cost grown again. `radius`: of every given row, metres (NaN unknown); `habit`: the species', `scaled` to the tree (`scale.to_scale`)."""
    first = stage.run(tree, key=key, pulse=pulse)
    known = np.full(len(first.skeleton), np.nan)
    known[first.drawn_row] = radius
    thick = PipeRadii(habit, known, first.tip_weight)(first.skeleton)
    freed = Untangle(scaled, first.spaces).run(thick, pulse)
    left = freed.skeleton
    if not stage.twigs or all(_bare(one, left.select(left.tree == name)) <= LITTLE for name, one in first.grown.items()):
        return first
    library = tuple(name for name in stage.library if name != "visible") or stage.library
    again = replace(stage, library=library, iterations=int(_SHARE * stage.iterations), along=False, first_rank=_RANKS)
    second = again.run(left, key=key, pulse=pulse)
    place = np.full(len(thick), -1)
    place[freed.rows] = second.drawn_row
    generation = second.generation + int(first.generation.max(initial=0)) * (second.generation > 0)
    generation[second.drawn_row] = first.generation[freed.rows]
    return replace(
        second, generation=generation, drawn_row=place[first.drawn_row], generations_done=int(generation.max(initial=0)),
        warnings=tuple(dict.fromkeys((*first.warnings, *second.warnings))), grown={name: _together(first.grown[name], one) for name, one in second.grown.items()},
    )  # fmt: skip


def _bare(grown: Grown, tree: TreeSkeleton) -> float:
    """The share of a tree's attractors on the page that are farther than a leaf is long from its wood."""
    image = Attractors.at(grown.image.place)
    image.approach(*Wood.of(without_roots(tree)[0]).pieces())
    return float(np.mean(image.distance > grown.leaf_length))


def _together(first: Grown, second: Grown) -> Grown:
    """Both growths as one course."""
    course = Course(*(getattr(first.course, name) + getattr(second.course, name) for name in ("driver", "image", "space", "in_space")))
    before = first.course.segments[-1] if first.course.segments else 0
    course.segments = first.course.segments + [before + count for count in second.course.segments]
    return replace(second, course=course, library=tuple(dict.fromkeys((*first.library, *second.library))))
