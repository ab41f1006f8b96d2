import dataclasses

import jax
import numpy as np
import pytest
from growing import bushy, drawn, fork, stick

from sketchtree.errors import OptionError
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.radii import PipeRadii
from sketchtree.geometry.wood import wood_mesh, wood_meshes
from sketchtree.parameters import Habit

KEY = jax.random.key(0)


def wood(tree, **detail):
    return wood_mesh(tree, bark="oak", key=KEY, detail=Detail(**detail), wood="tubes")


def welded(mesh):
    """Triangles over positions that are equal."""
    _, same = np.unique(np.round(mesh.position, 9), axis=0, return_inverse=True)
    return same.reshape(-1)[mesh.triangle]


def areas(mesh):
    corner = mesh.position[mesh.triangle]
    return 0.5 * np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])


TREES = {
    "stick": stick([(0, 0, 0), (0.1, 1, 0), (0, 3, 0.2)], [0.1, 0.08, 0.02]),
    "acute fork": fork(18, 0.8),
    "right fork": fork(90, 0.5),
    "backward fork": fork(140, 0.4),
    "thin on thick": fork(60, 0.05),
    "as thick as its parent": fork(45, 1.0),
    "whorl of four": fork(65, 0.4, 4),
    "drawn": drawn(),
    "bushy": PipeRadii(Habit())(bushy(0)),
}
every = pytest.mark.parametrize("tree", TREES.values(), ids=TREES)


@every
def test_every_tube_is_closed(tree):
    triangle = welded(wood(tree))
    edge = np.concatenate([triangle[:, [0, 1]], triangle[:, [1, 2]], triangle[:, [2, 0]]])
    forward = {tuple(pair) for pair in edge.tolist()}
    assert len(forward) == len(edge)  # no edge is used twice the same way: winding is consistent
    assert all((b, a) in forward for a, b in forward)


@every
def test_no_triangle_is_degenerate(tree):
    mesh = wood(tree)
    assert np.linalg.norm(areas(mesh), axis=1).min() > 1e-12 * tree.height**2
    assert (np.diff(np.sort(welded(mesh), axis=1), axis=1) > 0).all()


@every
def test_numbers_are_finite_and_normals_unit(tree):
    mesh = wood(tree)
    assert np.isfinite(mesh.position).all() and np.isfinite(mesh.uv).all()
    np.testing.assert_allclose(np.linalg.norm(mesh.normal, axis=1), 1.0, atol=1e-9)


def facing(mesh):
    """Cosine between each triangle's normal and the mean of its vertices'."""
    face = areas(mesh)
    return np.sum(face * mesh.normal[mesh.triangle].mean(axis=1), axis=1) / np.linalg.norm(face, axis=1)


@every
def test_triangles_and_normals_face_outwards(tree):
    mesh = wood(tree, collar_radius=10.0)
    shown = mesh.position[mesh.triangle].mean(axis=1)[:, 1] > 0
    assert facing(mesh)[shown].min() > 0
    corner = mesh.position[mesh.triangle]
    assert np.sum(corner[:, 0] * np.cross(corner[:, 1], corner[:, 2])) > 0  # volume


@pytest.mark.parametrize("name", ["acute fork", "right fork", "backward fork", "as thick as its parent", "whorl of four"])
def test_collars_face_outwards_wherever_they_show(name):
    mesh = wood(TREES[name])
    centre = mesh.position[mesh.triangle].mean(axis=1)
    hidden = np.hypot(centre[:, 0], centre[:, 2]) < np.interp(centre[:, 1], [0, 1, 2, 3], [0.1, 0.1, 0.08, 0.05])
    assert facing(mesh)[~hidden].min() > 0


def test_a_cylinder_has_its_volume_and_area():
    tree = stick([(0, 0, 0), (0, 4, 0)], 0.1)
    mesh = wood(tree, flare=0.0, tolerance=2e-5, most_sides=64)
    corner = mesh.position[mesh.triangle]
    volume = np.sum(corner[:, 0] * np.cross(corner[:, 1], corner[:, 2])) / 6
    assert volume == pytest.approx(np.pi * 0.01 * 4.03, rel=0.03)


