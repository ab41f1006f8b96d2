"""Which points does a scanner see of a tree of ours? Clouds whose truth is known, and that anybody may have: of the exemplars in `template_db`.

Bark has points by its area, but twigs some more, since a scanner's beam is wider than they are; leaves by their area. `uneven`: one scanner stands beside the tree, and what
is farther from it has fewer points, by the distance squared. All points are off by chance.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.growth_tree import GrowthOptions, grown_tree, of_skeleton
from sketchtree.keys import numpy_generator, root_key, stage_key
from sketchtree.options import TreeOptions
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.store.database import Database

_BY = 0.75  # power of thickness by which bark has points: 1 would be by its area
_BESIDE = 0.9  # heights from the foot to the scanner


@dataclass(frozen=True, eq=False)
class OwnCloud:
    """Points of a tree that is known."""

    name: str
    tree: TreeSkeleton  # its foot at the origin
    xyz: Float[np.ndarray, "point 3"]
    leaf: Bool[np.ndarray, " point"]
    leaf_model: str | None


def own_cloud(name: str, points: int, *, leafy: float = 0.0, noise: float = 0.001, uneven: bool = False, seed: int = 0, finest: float = 0.0) -> OwnCloud:
    """`leafy`: the share of points that lie on leaves; `noise`: of the height; `finest`: radius of the thinnest wood that has points, metres."""
    templates, key = Database.open(), root_key(seed)
    exemplar = templates.exemplar(name)
    tree = exemplar.skeleton
    chance = numpy_generator(stage_key(key, "scan"))
    many = 6 * points if uneven else points
    wood = bark(tree, int(round((1 - leafy) * many)), chance, finest)
    leaves = _leaves(tree, templates, name, many - len(wood), chance) if leafy else np.zeros((0, 3))
    xyz, leaf = np.concatenate([wood, leaves]), np.arange(many) >= len(wood)
    if uneven:
        keep = _seen(xyz, tree.height, points, chance)
        xyz, leaf = xyz[keep], leaf[keep]
    return OwnCloud(name, tree, xyz + noise * tree.height * chance.normal(size=xyz.shape), leaf, exemplar.habit.leaf)


def bark(tree: TreeSkeleton, count: int, chance: np.random.Generator, finest: float = 0.0) -> Float[np.ndarray, "point 3"]:
    """Places on the bark."""
    rows = np.flatnonzero(~tree.is_base & (tree.radius >= finest))
    weight = tree.length[rows] * tree.radius[rows] ** _BY
    row = rows[chance.choice(len(rows), count, p=weight / weight.sum())]
    at, along = chance.uniform(size=(count, 1)), tree.vector[row] / np.maximum(tree.length[row], 1e-12)[:, None]
    out = np.cross(along, chance.normal(size=(count, 3)))
    out /= np.maximum(np.linalg.norm(out, axis=1, keepdims=True), 1e-12)
    before = tree.radius[tree.parent[row]]
    thick = np.minimum(before, 2.0 * tree.radius[row]) * (1 - at[:, 0]) + tree.radius[row] * at[:, 0]
    return tree.start[row] + at * tree.vector[row] + thick[:, None] * out


def _leaves(tree: TreeSkeleton, templates: Database, name: str, count: int, chance) -> Float[np.ndarray, "point 3"]:
    """Places on the leaves that the exemplar wears."""
    model = grown_tree(of_skeleton(tree, TreeOptions(wood="tubes"), templates, key=root_key(0), template=name), GrowthOptions(levels=0), TreeOptions(wood="tubes")).model
    corner = np.concatenate([mesh.position[mesh.triangle] for mesh in model.meshes if mesh.name.startswith("leaf")])
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    of = chance.choice(len(area), count, p=area / area.sum())
    share = chance.dirichlet(np.ones(3), count)
    return np.einsum("pc,pci->pi", share, corner[of])


def _seen(xyz, height: float, count: int, chance):
    """Rows that one scanner's beams hit."""
    away = np.linalg.norm(xyz - _BESIDE * height * np.array([0.7, 0.1, 0.7]), axis=1)
    weight = away**-2.0
    return np.sort(chance.choice(len(xyz), count, replace=False, p=weight / weight.sum()))
