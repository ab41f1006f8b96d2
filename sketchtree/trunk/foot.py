"""Where does the trunk stand, and which branches on it, below its crown, are none?

The matte of a photo frays where the trunk meets the ground: grass, snow and shadows are as dark or as light as bark, and the axis runs out into every corner of them. Ours, beside the paper:

- the walk begins in the widest of the circles that come near to the lowest, not in the lowest corner;
- the crown begins with the first branch that carries as much as a branch does: `LIMB` of the tree's height, or half of what the heaviest carries where all are short. What forks off below is left out, and a
  warning says how many; tips that a person asked for stay.
"""

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.trunk.borne import carried
from sketchtree.trunk.rooted import Rooted

NEAR = 0.03  # of the tree's height, and three pixels: circles so near to the lowest stand on the ground
LIMB = 0.25  # of the tree's height: length of wood that a limb of the crown carries
_HALF = 0.5  # of what the heaviest branch carries


def stands_at(xy: Float[np.ndarray, "node 2"], radius: Float[np.ndarray, " node"]) -> int:
    """The node of an axis, pixels, y down, that the trunk stands on."""
    reach = xy[:, 1] + radius
    low = reach >= reach.max() - max(NEAR * float(np.ptp(xy[:, 1])), 3.0)
    return int(np.argmax(np.where(low, radius + 1e-6 * xy[:, 1], -np.inf)))


def bare_below(tree: Rooted, asked: Bool[np.ndarray, " node"]) -> tuple[Rooted, int]:
    """(the tree without branches below its crown, how many they were)."""
    children: list[list[int]] = [[] for _ in tree.parent]
    kept = np.array(asked)
    for row in range(len(tree.parent) - 1, 0, -1):
        children[tree.parent[row]].append(row)
        kept[tree.parent[row]] |= kept[row]
    wood = carried(tree.parent, np.r_[0.0, np.hypot(*(tree.xy[1:] - tree.xy[tree.parent[1:]]).T)])
    main = _heaviest(children, wood)
    sides = [(row, child) for row in main for child in children[row] if child not in main]
    if not sides:
        return tree, 0
    least = min(LIMB * float(np.ptp(tree.xy[:, 1])), _HALF * max(wood[child] for _, child in sides))
    gone = []
    for _, child in sides:
        if wood[child] >= least:
            break
        gone += [] if kept[child] else [child]
    here = np.ones(len(tree.parent), bool)
    here[gone] = False
    for row in range(1, len(here)):
        here[row] &= here[tree.parent[row]]
    return tree.select(here), len(gone)


def _heaviest(children: list[list[int]], wood: Float[np.ndarray, " node"]) -> dict[int, None]:
    """The rows from the root on, always to the child that carries most, in order."""
    way, at = {0: None}, 0
    while children[at]:
        at = max(children[at], key=lambda row: wood[row])
        way[at] = None
    return way
