"""Small finished trees that grow."""

from functools import lru_cache
from types import SimpleNamespace

import numpy as np

from sketchtree.animation.growing import Growing
from sketchtree.dressing import Dress, wood_worn
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.populate import populate
from sketchtree.growth.plan import GrowthPlan
from sketchtree.keys import root_key, stage_key
from tests.growth.growth_trees import crown


@lru_cache
def model(levels: int = 1, wood: str = "tubes"):
    """The tree with bark and leaves."""
    tree, dress = crown(levels), Dress("oak", "oak", wood=wood)
    made = wood_worn(tree, dress, key=root_key(0))
    leaves = populate(tree, dress.habit, key=stage_key(root_key(0), "foliage"), model="oak", season="summer")
    return SimpleNamespace(skeleton=tree, leaves=leaves, blossom=None, meshes=(*made.meshes, leaf_mesh(leaves)), dress=dress)


@lru_cache
def growing(mode: str = "age", bend: float = 0.0, *, levels: int = 1, wood: str = "tubes", most_joints: int = 3000) -> Growing:
    """The same with a plan."""
    made = model(levels, wood)
    return Growing.of(made, GrowthPlan.of(made.skeleton, mode=mode, bend=bend), most_joints=most_joints)


def area(mesh) -> float:
    """Of all triangles, m²."""
    corner = mesh.position[mesh.triangle]
    return float(np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1).sum() / 2)
