"""Where do limbs leave what bears them? Near a fork photos see both as one, and the first points of a limb lie square off the bark. Farther out it runs as it grew: led back along its course (ours)."""

import numpy as np

from sketchtree.axes import NULL
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import limb_chains

BLURRED = 3.0  # pixels beyond the bark, in which a limb and what bears it are seen as one
COURSE = 10.0  # pixels from there on, that say how it runs
BACK = 12.0  # pixels beyond what is blurred, that it may be led back


def led_back(tree: TreeSkeleton, pixel: float) -> TreeSkeleton:
    """The tree whose limbs leave their bearers along their courses; rows of the blur are gone. `pixel`: of the plant, metres."""
    parent, keep = tree.parent.copy(), np.ones(len(tree), bool)
    for rows in limb_chains(tree.parent, tree.limb):
        foot = tree.parent[rows[0]]
        if foot == NULL:
            continue
        along, blurred = np.cumsum(tree.length[rows]), tree.radius[foot] + BLURRED * pixel
        first = int(np.searchsorted(along, blurred))
        last = int(np.searchsorted(along, blurred + COURSE * pixel))
        if last - first < 2 or last >= len(rows):
            continue
        course = tree.tip[rows[last]] - tree.tip[rows[first]]
        best = _straightest(tree, foot, tree.tip[rows[first]], course / max(np.linalg.norm(course), 1e-12), blurred + BACK * pixel)
        if best != foot:
            parent[rows[first]] = best
            keep[rows[:first]] = False
    gone = np.flatnonzero(~keep)
    if not len(gone):
        return tree
    held = np.arange(len(tree))
    for row in gone:  # what hung on rows that are gone hangs on what bore them
        held[row] = held[tree.parent[row]]
    child = np.flatnonzero(keep & (parent != NULL))
    parent[child] = held[parent[child]]
    return tree.replace(parent=parent).select(keep)


def _straightest(tree: TreeSkeleton, foot: int, place, course, most: float) -> int:
    """The row of the bearing limb, at most so far back from the foot, from which the way to a place bends least."""
    best, least, row, back = foot, np.inf, foot, 0.0
    while row != NULL and tree.limb[row] == tree.limb[foot] and back <= most:
        way = place - tree.tip[row]
        bend = 1.0 - way @ course / max(np.linalg.norm(way), 1e-12)
        if bend < least - 1e-4:
            best, least = row, bend
        back += tree.length[row]
        row = tree.parent[row]
    return best
