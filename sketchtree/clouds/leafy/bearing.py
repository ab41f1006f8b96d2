"""What bears the leaves that were seen? Twigs that grow from the wood towards them, one to a handful of leaves.

Where leaves hide the wood, nobody knows how it runs. As Guo et al. 2018, §5.2, have it, buds all along the wood that is known grow towards points: here those of leaves, gathered into cells of
four internodes of the species, so that what grows is about as dense as twigs are. Leaves then stand at its tips and along it (`covering`).
"""

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.clouds.growing.box import boxed
from sketchtree.clouds.growing.filled import reaching
from sketchtree.clouds.growing.grown import APART
from sketchtree.clouds.growing.markers import gathered
from sketchtree.clouds.growing.species import Species
from sketchtree.skeleton import TreeSkeleton

_FEWEST = 3  # points of leaves in a cell that a twig grows to


def bearing(tree: TreeSkeleton, xyz: Float[np.ndarray, "point 3"], leaf: Float[np.ndarray, "leaf 3"], species: Species, *, key: Key[Array, ""]) -> TreeSkeleton:
    """The tree and, after its own rows, twigs to its leaves (kind GROWN). `xyz`: the whole cloud, `leaf`: its points that are leaves, metres."""
    if not len(leaf):
        return tree
    box = boxed(xyz)
    cells = gathered(box.to_sketch(leaf), np.ones(len(leaf)), APART * species.internode)
    high = float(np.ptp(xyz[:, 1])) / box.scale
    return reaching(tree, box, cells.xyz[cells.weight >= _FEWEST], high, species, key=key)
