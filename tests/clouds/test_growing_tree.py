"""A whole tree that grows toward points: it reaches them, as its species does, and beats plain space colonisation."""

import dataclasses
from functools import cache

import numpy as np
import pytest
from scanned import LENGTH, LIMBS, bark, feet
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.clouds.growing.box import SIDE, boxed
from sketchtree.clouds.growing.estimated import estimated
from sketchtree.clouds.growing.filled import filled
from sketchtree.clouds.growing.grown import grown
from sketchtree.clouds.growing.hull_fill import crown_of, hull_fill, unseen_inside
from sketchtree.clouds.growing.roots import roots_of
from sketchtree.clouds.growing.settled import settled
from sketchtree.clouds.growing.shedding import absorbed, buried
from sketchtree.clouds.growing.species import names, read_species, recipe_folder, species
from sketchtree.clouds.growing.wanted import Growing, plain
from sketchtree.clouds.tracing.traced import traced
from sketchtree.errors import OptionError, SketchError, TemplateError
from sketchtree.keys import root_key
from sketchtree.skeleton import Kind, TreeSkeleton

KEY = root_key(0)


@pytest.fixture(scope="module")
def points():
    return bark(spacing=0.04, noise=0.002)


@pytest.fixture(scope="module")
def kind(points):
    return estimated(points, species("broadleaf"))


@pytest.fixture(scope="module")
def result(points, kind):
    return grown(points, feet(points), kind, key=KEY)


def along(tree, step=0.01):
    """Places along a tree's axes."""
    share = np.linspace(0, 1, max(2, int(np.ceil(tree.length.max() / step))))
    return (tree.start[:, None] + share[None, :, None] * tree.vector[:, None]).reshape(-1, 3)


def distance(points, tree) -> float:
    """The mean distance from points to axes."""
    return float(cKDTree(along(tree)).query(points)[0].mean())


# the tree


def test_the_tree_comes_to_the_points_and_no_farther(points, result):
    assert distance(points, result.skeleton) < 0.09  # the bark of a stem of 0.12 m
    assert cKDTree(points).query(along(result.skeleton))[0].max() < 0.35
    assert (result.skeleton.kind == int(Kind.GROWN)).all()


def test_its_length_is_that_of_wood_and_not_of_a_bundle(result):
    assert result.skeleton.length.sum() == pytest.approx(LENGTH, rel=0.5)


def test_it_stands_on_its_foot_as_thick_as_the_stem(points, result):
    tree = result.skeleton
    assert (tree.parent == NULL).sum() == 1
    assert tree.tip[0] == pytest.approx([0.0, points[:, 1].min(), 0.0], abs=0.06)
    assert tree.radius[0] == pytest.approx(0.12, rel=0.1)


def test_the_same_key_grows_the_same_tree_and_another_key_another(points, kind, result):
    again, other = (grown(points, feet(points), kind, key=key).skeleton for key in (root_key(0), root_key(1)))
    assert np.array_equal(again.tip, result.skeleton.tip)
    assert again.tip.shape != other.tip.shape or not np.allclose(again.tip, other.tip)


def test_another_branching_angle_grows_another_tree(points, kind, result):
    other = grown(points, feet(points), dataclasses.replace(kind, branching=70.0), key=KEY).skeleton
    assert other.tip.shape != result.skeleton.tip.shape or not np.allclose(other.tip, result.skeleton.tip)


def test_a_cloud_of_any_size_grows_the_same_tree(points, kind, result):
    small = grown(points / 8 + [3.0, 1.0, 2.0], feet(points), kind, key=KEY).skeleton
    assert small.tip * 8 - [24.0, 8.0, 16.0] == pytest.approx(result.skeleton.tip, abs=1e-6)
    assert small.radius * 8 == pytest.approx(result.skeleton.radius)


def test_after_every_cycle_there_is_a_tree_and_it_grows(result):
    length = [result.at(cycle).length.sum() for cycle in (0, 5, 10, result.cycles)]
    assert length[0] == 0.0
    assert length[1] < length[2]
    young, old = result.at(8), result.skeleton
    assert young.radius[0] < 0.9 * old.radius[0]
    assert result.at(result.cycles + 99).length.sum() == pytest.approx(result.skeleton.length.sum())


