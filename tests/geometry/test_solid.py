"""Wood as a solid: what lies inside another limb is gone, and nothing else."""

import sys

import jax
import numpy as np
import pytest
from growing import bushy, fork

from benchmarks.wood_audit import audit, together
from sketchtree.errors import ExportError, OptionError
from sketchtree.geometry.mesh import Material, Mesh
from sketchtree.geometry.radii import PipeRadii
from sketchtree.geometry.wood import wood_meshes, wood_of
from sketchtree.parameters import Habit

KEY = jax.random.key(0)
TREES = {"fork": fork(45, 0.6), "whorl": fork(65, 0.4, 4), "bushy": PipeRadii(Habit())(bushy(0, levels=1))}


def solid(tree):
    pytest.importorskip("manifold3d", reason="the solid needs manifold3d")
    return wood_of(tree, bark="oak", habit=Habit(), key=KEY, solid=True)


@pytest.mark.parametrize("name", TREES)
def test_a_solid_is_one_closed_surface_of_the_same_materials(name):
    wood = solid(TREES[name])
    found = audit(*together(wood.meshes))
    assert (found["parts"], found["open"], found["nonmanifold"], found["turned"]) == (1, 0, 0, 0)
    tubes = wood_meshes(TREES[name], bark="oak", habit=Habit(), key=KEY, wood="tubes")
    assert [mesh.material.name for mesh in wood.meshes] == [mesh.material.name for mesh in tubes]
    assert wood.made == "solid"


def inside(point, position, triangle):
    """Whether points are inside any of some closed surfaces, by their winding numbers (van Oosterom & Strackee 1983)."""
    total = np.zeros(len(point))
    for k in range(0, len(point), 200):
        a, b, c = (position[triangle[:, corner]][None] - point[k : k + 200, None] for corner in range(3))
        la, lb, lc = (np.linalg.norm(x, axis=-1) for x in (a, b, c))
        top = np.einsum("ptx,ptx->pt", a, np.cross(b, c))
        below = la * lb * lc + np.einsum("ptx,ptx->pt", a, b) * lc + np.einsum("ptx,ptx->pt", b, c) * la + np.einsum("ptx,ptx->pt", c, a) * lb
        total[k : k + 200] = np.arctan2(top, below).sum(axis=1) / (2.0 * np.pi)
    return total > 0.5


@pytest.mark.parametrize("name", ["fork", "whorl"])
def test_its_volume_is_that_of_the_tubes_less_their_overlaps(name):
    tubes = together(wood_meshes(TREES[name], bark="oak", habit=Habit(), key=KEY, wood="tubes"))
    low, high = np.array([-0.25, 0.85, -0.25]), np.array([0.25, 1.35, 0.25])  # about the fork, where they overlap
    point = low + np.random.default_rng(0).random((1000, 3)) * (high - low)
    share = [inside(point, *surface) for surface in (tubes, together(solid(TREES[name]).meshes))]
    assert (share[0] != share[1]).mean() < 0.03 * share[0].mean()
    whole = audit(*tubes)["volume"]
    assert 0.8 * whole < audit(*together(solid(TREES[name]).meshes))["volume"] < whole


def test_texture_and_normals_go_along():
    for mesh in solid(TREES["fork"]).meshes:
        assert np.ptp(mesh.uv[mesh.triangle], axis=1).max() < 2.0
        np.testing.assert_allclose(np.linalg.norm(mesh.normal, axis=1), 1.0, atol=1e-9)


def test_without_manifold3d_the_remedy_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "manifold3d", None)
    with pytest.raises(OptionError, match=r"A solid needs the package `manifold3d`. Install it with pip install 'sketchtree\[solid\]', or leave out `--solid`."):
        wood_of(TREES["fork"], bark="oak", habit=Habit(), key=KEY, solid=True)


def test_an_open_surface_is_refused():
    pytest.importorskip("manifold3d", reason="the solid needs manifold3d")
    from sketchtree.geometry.solid import united

    corner = np.eye(3)
    leaf = Mesh("wood", corner, np.tile([0.0, 0.0, 1.0], (3, 1)), corner[:, :2], np.array([[0, 1, 2]]), Material("wood"))
    with pytest.raises(ExportError, match="The wood is no solid: NotManifold. Leave out `--solid`, or draw limbs that do not coincide."):
        united([leaf])


def test_crumbs_that_touch_nothing_are_left_out_and_counted():
    pytest.importorskip("manifold3d", reason="the solid needs manifold3d")
    from sketchtree.geometry.solid import united

    def ball(radius, x):
        corner = np.array([[1.0, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
        face = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
        return Mesh("wood", corner * radius + [x, 0, 0], corner, corner[:, :2], face, Material("wood"))

    (whole, *_), crumbs = united([ball(1.0, 0.0), ball(0.01, 5.0)])
    assert crumbs == 1 and whole.position[:, 0].max() < 1.1
