"""Where on the tree each vertex is."""

import numpy as np
import pytest

from sketchtree.axes import NULL
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import centre_lines
from sketchtree.geometry.wood import wood_meshes
from sketchtree.parameters import Habit
from sketchtree.rig.boughs import boughs, limb_of_row
from sketchtree.rig.islands import mesh_places, welded
from sketchtree.rig.place import Places, along, places_on, wood_places
from sketchtree.skeleton import TreeSkeleton
from tests.geometry.growing import bushy, fork, stick
from tests.rig.rigged_trees import KEY, dressed, edges


def test_every_vertex_lies_on_the_skin_of_the_limb_that_it_is_placed_on():
    _, lines, _, _, wood, _ = dressed()
    place = wood_places(lines, wood.position)
    point, radius = lines.at(place.limb, place.s)
    away = np.linalg.norm(wood.position - point, axis=1)
    high = wood.position[:, 1] > 0.5  # above the flare
    assert np.quantile(away[high] / radius[high], 0.999) < 1.6
    assert np.median(away[high] / radius[high]) == pytest.approx(1.0, abs=0.02)


def test_the_limb_is_the_one_inside_whose_wood_a_point_lies_deepest():
    """By brute force over fine samples of all limbs."""
    _, lines, _, _, wood, _ = dressed()
    some = wood.position[::37]
    s = [np.linspace(0, length, int(length / 0.002) + 2) for length in lines.length]
    limb = np.repeat(np.arange(len(lines)), [len(part) for part in s])
    point, radius = lines.at(limb, np.concatenate(s))
    power = ((some[:, None] - point) ** 2).sum(axis=2) - radius**2
    found = wood_places(lines, some)
    at, there = lines.at(found.limb, found.s)
    assert np.all(((some - at) ** 2).sum(axis=1) - there**2 <= power.min(axis=1) + 0.01 * there**2)


def test_a_thin_twig_near_thick_wood_does_not_take_its_vertices():
    """The twig's line passes 1 cm above the skin of a trunk 20 cm thick, as near to many of its vertices as the trunk's is not."""
    tree = TreeSkeleton.from_columns(
        np.array([-1, 0, 1, 1, 3]), np.array([[0.0, 0, 0], [0, 1, 0], [0, 2, 0], [0.5, 1.0, 0], [0.21, 1.6, 0]]), np.array([0.2, 0.2, 0.2, 0.005, 0.004]), limb=np.array([1, 1, 1, 2, 2])
    )
    lines = centre_lines(tree)
    skin = np.array([[0.2 * np.cos(turn), height, 0.2 * np.sin(turn)] for turn in np.linspace(0, 6.2, 40) for height in np.linspace(0.2, 1.9, 30)])
    place = wood_places(lines, skin)
    near_foot = np.linalg.norm(skin - [0.2, 1.0, 0], axis=1) < 0.05
    assert set(place.limb[~near_foot].tolist()) == {0}


@pytest.mark.parametrize("angle", [20.0, 50.0, 90.0])
def test_a_childs_vertices_go_to_the_parent_only_inside_its_wood(angle):
    tree = fork(angle, 0.6)
    lines = centre_lines(tree)
    s = np.linspace(0, lines.length[1], 60)
    point, radius = lines.at(np.ones(60, int), s)
    side = np.cross(point[-1] - point[0], [0.0, 1, 0])
    side /= np.linalg.norm(side)
    skin = point + radius[:, None] * side
    place = wood_places(lines, skin)
    at, thick = lines.at(np.zeros(60, int), places_on(lines, np.zeros(60, int), skin).s)
    inside = np.linalg.norm(skin - at, axis=1) < 0.98 * thick
    assert np.all(place.limb[inside] == 0) and np.all(place.limb[s > 0.35] == 1)
    assert np.all(np.diff((place.limb == 1).astype(int)) >= 0)  # to the child once, and never back


def test_the_same_position_has_the_same_place():
    _, lines, limbs, _, wood, _ = dressed()
    place = mesh_places(lines, limbs, wood)
    one = welded(wood.position)
    assert np.any(one != np.arange(len(one)))  # there are seams
    assert np.array_equal(place.limb, place.limb[one]) and np.array_equal(place.s, place.s[one])