def off_the_axes(tree) -> float:
    """How far grown axes lie from the true ones, and those from them."""
    share = np.linspace(0, 1, 60)[:, None]
    true = np.concatenate([a + share * (b - a) for line, _, _ in LIMBS for a, b in zip(line, line[1:], strict=False)])
    grew = along(tree)
    return float(cKDTree(grew).query(true)[0].mean() + cKDTree(true).query(grew)[0].mean())


@pytest.mark.parametrize("internodes", [5.0, 10.0])
def test_plain_space_colonisation_is_farther_off(points, kind, result, internodes):
    other = grown(points, feet(points), kind, key=KEY, wanted=plain(internodes))
    assert off_the_axes(result.skeleton) < 0.8 * off_the_axes(other.skeleton)


def test_several_roots_compete_and_each_grows_what_is_its_own(kind):
    one = bark(spacing=0.06)
    both = np.concatenate([one, one + [2.5, 0.0, 0.0]])
    tree = grown(both, [feet(one)[0], feet(one)[0] + len(one)], kind, key=KEY).skeleton
    assert set(tree.tree) == {0, 1}
    assert tree.tip[tree.tree == 0, 0].max() < 1.6
    assert tree.tip[tree.tree == 1, 0].min() > 0.9


def test_a_gap_is_crossed_where_nothing_else_is_left(points, kind):
    holed = points[~((points[:, 1] > 1.0) & (points[:, 1] < 1.5))]
    wanted = Growing()
    assert grown(holed, feet(holed), kind, key=KEY, wanted=wanted).skeleton.height > 3.5
    assert grown(holed, feet(holed), kind, key=KEY, wanted=dataclasses.replace(wanted, persists=False)).skeleton.height < 1.5


# its parts


def test_the_box_is_ten_metres_and_leads_back(points):
    box = boxed(points)
    inside = box.to_sketch(points)
    assert np.ptp(inside, axis=0).max() == pytest.approx(SIDE)
    assert inside[:, 1].min() == pytest.approx(0.0)
    assert box.to_world(inside) == pytest.approx(points)


def test_points_all_at_one_place_are_refused():
    with pytest.raises(SketchError) as refused:
        boxed(np.ones((3, 3)))
    assert str(refused.value) == "All points of the cloud lie at one place. Give a cloud of a whole plant."


def test_a_root_is_the_middle_of_its_foot_with_the_stems_radius(points):
    roots = roots_of(points, feet(points))
    assert roots.radius[0] == pytest.approx(0.12, rel=0.08)
    assert roots_of(points, feet(points), np.array([0.2])).radius[0] == 0.2


def stem_with(*branch):
    """A thick stem of 40 nodes and a branch from its node 10."""
    stem = np.stack([np.zeros(40), 0.05 * np.arange(40), np.zeros(40)], axis=1)
    return np.r_[NULL, np.arange(39), 10, np.arange(40, 39 + len(branch))], np.concatenate([stem, np.array(branch, float)])


def test_a_branch_that_never_leaves_the_bark_is_shed_and_one_that_does_stays():
    root = np.full(44, 0.2)
    parent, place = stem_with([0.1, 0.5, 0], [0.1, 0.55, 0], [0.1, 0.6, 0], [0.1, 0.65, 0])
    assert list(np.flatnonzero(buried(parent, place, root, 0.45, np.zeros(44, bool)))) == [40, 41, 42, 43]
    parent, place = stem_with([0.1, 0.5, 0], [0.2, 0.55, 0], [0.4, 0.6, 0], [0.6, 0.65, 0])
    assert not buried(parent, place, root, 0.45, np.zeros(44, bool)).any()


def test_a_branch_that_grew_of_late_is_spared():
    parent, place = stem_with([0.1, 0.5, 0], [0.1, 0.55, 0])
    assert not buried(parent, place, np.full(42, 0.2), 0.45, np.arange(42) == 41).any()


def test_what_runs_within_a_stem_is_taken_into_it_and_what_it_bears_hangs_there():
    parent, place = stem_with([0.1, 0.5, 0], [0.1, 0.6, 0], [0.1, 0.7, 0], [0.1, 0.8, 0], [0.4, 0.95, 0], [0.6, 1.1, 0])
    above, left = absorbed(parent, place, np.array([0.2]), 0.45)
    assert len(left) == 42
    assert (above == NULL).sum() == 1
    out = int(np.flatnonzero(np.isclose(left[:, 0], 0.4))[0])
    assert left[above[out], 0] == 0.0
    assert 0.3 < left[above[out], 1] < 0.85


