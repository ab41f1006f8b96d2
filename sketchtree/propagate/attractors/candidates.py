"""Which branches may be replaced next? A small set of thick and old ones (Tan et al. 2008, §3.1).

    radius   the paper's: all branches sorted by radius are gone through from the thickest on; each is taken with a probability inversely proportional to its
             generation, until the set is full
    need     ours: each is taken with a probability proportional to  need / generation,  need being how far in all the attractors are that its limb is the nearest to

A branch that was replaced k times, or tried in vain, counts as k generations older (ours): else the same few thick ones would be the set for ever.
"""

import numpy as np
from jaxtyping import Float

from sketchtree import keys
from sketchtree.propagate.attractors.wood import Stretch, Wood

SET = 4  # branches


def candidates(stretches: list[Stretch], wood: Wood, key: np.uint64, iteration: int, need: Float[np.ndarray, " limb"] | None = None, most: int = SET) -> list[int]:
    """Numbers of the stretches taken; by radius, or by need where that is given."""
    if not stretches:
        return []
    limb = np.array([one.limb for one in stretches])
    radius = np.array([wood.limbs[number].radius for number in limb])
    generation = np.array([wood.limbs[one.limb].generation + one.replaced for one in stretches], float)
    identity = np.array([one.identity for one in stretches], np.int64)
    chance = keys.uniform(key, identity, iteration)
    if need is None:
        order = np.lexsort((identity, -radius))
        return order[(chance * generation)[order] < 1.0][:most].tolist()
    wanted = need[limb] / generation
    score = -np.log1p(-chance) / np.maximum(wanted, 1e-300)  # the least of exponential waits: drawn without replacement, in proportion to what is wanted
    order = np.lexsort((identity, score))
    return order[wanted[order] > 0][:most].tolist()