def test_every_vertex_of_a_straight_tube_is_a_radius_from_its_axis():
    mesh = wood(stick([(0, 0, 0), (0, 4, 0)], 0.1), flare=0.0)
    ring = (mesh.position[:, 1] > 0) & (mesh.position[:, 1] < 3.99)
    np.testing.assert_allclose(np.hypot(mesh.position[ring, 0], mesh.position[ring, 2]), 0.1)


def test_rings_stand_at_every_drawn_node():
    tree = drawn()
    mesh = wood(tree, collar_radius=10.0)
    trunk = np.flatnonzero(tree.limb == 0)[1:-1]
    for row in trunk:
        away = np.linalg.norm(mesh.position - tree.tip[row], axis=1)
        assert np.isclose(away, tree.radius[row], rtol=2e-3).sum() >= 6


def test_the_wood_reaches_underground():
    assert wood(stick([(0, 0, 0), (0, 4, 0)], 0.1)).position[:, 1].min() == pytest.approx(-0.03)


def test_the_stem_flares_at_the_ground():
    mesh = wood(stick([(0, 0, 0), (0, 4, 0)], 0.1), flare=0.5)
    reach = np.hypot(mesh.position[:, 0], mesh.position[:, 2])
    low, high = reach[np.abs(mesh.position[:, 1]) < 0.01], reach[np.abs(mesh.position[:, 1] - 2) < 0.5]
    assert 0.12 < low.mean() < 0.18
    np.testing.assert_allclose(high, 0.1, rtol=0.01)


def lateral_of(mesh):
    """Positions of the part that does not reach underground."""
    import scipy.sparse

    triangle = welded(mesh)
    size = triangle.max() + 1
    graph = scipy.sparse.coo_matrix((np.ones(len(triangle)), (triangle[:, 0], triangle[:, 1])), shape=(size, size))
    graph += scipy.sparse.coo_matrix((np.ones(len(triangle)), (triangle[:, 1], triangle[:, 2])), shape=(size, size))
    part = scipy.sparse.csgraph.connected_components(graph, directed=False)[1][triangle[:, 0]]
    lowest = mesh.triangle[np.argmin(mesh.position[mesh.triangle].min(axis=1)[:, 1])]
    trunk = part[np.flatnonzero((mesh.triangle == lowest).all(axis=1))[0]]
    return mesh.position[np.unique(mesh.triangle[part != trunk])]


@pytest.mark.parametrize("thickness", [0.1, 0.5, 0.85])
@pytest.mark.parametrize("angle", [20, 45, 70, 90, 120])
def test_a_lateral_starts_inside_its_parents_wood(angle, thickness):
    place = lateral_of(wood(fork(angle, thickness), flare=0.0))
    out = np.hypot(place[:, 0], place[:, 2])
    lid = np.argmin(out)
    wall = np.interp(place[:, 1], [0, 1, 2, 3], [0.1, 0.1, 0.08, 0.05])
    assert out[lid] < 0.7 * wall[lid]
    assert (out < 0.97 * wall).sum() >= 5  # a whole ring of it


@pytest.mark.parametrize("angle", [60, 75, 90])
def test_a_collar_is_wider_than_its_limb_and_no_wider_than_needed(angle):
    tree = fork(angle, 0.4)
    with_collar, without = (lateral_of(wood(tree, flare=0.0, collar_radius=least, tolerance=1e-4)) for least in (0.0, 10.0))
    step = np.array([0.0, 1.0, 0.0])
    spread = [np.ptp((place - step)[np.hypot(place[:, 0], place[:, 2]) < 0.13][:, 2]) for place in (with_collar, without)]
    assert 1.2 < spread[0] / spread[1] < 3.5