def test_thin_wood_settles_among_its_points_and_the_root_stays():
    points = np.stack([np.full(200, 0.05), np.linspace(0, 2, 200), np.zeros(200)], axis=1)
    place = np.stack([np.zeros(21), np.linspace(0, 2, 21), np.zeros(21)], axis=1)
    moved = settled(np.arange(21) - 1, place, np.full(21, 0.01), points, 0.2)
    assert moved[5:, 0] == pytest.approx(np.full(16, 0.05), abs=0.01)
    assert moved[0] == pytest.approx(place[0])


def test_wood_settles_as_smooth_as_it_grew():
    rng = np.random.default_rng(0)
    points = np.stack([rng.normal(0, 0.03, 300), np.linspace(0, 3, 300), rng.normal(0, 0.03, 300)], axis=1)
    place = np.stack([np.zeros(61), np.linspace(0, 3, 61), np.zeros(61)], axis=1)
    moved = settled(np.arange(61) - 1, place, np.full(61, 0.01), points, 0.2)
    way = np.diff(moved, axis=0)
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    assert np.degrees(np.arccos(np.clip((way[1:] * way[:-1]).sum(axis=1), -1, 1))).max() < 15


# the unseen inside


def ball(count=1500, depth=0.05):
    rng = np.random.default_rng(0)
    way = rng.normal(size=(count, 3))
    return np.array([0.0, 3.0, 0.0]) + (1.0 - depth * rng.uniform(size=(count, 1))) * way / np.linalg.norm(way, axis=1, keepdims=True)


def test_points_of_the_inside_keep_their_distance_lie_within_the_hull_and_leave_no_hole():
    places = hull_fill(ball(), 0.2, key=KEY)
    assert cKDTree(places).query(places, k=2)[0][:, 1].min() >= 0.2
    assert np.linalg.norm(places - [0, 3, 0], axis=1).max() <= 1.0
    rng = np.random.default_rng(1)
    asked = rng.uniform(-0.5, 0.5, (2000, 3)) + [0, 3, 0]
    assert np.quantile(cKDTree(places).query(asked)[0], 0.99) < 0.25


def test_points_of_the_inside_stay_clear_of_what_was_seen():
    places = hull_fill(ball(), 0.2, key=KEY, clear=0.3)
    assert cKDTree(ball()).query(places)[0].min() > 0.3


def test_points_that_enclose_nothing_are_refused():
    with pytest.raises(SketchError) as refused:
        hull_fill(np.zeros((8, 3)) + np.arange(8)[:, None], 0.1, key=KEY)
    assert str(refused.value) == "The crown's points enclose no space. Give a cloud of a whole crown, or grow without filling its inside."


@cache
def lollipop():
    """A bare stem with a ball of which only the outside was seen."""
    stem = bark(spacing=0.06)
    stem = stem[(stem[:, 1] < 1.9) & (np.abs(stem[:, 0]) < 0.3)]
    return np.concatenate([stem, ball()])


def test_a_crown_of_leaves_hides_its_inside_and_a_bare_tree_does_not(points):
    assert unseen_inside(lollipop())
    assert not unseen_inside(points)
    assert crown_of(lollipop())[:, 1].min() > 1.8


def test_what_encloses_nothing_has_no_inside():
    flat = np.c_[np.random.default_rng(0).uniform(size=(200, 2)), np.zeros(200)]
    assert not unseen_inside(flat)


def inner(tree) -> float:
    """Metres of wood well within the ball."""
    return tree.length[np.linalg.norm(tree.tip - [0, 3, 0], axis=1) < 0.7].sum()


def test_branches_fill_a_crown_of_which_only_leaves_were_seen(kind):
    cloud, kind = lollipop(), dataclasses.replace(kind, internode=0.2)
    bare, full = (grown(cloud, feet(cloud), kind, key=KEY, wanted=Growing(fill=fill)).skeleton for fill in (False, None))
    assert inner(full) > 2 * inner(bare)


