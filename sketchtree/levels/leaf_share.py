"""How many of a level's triangles go to the leaves?

Leaves hide most of the wood, so they come first; the wood keeps what it takes for the limbs that still show.

    leaves    min(all they can use, max(F · T, T − W))        T: triangles of the level    W: of the full tree's wood
"""

from collections.abc import Sequence

from sketchtree.foliage.leaf_cards import leaf_cards
from sketchtree.foliage.leaves import Leaves
from sketchtree.geometry.mesh import Mesh

_SHARE = 0.7  # F


def spent(worn: Sequence[Leaves], season: str, triangles: int, wood: int) -> tuple[Mesh, ...]:
    """The leaves and blossoms of a level of so many triangles, of a tree whose wood has `wood` in full."""
    most = max(_SHARE * triangles, triangles - wood)
    total = sum(len(leaves) for leaves in worn)
    found = []
    for leaves in worn:
        budget = int(most * len(leaves) / total)
        if budget >= 1:
            found.append(leaf_cards(leaves, season=season, triangles=budget))
    return tuple(mesh for mesh in found if mesh.triangle_count)