def uv_stretch(mesh):
    """Largest over smallest stretch of the texture, its mean density (tiles a metre), and the area of each triangle
    above the ground."""
    shown = mesh.position[mesh.triangle].mean(axis=1)[:, 1] > 0
    mesh = dataclasses.replace(mesh, triangle=mesh.triangle[shown])
    corner, uv = mesh.position[mesh.triangle], mesh.uv[mesh.triangle]
    e = np.stack([corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]], axis=-1)
    d = np.stack([uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]], axis=-1)
    good = np.abs(np.linalg.det(d)) > 1e-14
    scale = np.linalg.svd(e[good] @ np.linalg.inv(d[good]), compute_uv=False)
    return scale[:, 0] / scale[:, 1], 1 / np.sqrt(scale[:, 0] * scale[:, 1]), np.linalg.norm(areas(mesh), axis=1)[good]


def test_texture_stretch_is_at_most_two_off_forks_and_flares():
    tree = stick([(0, 0, 0), (0.1, 2, 0), (0.3, 4, 0.2), (0.2, 6, 0), (0, 8, 0)], [0.2, 0.1, 0.05, 0.02, 0.004])
    stretch, _, area = uv_stretch(wood(tree, flare=0.0))
    assert area[stretch <= 2.0].sum() > 0.998 * area.sum()


def test_texel_density_varies_by_little_over_a_whole_tree():
    stretch, density, area = uv_stretch(wood(TREES["bushy"]))
    order = np.argsort(density)
    share = np.cumsum(area[order]) / area.sum()
    assert density[order][np.searchsorted(share, 0.95)] / density[order][np.searchsorted(share, 0.05)] < 6
    assert area[stretch <= 2.1].sum() > 0.85 * area.sum()


def test_texture_closes_round_thick_wood():
    mesh = wood(stick([(0, 0, 0), (0, 4, 0)], [0.2, 0.16]), flare=0.0)
    u = mesh.uv[:, 0]
    assert np.isclose((u.max() - u.min()) % 1.0, 0.0, atol=1e-9) and u.max() - u.min() >= 1


def test_the_seam_is_at_the_back():
    mesh = wood(stick([(0, 0, 0), (0, 4, 0)], 0.2), flare=0.0)
    seam = np.isclose(mesh.uv[:, 0], mesh.uv[:, 0].min())
    assert (mesh.position[seam][:-1, 2] < -0.1).all()


def test_bark_stands_upright():
    mesh = wood(stick([(0, 0, 0), (0, 4, 0)], 0.2), flare=0.0)
    assert np.corrcoef(mesh.position[:, 1], mesh.uv[:, 1])[0, 1] < -0.99  # v runs down the image


def test_the_key_shifts_the_bark_and_nothing_else():
    one, other = (wood_mesh(TREES["bushy"], bark="oak", key=jax.random.key(seed)) for seed in (0, 1))
    np.testing.assert_array_equal(one.position, other.position)
    assert not np.allclose(one.uv, other.uv)


def test_same_key_same_mesh():
    one, other = wood(TREES["bushy"]), wood(TREES["bushy"])
    for name in ("position", "normal", "uv", "triangle"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))


def test_finer_detail_has_more_triangles():
    assert len(wood(TREES["bushy"], tolerance=5e-5).triangle) > 1.3 * len(wood(TREES["bushy"], tolerance=1e-3).triangle)


@pytest.mark.parametrize("budget", [20_000, 12_000, 6_000])
def test_the_budget_of_triangles_is_kept(budget):
    tree = TREES["bushy"]
    full, mesh = len(wood(tree).triangle), wood(tree, most_triangles=budget)
    assert full > budget >= len(mesh.triangle) > 0.3 * budget
    assert np.isfinite(mesh.position).all()


def test_below_any_budget_a_limb_has_a_dozen_triangles():
    tree = TREES["bushy"]
    assert len(wood(tree, most_triangles=12).triangle) <= 20 * len(np.unique(tree.limb))


def test_a_thin_and_crooked_limb_has_no_more_rings_than_points():
    rng = np.random.default_rng(0)
    points = np.cumsum(rng.normal(0, 0.1, (300, 3)) + [0, 0.02, 0], axis=0)
    tree = stick(points, 1e-6)
    assert len(wood(tree).triangle) <= 2 * 3 * (6 * len(points) + 30)


