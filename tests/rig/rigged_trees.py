"""Small trees with leaves and meshes for the tests of this room."""

import dataclasses
from functools import lru_cache
from types import SimpleNamespace

import jax
import numpy as np

from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.populate import populate
from sketchtree.geometry.limbs import centre_lines
from sketchtree.geometry.wood import wood_mesh
from sketchtree.rig.boughs import boughs
from sketchtree.rig.rigging import Rigging
from sketchtree.skeleton import TreeSkeleton
from tests.foliage.trees import HABIT

KEY = jax.random.key(0)


def grown(seed: int = 0, boughs: int = 5, *, height: float = 6.0, without: int | None = None) -> TreeSkeleton:
    """A trunk with `boughs` limbs, each with three twigs; limb ids 1, 100 + k, 1000 + 10 k + i. One bough may be left out."""
    rng = np.random.default_rng(seed)
    rows = {name: [] for name in ("parent", "tip", "radius", "limb", "order")}

    def grow(row, start, direction, length, count, radii, limb, order, bend):
        made = []
        for step in range(count):
            direction = direction + bend
            direction = direction / np.linalg.norm(direction)
            start = start + direction * length / count
            values = (row, start, np.interp((step + 1) / count, [0, 1], radii), limb, order)
            for name, value in zip(rows, values, strict=True):
                rows[name].append(value)
            row = len(rows["parent"]) - 1
            made.append((row, start))
        return made

    for name, value in zip(rows, (-1, np.zeros(3), 0.16, 1, 0), strict=True):
        rows[name].append(value)
    trunk = grow(0, np.zeros(3), np.array([0.0, 1, 0]), height, 12, (0.15, 0.03), 1, 0, rng.normal(0, 0.02, 3))
    for k in range(boughs):
        turn, jitter = 2.4 * k, rng.normal(0, 0.05, 3)
        row, foot = trunk[4 + k]
        if k == without:
            continue
        limb = grow(row, foot, np.array([np.cos(turn), 0.6, np.sin(turn)]) + jitter, 0.4 * height, 8, (0.06, 0.01), 100 + k, 1, [0, 0.04, 0])
        for i in range(3):
            row, foot = limb[2 + 2 * i]
            grow(row, foot, np.array([np.cos(turn + 1 + i), 0.4, np.sin(turn + 1 + i)]), 0.15 * height, 4, (0.012, 0.003), 1000 + 10 * k + i, 2, [0, 0.03, 0])
    return TreeSkeleton.from_columns(np.array(rows["parent"]), np.array(rows["tip"]), np.array(rows["radius"]), limb=np.array(rows["limb"]), order=np.array(rows["order"]))


@lru_cache(maxsize=4)
def dressed(seed: int = 0):
    """(tree, lines, boughs, leaves, wood mesh, leaf mesh) of `grown(seed)`."""
    tree = grown(seed)
    lines = centre_lines(tree)
    leaves = populate(tree, HABIT, key=KEY, model="oak")
    return tree, lines, boughs(tree, lines), leaves, wood_mesh(tree, bark="oak", key=KEY), leaf_mesh(leaves)


@lru_cache(maxsize=2)
def rigged(seed: int = 0):
    """(rigging, wood with all columns, leaves with all columns)."""
    tree, _, _, leaves, wood, leaf = dressed(seed)
    rigging = Rigging.of(tree)
    return rigging, rigging.wood(wood), rigging.leaves(leaf, leaves)


def model(seed: int = 0):
    """What a pack is made of."""
    tree, _, _, leaves, _, _ = dressed(seed)
    return SimpleNamespace(skeleton=tree, leaves=leaves, blossom=None)


def edges(mesh):
    """Pairs of vertices that a triangle joins."""
    both = np.concatenate([mesh.triangle[:, [0, 1]], mesh.triangle[:, [1, 2]], mesh.triangle[:, [2, 0]]])
    return np.unique(np.sort(both, axis=1), axis=0)


def coarser(mesh, share: float):
    """The mesh with the first `share` of its triangles: a stand-in for a level of detail."""
    return dataclasses.replace(mesh, triangle=mesh.triangle[: int(share * len(mesh.triangle))])
