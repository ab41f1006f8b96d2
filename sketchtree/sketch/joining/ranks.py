"""What does a first tree say of every attachment? Limbs bear; twigs hardly do.

    rank       order of the parent in that tree: 0 a trunk, 1 its limbs, …; −1 where the parent hangs on the child there
    bears      how many other strokes hang on the parent there
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL

HIGHEST = 8  # orders told apart


def ranks(
    child: Int[np.ndarray, " arc"], parent: Int[np.ndarray, " arc"], above: Int[np.ndarray, " line"]
) -> dict[str, Float[np.ndarray, " arc"]]:
    """The figures of every arc; `above`: the parent of every line in the first tree, NULL on the ground."""
    order = np.zeros(len(above), np.int64)
    ancestor, hangs = parent.copy(), np.zeros(len(parent), bool)
    walk = above.copy()
    for _ in range(HIGHEST):
        order += walk != NULL
        walk = np.where(walk == NULL, NULL, above[walk])
        hangs |= ancestor == child
        ancestor = np.where(ancestor == NULL, NULL, above[ancestor])
    count = np.bincount(above[above != NULL], minlength=len(above))
    return {
        "rank": np.where(hangs, -1.0, order[parent]),
        "bears": (count[parent] - (above[child] == parent)).astype(float),
    }
