"""The wood of a tree with few triangles."""

import jax
import numpy as np
import pytest

from sketchtree.geometry.wood import wood_meshes
from sketchtree.levels.outline_error import overlap, views_round
from sketchtree.levels.raster import silhouette
from sketchtree.levels.wood import LevelWood
from sketchtree.parameters import Habit
from sketchtree.skeleton import TreeSkeleton


def level_wood(skeleton, *, triangles, **how):
    return LevelWood.of(skeleton, **how).meshes(triangles)


def tree(seed=0, limbs=40):
    """A trunk with crooked limbs all round it."""
    rng = np.random.default_rng(seed)
    parent, tip, radius, limb = [-1], [[0, 0, 0]], [0.3], [1]
    for k in range(10):
        parent.append(k)
        tip.append([0.05 * np.sin(k), 0.8 * (k + 1), 0.0])
        radius.append(0.28 - 0.022 * k)
        limb.append(1)
    for k in range(limbs):
        foot = int(rng.integers(3, 10))
        angle = rng.uniform(0, 2 * np.pi)
        at, last = np.array(tip[foot], float), foot
        for step in range(4):
            at = at + 0.5 * np.array([np.cos(angle), 0.5 + 0.2 * step, np.sin(angle)]) + 0.05 * rng.normal(size=3)
            parent.append(last)
            last = len(tip)
            tip.append(at.tolist())
            radius.append(radius[foot] * 0.35 * (1 - 0.2 * step))
            limb.append(2 + k)
    return TreeSkeleton.from_columns(parent=np.array(parent), tip=np.array(tip), radius=np.array(radius), limb=np.array(limb))


@pytest.fixture(scope="module")
def both():
    skeleton = tree()
    full = wood_meshes(skeleton, bark="oak", habit=Habit(), key=jax.random.key(0), wood="tubes")
    return skeleton, full, sum(mesh.triangle_count for mesh in full)


@pytest.mark.parametrize("share", [0.5, 0.2, 0.06])
def test_it_keeps_its_budget_and_names(both, share):
    skeleton, _, total = both
    few = level_wood(skeleton, bark="oak", habit=Habit(), triangles=int(share * total))
    assert 0.8 * share * total < sum(mesh.triangle_count for mesh in few) <= share * total
    assert few[0].name == "wood" and all(mesh.name.startswith("wood") for mesh in few)


@pytest.mark.parametrize(("share", "bar"), [(0.5, 0.97), (0.2, 0.93), (0.06, 0.65)])
def test_its_outline_is_the_full_trees(both, share, bar):
    skeleton, full, total = both
    few = level_wood(skeleton, bark="oak", habit=Habit(), triangles=int(share * total))
    for view in views_round(full, 4, 256):
        assert overlap(silhouette(full, view), silhouette(few, view)) > bar


def test_leafy_limbs_go_first(both):
    skeleton, _, total = both
    leafy = skeleton.limb % 2 == 0
    few = level_wood(skeleton, bark="oak", habit=Habit(), triangles=int(0.06 * total), leafy=leafy)
    even = level_wood(skeleton, bark="oak", habit=Habit(), triangles=int(0.06 * total))

    def near(meshes, rows):
        point = np.vstack([mesh.position for mesh in meshes])
        return np.mean([np.linalg.norm(point - tip, axis=1).min() < 0.15 for tip in skeleton.tip[rows & (skeleton.limb > 1)]])

    assert near(few, leafy) < near(even, leafy) + 1e-9 and near(few, ~leafy) >= near(even, ~leafy)


def test_normals_are_of_unit_length_and_triangles_look_outwards(both):
    skeleton, _, total = both
    for mesh in level_wood(skeleton, bark="oak", habit=Habit(), triangles=int(0.2 * total)):
        assert np.allclose(np.linalg.norm(mesh.normal, axis=1), 1)
        a, b, c = (mesh.position[mesh.triangle[:, k]] for k in range(3))
        face = np.cross(b - a, c - a)
        outward = np.einsum("ij,ij->i", face, mesh.normal[mesh.triangle].sum(axis=1))
        sides = np.linalg.norm(face, axis=1) > 1e-9
        assert (outward[sides] > -1e-9).mean() > 0.99


def test_no_triangle_and_no_tree():
    assert sum(mesh.triangle_count for mesh in level_wood(tree(), bark="oak", habit=Habit(), triangles=0)) == 0
    bare = TreeSkeleton.from_columns(parent=np.array([-1]), tip=np.zeros((1, 3)), radius=np.array([0.1]))
    assert level_wood(bare, bark="oak", habit=Habit(), triangles=100)[0].triangle_count == 0