def test_a_traced_tree_is_filled_too_and_keeps_its_own_rows(kind):
    cloud, kind = lollipop(), dataclasses.replace(kind, internode=0.2)
    tree = traced(cloud, feet(cloud)).skeleton
    full = filled(tree, cloud, kind, key=KEY)
    assert np.array_equal(full.tip[: len(tree)], tree.tip)
    assert np.array_equal(full.radius[: len(tree)], tree.radius)
    new = np.arange(len(full)) >= len(tree)
    assert (full.kind[new] == int(Kind.GROWN)).all()
    assert not np.intersect1d(full.limb[new], tree.limb).size
    assert (full.radius[new] <= full.radius[full.parent[new]] + 1e-12).all()
    assert inner(full) > inner(tree)


# species


def test_table_2_gives_six_species():
    table = {"pentagon_maple": (0.050, 120, 38, 0.45), "peach": (0.038, 97, 37, 0.50), "laurel": (0.051, 95, 35, 0.43)}
    table |= {"maple": (0.049, 130, 34, 0.42), "prunus_triloba": (0.052, 87, 41, 0.43), "cercis": (0.051, 100, 38, 0.41)}
    for name, figures in table.items():
        one = species(name)
        assert (one.internode, one.roll, one.branching, one.gamma) == figures
    assert set(names()) == set(table) | {"broadleaf"}


def test_an_unknown_species_is_refused_by_name():
    with pytest.raises(OptionError) as refused:
        species("oak_of_mars")
    known = "broadleaf, cercis, laurel, maple, peach, pentagon_maple, prunus_triloba"
    assert str(refused.value) == f"No species 'oak_of_mars' is known for growth toward points. Choose one of: {known}; or give a recipe of your own, a .toml file."


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("roll = 97", "rolls = 97"), "Recipe mine.toml: `rolls` is not known. Leave it out; known are: name, title, source, internode, roll, branching, gamma, growing."),
        (("roll = 97", "roll = 970"), "Recipe mine.toml: `roll` is 970. Give a number from 0 to 360."),
        (('title = "Peach"', "title = 3"), "Recipe mine.toml: `title` is 3. Give a text."),
        (('title = "Peach"\n', ""), "Recipe mine.toml: `title` is missing. Add it."),
    ],
)
def test_a_recipe_at_fault_is_refused_by_key(tmp_path, change, message):
    text = (recipe_folder() / "peach.toml").read_text(encoding="utf-8")
    (tmp_path / "mine.toml").write_text(text.replace(*change), encoding="utf-8")
    with pytest.raises(TemplateError) as refused:
        read_species(tmp_path / "mine.toml")
    assert str(refused.value) == message


def test_a_file_that_is_no_recipe_is_refused(tmp_path):
    (tmp_path / "mine.toml").write_text("= 3", encoding="utf-8")
    with pytest.raises(TemplateError, match=r"^Recipe mine\.toml: it can't be read \(.*\)\. Give a readable TOML file\.$"):
        read_species(tmp_path / "mine.toml")


def test_the_internode_follows_from_how_far_points_lie_apart(points):
    box = SIDE / np.ptp(points, axis=0).max()
    apart = float(np.median(cKDTree(points).query(points, k=2)[0][:, 1]))
    assert estimated(points, species("peach")).internode == pytest.approx(np.clip(1.5 * apart * box, 0.04, 0.1), rel=0.05)


def test_angles_are_those_of_a_traced_tree():
    parent, tip, limb = [NULL, *range(30)], [[0.0, 0.1 * k, 0.0] for k in range(31)], [0] * 31
    for k, node in enumerate(range(3, 28, 2)):
        turn, lean = np.radians(100.0 * k), np.radians(50.0)
        way = np.array([np.sin(lean) * np.cos(turn), np.cos(lean), np.sin(lean) * np.sin(turn)])
        parent.append(node)
        tip.append(list(np.array(tip[node]) + way))
        limb.append(k + 1)
    tree = TreeSkeleton.from_columns(np.array(parent), np.array(tip), np.full(len(parent), 0.01), limb=np.array(limb))
    found = estimated(np.array(tip), species("peach"), tree, gamma=0.47)
    assert found.branching == pytest.approx(50.0)
    assert found.roll == pytest.approx(100.0)
    assert found.gamma == 0.47
    assert species("peach").roll == 97.0