def test_no_island_of_a_passing_limb_is_left_on_a_surface():
    """A limb of another bough runs right through a third one."""
    tree = TreeSkeleton.from_columns(
        np.array([-1, 0, 1, 2, 1, 4, 5, 6]),
        np.array([[0.0, 0, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0], [1.2, 1.2, 0], [1.2, 1.8, 0.0], [1.2, 2.2, 0], [1.2, 2.6, 0]]),
        np.array([0.1, 0.1, 0.08, 0.05, 0.03, 0.03, 0.03, 0.02]),
        limb=np.array([1, 1, 1, 1, 2, 2, 2, 2]),
    ).append({"parent": [2, 8, 9], "tip": np.array([[0.6, 2.0, 0], [1.2, 2.0, 0], [2.0, 2.0, 0]]), "radius": np.array([0.05, 0.05, 0.05]), "limb": np.array([3, 3, 3])})
    lines, (wood, *_) = centre_lines(tree), wood_meshes(tree, bark="oak", habit=Habit(), key=KEY, detail=Detail(longest=0.005), wood="tubes")
    limbs = boughs(tree, lines)
    raw, mended = wood_places(lines, wood.position), mesh_places(lines, limbs, wood)
    foreign = lambda place: {tuple(sorted(pair)) for pair in place.limb[edges(wood)].tolist()} & {(1, 2)}  # noqa: E731
    assert foreign(raw) == {(1, 2)} and foreign(mended) == set()
    moved = raw.limb != mended.limb
    assert 0 < moved.sum() < 0.1 * len(moved)


def test_what_is_known_along_lines_is_interpolated():
    lines = centre_lines(stick([[0, 0, 0], [0, 1, 0], [0, 2, 0]], 0.1))
    found = along(lines, lines.point, Places(np.zeros(3, int), np.array([-5.0, lines.ground[0] + 0.5, 99.0])))
    assert np.allclose(found, [lines.point[0], [0, 0.5, 0], [0, 2, 0]])


def test_places_on_a_limb_are_the_nearest_there():
    _, lines, _, _, _, _ = dressed()
    rng = np.random.default_rng(1)
    limb = rng.integers(0, len(lines), 200)
    point = lines.at(limb, rng.uniform(0, 1, 200) * lines.length[limb])[0] + rng.normal(0, 0.05, (200, 3))
    found = places_on(lines, limb, point)
    away = np.linalg.norm(point - lines.at(limb, found.s)[0], axis=1)
    for share in np.linspace(0, 1, 101):
        assert np.all(away <= np.linalg.norm(point - lines.at(limb, share * lines.length[limb])[0], axis=1) + 0.01)


def test_every_row_is_part_of_one_limb_and_its_tip_lies_on_it():
    tree = bushy(levels=2)
    lines = centre_lines(tree)
    limb = limb_of_row(tree, lines)
    assert np.all(limb != NULL)
    found = places_on(lines, limb, tree.tip)
    assert np.allclose(lines.at(limb, found.s)[0], tree.tip, atol=1e-9)


def test_boughs_are_limbs_on_stems_with_all_that_grows_on_them():
    tree, lines, limbs, _, _, _ = dressed()
    own = lines.limb_id
    assert limbs.bough[own == 1].tolist() == [NULL] and limbs.is_stem[own == 1].all()
    for k in range(5):
        twigs = np.isin(own, [1000 + 10 * k + i for i in range(3)])
        assert set(own[limbs.bough[twigs]].tolist()) == {100 + k} and limbs.bough[own == 100 + k] == np.flatnonzero(own == 100 + k)
    assert np.all(limbs.carried[lines.parent[1:]] > limbs.carried[1:])


@pytest.mark.parametrize(("angle", "expected"), [(90.0, 0.1), (45.0, 0.1 * np.sqrt(2)), (30.0, 0.2)])
def test_what_is_buried_is_what_lies_inside_the_parent(angle, expected):
    """A straight limb at an angle α leaves a trunk of radius R after R / sin α; ours start a little more steeply."""
    limbs = boughs(fork(angle, 0.3), centre_lines(fork(angle, 0.3)))
    assert limbs.buried[1] == pytest.approx(expected, rel=0.35) and limbs.buried[0] == 0.0


def test_no_wood_has_no_places():
    lines = centre_lines(TreeSkeleton.from_columns(np.array([-1]), np.zeros((1, 3)), np.array([0.1])))
    assert wood_places(lines, np.zeros((2, 3))).limb.tolist() == [NULL, NULL]
