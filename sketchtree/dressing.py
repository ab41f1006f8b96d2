"""What does a bare skeleton wear? Wood with bark, and leaves where a model of them is named.

As the pipeline's last stages dress a tree that was drawn, with the same random keys: the skeleton of a project, with its seed, species
and season, gets back the bark and the leaves that it was built with.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Key

from sketchtree.errors import SkeletonError
from sketchtree.foliage.blossom import blossom
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.populate import populate
from sketchtree.geometry.bark import Colour
from sketchtree.geometry.mesh import Mesh
from sketchtree.geometry.wood import Wood, wood_of
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
    wood: str | None = None  # one-piece | tubes; None: as `wood_of` chooses
    solid: bool = False  # the tubes united
    bark_colour: Colour | None = None  # the bark's mean colour, linear; None: its own


LARGEST = 1e5
"""Metres: a tree that reaches farther in any direction has a point astray. (One of 100 m, in millimetres, does not.)"""


def dressed(tree: TreeSkeleton, dress: Dress, *, key: Key[Array, ""]) -> tuple[Mesh, ...]:
    """Wood, then leaves and blossoms if there are any. Metres."""
    return (*wood_worn(tree, dress, key=key).meshes, *leaves_worn(tree, dress, key=key))


def wood_worn(tree: TreeSkeleton, dress: Dress, *, key: Key[Array, ""]) -> Wood:
    """The wood, how it was made, and what a person should know about that. Raises `SkeletonError` for a tree beyond `LARGEST`."""
    extent = float(np.abs(tree.tip).max(initial=0.0))
    if extent > LARGEST:
        far = int(np.abs(tree.tip).max(axis=1).argmax())
        raise SkeletonError(f"it lies {extent:.3g} m away from the origin, farther than any tree.", remedy="Scale the skeleton to metres, or take the stray point out.", row=far)
    return wood_of(tree, bark=dress.bark, habit=dress.habit, key=stage_key(key, "mesh"), wood=dress.wood, solid=dress.solid, bark_colour=dress.bark_colour)


def leaves_worn(tree: TreeSkeleton, dress: Dress, *, key: Key[Array, ""]) -> tuple[Mesh, ...]:
    """The leaves, and the blossoms of a spring; nothing where the dress has none."""
    if dress.leaf is None:
        return ()
    how = {"key": stage_key(key, "foliage"), "model": dress.leaf, "season": dress.season}
    worn = [populate(tree, dress.habit, **how), blossom(tree, dress.habit, **how)]
    return tuple(leaf_mesh(leaves, season=dress.season) for leaves in worn if leaves is not None and len(leaves))
