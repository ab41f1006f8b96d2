"""Which branches does a tree give up? Those in the shade of the others, and short twigs that bear nothing.

After Palubicki et al. 2009, §4.3: a branch is shed if the light it gathers falls below a share of what feeds its leaves,

    Q(branch) = Σ light · A / Σ A  <  `shade`       over all leafy wood of the branch and of what it bears

    light   0-1, by the shadow field of all leaves of the tree (`space.shadow`)
    A       leaf area of a piece of leafy wood, in proportion to its length

Light is relative to the tree. However many or few rows it has, its leaves are taken to be so many that amid a crown that is
evenly filled with them a shadow's reach R holds `LEAF_AREA` m² over every m² (its leaf area index),

    Σ A = LEAF_AREA · V / R,   V = 4/3 π 5^(3/2) σ_x σ_y σ_z,   R = `_REACH` · the least of the crown's sides

    σ   spread of the leafy wood, metres: an even ellipsoid of the same spread has the volume V

so that there s = κ · LEAF_AREA and light e^(−1.5) = 0.22, on a bush as on an oak; the outside of a crown is in full light.

A branch begins where undrawn wood leaves drawn wood or its limb leaves another; it goes with all it bears. What is drawn, and
what bears any of that, is never shed; nor are branches without leafy wood. All branches are judged at once, by the light before any fell.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Bool, Float, Key

from sketchtree.errors import OptionError
from sketchtree.parameters import Habit
from sketchtree.propagate.after.cutting import Cut, bears, cut
from sketchtree.propagate.space.shadow import ShadowField
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import generations, sum_to_root

LEAF_AREA = 3.0  # m² a m², of a tree that stands free; closed broadleaved forest has 5 (Asner et al. 2003)
MOST_TWIGS = 20.0
_LEAFY = 3.0  # twig radii: thinner wood bears leaves
_REACH = 0.1  # of the least of the crown's sides; most of a pyramid lies 2 to 4 of it below
_VOXELS = 40  # along the longest side of the crown
_GRAIN = 1e-6  # m²: leaf areas are counted in whole square millimetres, so that sums are the same in any order


@dataclass(frozen=True)
class Shed:
    """A stage that drops branches. The tree needs its radii (`PipeRadii`), which say where leaves are."""

    shade: float = 0.0  # 0-1: branches that get less than this share of the open sky's light go; 0: none
    twigs: float = 0.0  # 0-20 twig lengths: shorter branches that bear nothing go; 0: none
    habit: Habit = Habit()  # to the tree's scale (`scale.to_scale`)

    def __post_init__(self):
        if not 0 <= self.shade <= 1:
            raise OptionError(f"shade is {self.shade:g}, but must lie between 0 and 1.", remedy="0.2 to 0.5 thin the inside of a crown.")
        if not 0 <= self.twigs <= MOST_TWIGS:
            raise OptionError(f"twigs is {self.twigs:g}, but must lie between 0 and {MOST_TWIGS:g}.", remedy="1 to 2 drop the shortest twigs.")

    def __call__(self, tree: TreeSkeleton, *, key: Key[Array, ""] | None = None) -> TreeSkeleton:
        """The tree without what it gives up. `key` is part of the stage's door; nothing here is random."""
        return self.run(tree).skeleton

    def run(self, tree: TreeSkeleton) -> Cut:
        """As the call, with the rows that are left."""
        falls = np.zeros(len(tree), bool)
        if (self.shade == 0 and self.twigs == 0) or len(tree) == 0:
            return Cut(tree, np.arange(len(tree)))
        if self.shade > 0:
            falls |= light_of_branches(tree, self.habit) < self.shade
        if self.twigs > 0:
            falls |= self._tiny(tree)
        return cut(tree, np.where(falls & branch_starts(tree), 0.0, 1.0))

    def _tiny(self, tree: TreeSkeleton) -> Bool[np.ndarray, " segment"]:
        """Rows from which a branch that is short, and bears no other, would start."""
        length = sum_to_root(tree.parent, tree.length)
        forks = np.zeros(len(tree), bool)
        forks[tree.parent[_leaves_limb(tree)]] = True
        return (length < self.twigs * self.habit.twig_length) & ~bears(tree.parent, forks)


def branch_starts(tree: TreeSkeleton) -> Bool[np.ndarray, " segment"]:
    """The first rows of all branches that may be shed."""
    fixed = bears(tree.parent, ~np.isin(tree.kind, (int(Kind.PROPAGATED), int(Kind.GROWN)))) | tree.is_base
    return ~fixed & (_leaves_limb(tree) | fixed[tree.parent])


def light_of_branches(tree: TreeSkeleton, habit: Habit) -> Float[np.ndarray, " segment"]:
    """Q of what starts with each row, 0-1; NaN where that has no leafy wood."""
    leafy = (tree.radius <= _LEAFY * habit.twig_radius) & ~tree.is_base & (tree.length > 0)
    if not leafy.any():
        return np.full(len(tree), np.nan)
    middle = tree.start[leafy] + 0.5 * tree.vector[leafy]
    low, high, reach = _box(tree, leafy)
    area = leaf_area(tree, leafy, reach)
    empty = ShadowField.empty(low, high, pitch=min(reach / 2, float((high - low).max()) / _VOXELS), reach=reach)
    light = empty.with_leaves(middle, area).light_at(middle)
    gathered, had = np.zeros((2, len(tree)))
    gathered[leafy], had[leafy] = np.rint(area / _GRAIN * light), np.rint(area / _GRAIN)
    for rows in reversed(generations(tree.parent)[1:]):
        np.add.at(gathered, tree.parent[rows], gathered[rows])
        np.add.at(had, tree.parent[rows], had[rows])
    return np.where(had > 0, gathered / np.maximum(had, 1.0), np.nan)


def leaf_area(tree: TreeSkeleton, leafy: Bool[np.ndarray, " segment"], reach: float) -> Float[np.ndarray, " leafy"]:
    """Leaf area of every leafy row, m²: Σ A of each tree, shared out by length."""
    middle, length, name = tree.start[leafy] + 0.5 * tree.vector[leafy], tree.length[leafy], tree.tree[leafy]
    area = np.zeros(len(length))
    for one in np.unique(name):
        rows = name == one
        spread = np.maximum(np.std(middle[rows], axis=0), length[rows].mean())
        area[rows] = LEAF_AREA / reach * 4 / 3 * np.pi * 5**1.5 * np.prod(spread) * length[rows] / length[rows].sum()
    return area


def _box(tree: TreeSkeleton, leafy):
    """(two corners of a box about the leafy wood, reach of a shadow in it), metres."""
    point, least = tree.tip[leafy], tree.length[leafy].mean()
    low, high = point.min(axis=0) - least, point.max(axis=0) + least
    sides = [np.ptp(tree.tip[leafy & (tree.tree == one)], axis=0).min() for one in np.unique(tree.tree[leafy])]
    return low, high, _REACH * max(float(np.median(sides)), 2 * least)


def _leaves_limb(tree: TreeSkeleton) -> Bool[np.ndarray, " segment"]:
    """Rows whose parent is of another limb."""
    return ~tree.is_base & (tree.limb[tree.parent] != tree.limb)
