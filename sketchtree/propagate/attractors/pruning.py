"""What is taken off a subtree that replaces a branch (Tan et al. 2008, §3.1, "Branch pruning")?

    beyond   what leaves the foliage as the page shows it ends before it does, and where leaves are at home (`Target.dense`; ours); a branch of which less than two pieces are left is removed
    deep     what goes farther out, before or behind, than the foliage revolved about its axes (`revolved`) ends likewise, unless it starts as far out (ours; `DEEP`)
    back     what grows against the light, back through the tree, is removed (ours; `BACK`)
    close    new branches too near to branches that are there are removed, from where they come too near

With a branch goes all it bears.
"""

from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.propagate.attractors.library import Library
from sketchtree.propagate.attractors.placement import Placed
from sketchtree.propagate.attractors.revolved import Axes
from sketchtree.propagate.attractors.target import Target

DEEP = 1.1  # times as far out as the foliage revolved, at most
BACK = -0.3  # cosine between a piece and the light, at least


def within_foliage(at: Placed, library: Library, target: Target, home: Target, axes: Axes, light: Float[np.ndarray, " 3"], shortest: float) -> Placed:
    """The same without what leaves the foliage on the page or in depth or grows back, and without stumps and pieces shorter than `shortest` (metres). Wood may go through `target` and end in `home`."""
    vector = at.end - at.start
    length = np.linalg.norm(vector, axis=-1)
    middle = 0.5 * (at.start + at.end)
    there = at.there & home.inside(at.end[..., :2]) & target.inside(middle[..., :2]) & (vector @ light >= BACK * length) & (length >= shortest)
    there &= axes.out(at.end) <= np.maximum(DEEP, axes.out(at.start))
    return replace(at, there=whole_branches(there, library))


def whole_branches(there: Bool[np.ndarray, "subtree turn piece"], library: Library) -> Bool[np.ndarray, "subtree turn piece"]:
    """Pieces that are left: all they grow on is, and of their branch at least two pieces are."""
    for _ in range(2):  # a stump that goes takes along what grows on it
        lost = (~there).astype(float)
        there = np.einsum("spq,stq->stp", library.below, lost) == 0
        alone = library.with_next[:, None] & ~np.concatenate([there[..., 1:], np.zeros_like(there[..., :1])], axis=-1)
        there = there & ~alone
    return library.there[:, None] & (np.einsum("spq,stq->stp", library.below, (~there).astype(float)) == 0)
