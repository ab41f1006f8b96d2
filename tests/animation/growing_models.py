"""Small finished trees that grow."""

from functools import lru_cache
from types import SimpleNamespace

import numpy as np

from sketchtree.animation.growing import Growing
from sketchtree.dressing import Dress, wood_worn
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.populate import populate
from sketchtree.growth.grafting import Graft
from sketchtree.growth.plan import GrowthPlan
from sketchtree.keys import root_key, stage_key
from sketchtree.skeleton import Kind, TreeSkeleton


@lru_cache
def skeleton(levels: int = 1) -> TreeSkeleton:
    """A trunk of ten pieces that bears six limbs of five, and what is grafted on it."""
    parent, tip, radius, limb, order = [-1], [np.zeros(3)], [0.2], [0], [0]
    for k in range(10):
        parent.append(k), tip.append(np.array([0.05 * np.sin(k), 0.5 * (k + 1), 0.0])), radius.append(0.2 - 0.016 * k), limb.append(0), order.append(0)
    for k, node in enumerate((4, 5, 6, 7, 8, 9)):
        azimuth, at = 2.4 * k, node
        for j in range(5):
            way = np.array([np.cos(azimuth), 0.7 + 0.05 * j, np.sin(azimuth)])
            parent.append(at), tip.append(tip[at] + 0.35 * way / np.linalg.norm(way)), radius.append(0.06 - 0.009 * j), limb.append(k + 1), order.append(1)
            at = len(parent) - 1
    bare = TreeSkeleton.from_columns(parent, np.array(tip), radius, limb=limb, order=order, kind=np.full(len(parent), int(Kind.DRAWN)))
    return Graft(levels)(bare, key=root_key(0))


@lru_cache
def model(levels: int = 1, wood: str = "tubes"):
    """The tree with bark and leaves."""
    tree, dress = skeleton(levels), Dress("oak", "oak", wood=wood)
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
