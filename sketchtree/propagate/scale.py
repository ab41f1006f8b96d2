"""How large is the tree, and how large are its twigs then?"""

import dataclasses

import numpy as np

from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton

_LARGEST_SCALE = 1.25  # of a habit's lengths: a larger tree has more twigs, not larger ones


def height(tree: TreeSkeleton, crown: tuple) -> float:
    """Metres from the ground to the top of the drawing, its crown included."""
    top = max((float(np.max(np.asarray(outline)[:, 1])) for outline in crown), default=-np.inf)
    return max(tree.height, top - float(tree.tip[tree.is_base, 1].min()))


def to_scale(habit: Habit, tree: TreeSkeleton, crown: tuple = ()) -> Habit:
    """The habit's lengths for a tree of another height (its crown's, if that is higher): a small tree has smaller
    twigs, a large one more of them."""
    scale = float(np.clip(height(tree, crown) / habit.height, 0.01, _LARGEST_SCALE))
    return dataclasses.replace(
        habit,
        lateral_spacing=habit.lateral_spacing * scale,
        twig_length=habit.twig_length * scale,
        gravitropism=habit.gravitropism / scale,
    )
