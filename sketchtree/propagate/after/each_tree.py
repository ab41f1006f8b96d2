"""How do trees of one skeleton sag each in a space of its own?"""

import numpy as np

from sketchtree.parameters import Habit
from sketchtree.propagate.after.cutting import Cut
from sketchtree.propagate.after.sag import Sag
from sketchtree.propagate.space.space import Space
from sketchtree.skeleton import TreeSkeleton
from sketchtree.skeleton_joined import joined, reordered


def sagged(tree: TreeSkeleton, strength: float, habit: Habit, spaces: dict[int, Space]) -> Cut:
    """The trees as they hang (`sag`), each cut at the barriers of its space; `spaces` by the column `tree`."""
    names = np.unique(tree.tree)
    if strength == 0 or len(names) < 2:
        return Sag(strength, habit, spaces.get(int(names[0]), Space()) if len(names) else Space()).run(tree)
    rows, hung = [], []
    for name in names:
        cut = Sag(strength, habit, spaces.get(int(name), Space())).run(tree.select(tree.tree == name))
        rows.append(np.flatnonzero(tree.tree == name)[cut.rows])
        hung.append(cut.skeleton)
    kept = np.concatenate(rows)
    order = np.argsort(kept, kind="stable")
    return Cut(reordered(joined(hung), order), kept[order])
