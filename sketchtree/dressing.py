"""What does a bare skeleton wear? Wood with bark, and leaves where a model of them is named.

As the pipeline's last stages dress a tree that was drawn, with the same random keys: the skeleton of a project, with its seed, species
and season, gets back the bark and the leaves that it was built with.
"""

from dataclasses import dataclass

from jaxtyping import Array, Key

from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.populate import populate
from sketchtree.geometry.mesh import Mesh
from sketchtree.geometry.wood import wood_meshes
from sketchtree.keys import stage_key
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton


@dataclass(frozen=True)
class Dress:
    """What to put on."""

    bark: str  # a name of `bark_names()`
    leaf: str | None  # a name of `leaf_names()`; None: no leaves
    season: str = "summer"
    habit: Habit = Habit()


def dressed(tree: TreeSkeleton, dress: Dress, *, key: Key[Array, ""]) -> tuple[Mesh, ...]:
    """Wood, then leaves and blossoms if there are any. Metres."""
    meshes = [*wood_meshes(tree, bark=dress.bark, habit=dress.habit, key=stage_key(key, "mesh"))]
    if dress.leaf is not None:
        how = {"key": stage_key(key, "foliage"), "model": dress.leaf, "season": dress.season}
        worn = [populate(tree, dress.habit, **how), blossom(tree, dress.habit, **how)]
        meshes += [leaf_mesh(leaves, season=dress.season) for leaves in worn if leaves is not None and len(leaves)]
    return tuple(meshes)
