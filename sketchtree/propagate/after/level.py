"""How does a tree look between two generations? The level of growth, a real number, for a slider that runs smoothly.

At level g = k + f, 0 < f < 1, generations 1 … k are whole and generation k + 1 has come the fraction f of its way. Every
branch system of that generation (a limb; a leader with its forks) is cut along its own path:

    s ≤ f S        s  metres along the path from where the generation begins,  S  the longest such path of the system

so tips move with f and nothing else does; what is there at g is there, with the same limb ids, at every g + δ.

Wood thickens as smoothly (`PipeRadii`): a growing tip has f of a pipe, and what was a tip before it bore one keeps
1 − f of its own:

    w = f        tips of generation k + 1
    w = 1 − f    wood of generations ≤ k that would be a tip without generation k + 1
    w = 1        all other tips
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.propagate.after.cutting import Cut
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import generations, is_tip, sum_from_root

_SHORTEST = 1e-4  # metres: a shorter piece is left out


@dataclass(frozen=True, eq=False)
class Level:
    """A tree whose last generation is cut back."""

    skeleton: TreeSkeleton
    rows: Int[np.ndarray, " kept"]  # of the tree that was given, in order
    tip_weight: Float[np.ndarray, " kept"]  # pipes that start in each row, 0-1


def cut_back(
    tree: TreeSkeleton, generation: Int[np.ndarray, " segment"], last: int, fraction: float
) -> Level:
    """The tree with what grew in generation `last` cut to `fraction` (0 < f < 1) of its way. Nothing may grow from that
    generation, and its rows have no curve points."""
    new = np.flatnonzero(generation == last)
    parent = _renumbered(tree.parent, new)
    run = sum_from_root(parent, tree.length[new])
    end = fraction * _longest(parent, run)
    start = run - tree.length[new]
    keep = np.ones(len(tree), bool)
    keep[new] = start < end - _SHORTEST
    tip = np.array(tree.tip)
    part = np.minimum((end - start) / np.maximum(tree.length[new], 1e-300), 1.0)[:, None]
    tip[new] = np.where(part < 1.0, tree.start[new] + part * tree.vector[new], tip[new])
    rows = np.flatnonzero(keep)
    cut = tree.replace(tip=tip).select(keep)
    return Level(cut, rows, _tip_weight(cut, generation[rows] == last, fraction))


def kept_weight(before: TreeSkeleton, cut: Cut, tip_weight: Float[np.ndarray, " segment"]) -> Float[np.ndarray, " kept"]:
    """The weights once a part of the tree is cut off: what thereby became a tip has a whole pipe."""
    was = is_tip(before.parent)[cut.rows]
    return np.where(is_tip(cut.skeleton.parent) & ~was, 1.0, tip_weight[cut.rows])


def _tip_weight(tree: TreeSkeleton, grows, fraction: float):
    """Pipes that start in each row, those of rows that still grow by `fraction`."""
    before = is_tip(np.where(grows, NULL, tree.parent))
    weight = np.where(before & ~grows, 1.0 - fraction, 0.0)
    return np.where(is_tip(tree.parent), np.where(grows, fraction, 1.0), weight)


def _renumbered(parent, rows):
    """The parents of some rows, as places among these; NULL where the parent is another."""
    place = np.full(len(parent) + 1, NULL)
    place[rows] = np.arange(len(rows))
    return place[parent[rows]]


def _longest(parent, run):
    """For every row the longest run of the system it belongs to."""
    system = np.arange(len(parent))
    for rows in generations(parent)[1:]:
        system[rows] = system[parent[rows]]
    longest = np.zeros(len(parent))
    np.maximum.at(longest, system, run)
    return longest[system]
