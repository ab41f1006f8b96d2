"""How thick is an exemplar's wood? The pipe model, brought to the species' trunk.

    r^n = Σ r_child^n,    r = r_twig at every tip

    n        `pipe_exponent`     r_twig   `twig_radius`, metres

The sum gives the trunk some radius r_0 that depends on how many twigs the recipe grew; radii are then
spread linearly between twig and trunk so that the thickest base has `trunk_ratio` × height:

    r ← r_twig + (r − r_twig) (ratio · height − r_twig) / (r_0 − r_twig)

A broken end is as thick as if it still bore what it lost: (1 + lost / `lateral_spacing`)² twigs.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton
from sketchtree.traverse import is_tip, sum_to_root


def pipe_radii(
    tree: TreeSkeleton, habit: Habit, lost: Float[np.ndarray, " segment"] | None = None
) -> Float[np.ndarray, " segment"]:
    """Radius at the tip of every row, metres. `lost`: metres of limb that broke off at a row; none if not given."""
    n, twig = habit.pipe_exponent, habit.twig_radius
    twigs = np.where(is_tip(tree.parent), 1.0, 0.0)
    if lost is not None:
        twigs *= (1.0 + lost / habit.lateral_spacing) ** 2
    area = sum_to_root(tree.parent, twigs * twig**n)
    radius = area ** (1.0 / n)
    thickest = float(radius.max())
    target = habit.trunk_ratio * tree.height
    if thickest <= twig * (1 + 1e-9):
        return np.full(len(tree), max(twig, target))
    return twig + (radius - twig) * max(target - twig, 0.0) / (thickest - twig)