def test_mesh_and_material_are_called_wood():
    mesh = wood(TREES["stick"])
    assert mesh.name == "wood" and mesh.material.name == "wood_oak"


@pytest.mark.parametrize("points", [np.zeros((0, 3)), np.zeros((1, 3)), np.zeros((2, 3))], ids=["empty", "a point", "no length"])
def test_a_tree_without_wood_gives_an_empty_mesh(points):
    mesh = wood(stick(points, 0.1))
    assert len(mesh.triangle) == 0 and mesh.position.shape == (0, 3)


def test_a_flat_stem_that_hardly_rises_is_meshed():
    assert len(wood(stick([(0, 0, 0), (3, 0, 0)], 0.1)).triangle)


def test_young_limbs_have_a_skin_of_their_own_and_nothing_is_lost():
    tree = TREES["bushy"]
    whole, (bark, twigs) = wood(tree), wood_meshes(tree, bark="oak", habit=Habit(), key=KEY, wood="tubes")
    assert len(bark.triangle) + len(twigs.triangle) == len(whole.triangle)
    assert (twigs.name, twigs.material.name) == ("wood_twigs", "wood_oak_young")
    assert bark.name == "wood" and bark.material.name == "wood_oak"
    assert np.ptp(twigs.position[:, 1]) < np.ptp(bark.position[:, 1])


def palm():
    trunk = stick([(0, y, 0) for y in range(9)], 1.0, order=np.zeros(9, int))
    rows = {"parent": [7, 9, 7, 11, 8], "tip": [(1, 8, 0), (2, 8, 0), (-1, 8, 0), (-2, 8, 0), (0, 10, 0)]}
    fronds = trunk.append(rows | {"radius": np.ones(5), "order": [1, 1, 1, 1, 0], "limb": [1, 1, 2, 2, 0]})
    return PipeRadii(PALM)(fronds)


PALM = Habit(trunk_ratio=0.02, twig_radius=0.009, leaf_arrangement="frond")


def test_fronds_and_what_stands_above_the_last_of_them_are_green_midribs():
    meshes = wood_meshes(palm(), bark="palm", habit=PALM, key=KEY, wood="tubes")
    assert [mesh.name for mesh in meshes] == ["wood", "wood_rachis"]
    trunk, midribs = meshes
    assert midribs.material.name == "wood_rachis"
    assert trunk.position[:, 1].max() < 7.2 and midribs.position[:, 1].max() > 9.9
    green = midribs.material.base_color_texture.reshape(-1, 3).mean(axis=0)
    assert green[1] > green[0] > green[2]


def test_every_mesh_of_a_palm_is_closed():
    for mesh in wood_meshes(palm(), bark="palm", habit=PALM, key=KEY, wood="tubes"):
        triangle = welded(mesh)
        edge = np.concatenate([triangle[:, [0, 1]], triangle[:, [1, 2]], triangle[:, [2, 0]]])
        assert {tuple(pair) for pair in edge.tolist()} == {tuple(pair) for pair in edge[:, ::-1].tolist()}


def test_a_palm_without_fronds_is_all_trunk():
    tree = stick([(0, y, 0) for y in range(5)], 0.2)
    assert [mesh.name for mesh in wood_meshes(tree, bark="palm", habit=PALM, key=KEY, wood="tubes")] == ["wood"]


def test_a_tree_of_one_segment_is_one_tube():
    tree = stick([(0, 0, 0), (0, 1, 0)], 0.05)
    assert len(wood(tree).triangle) and len(wood_meshes(tree, bark="oak", habit=Habit(), key=KEY, wood="tubes")) == 1


def test_unknown_bark_is_named():
    with pytest.raises(OptionError, match="There is no bark called `teak`. Choose one of: oak, beech"):
        wood_mesh(TREES["stick"], bark="teak", key=KEY)


def test_detail_out_of_range_is_named():
    with pytest.raises(OptionError, match="`fewest_sides` is 2, outside 3 to 256. Choose `fewest_sides` in that range"):
        Detail(fewest_sides=2)
