"""Which points are leaves, and what follows for the tree."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path[:0] = [str(Path(__file__).parents[1]), str(Path(__file__).parent)]
from in_leaf import OUTER, REACH, in_leaf, leaves
from scanned import LENGTH, bark, feet
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.cloud_report import cloud_report
from sketchtree.cloud_tree import CloudOptions, cloud_to_tree
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.leafy.borne import borne, passing
from sketchtree.clouds.leafy.covering import Covering, leaf_area_of
from sketchtree.clouds.leafy.green import excess, green_odds
from sketchtree.clouds.leafy.leafiness import leafiness, leaves_among, left_out, off_bark
from sketchtree.clouds.leafy.shown import cubes, pixel_of, shown, spots, spots_of
from sketchtree.clouds.leafy.turning import filling, turning
from sketchtree.clouds.tracing.traced import traced
from sketchtree.clouds.tracing.ways import Ways
from sketchtree.dressing import Dress
from sketchtree.errors import OptionError
from sketchtree.fidelity.sampled import over
from sketchtree.foliage.cards import leaf_mesh
from sketchtree.foliage.leaves import select
from sketchtree.foliage.populate import populate
from sketchtree.keys import root_key
from sketchtree.options import TreeOptions
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.traverse import is_tip

KEY = root_key(0)
LEAFY = TreeOptions(leaf="apple", wood="tubes")


def told(points, **how):
    return leafiness(points, feet(points), **how)


@pytest.fixture(scope="module")
def scan():
    return in_leaf()


@pytest.fixture(scope="module")
def tree(scan):
    return cloud_to_tree(PointCloud(scan[0]), key=KEY, tree=LEAFY, wanted=CloudOptions(up="y", inside=False))


def test_of_a_scan_in_leaf_the_leaves_are_told_from_the_wood(scan):
    points, leaf = scan
    found = told(points)
    assert found.in_leaf
    assert np.mean(leaf[found.leaf]) > 0.97  # precision
    assert np.mean(found.leaf[leaf]) > 0.85  # recall
    assert found.share == pytest.approx(leaf.mean(), abs=0.12)


def test_a_bare_scan_has_none():
    points = bark(0.03, noise=0.002)
    found = told(points)
    assert not found.in_leaf and found.share == 0.0 and found.remark is None
    assert not found.area.any()


def test_and_a_person_may_say_otherwise(scan):
    assert told(bark(0.03), wanted="yes").in_leaf
    assert not told(scan[0], wanted="no").leaf.any()
    with pytest.raises(OptionError) as caught:
        CloudOptions(in_leaf="maybe")
    assert str(caught.value) == "Whether a plant is in leaf can't be 'maybe'. Choose one of: auto, yes, no."


def test_what_hangs_on_a_point_is_how_many_ways_lead_through_it():
    way = Ways(np.array([NULL, 0, 1, 1, 3]), np.array([0.0, 1, 1, 1, 1]), np.zeros(5, int))
    assert passing(way).tolist() == [5, 4, 1, 2, 1]
    assert borne(np.arange(15.0).reshape(5, 3), way) == pytest.approx(np.log(13 / 5))


def test_normals_of_bark_lie_in_a_plane_and_those_of_leaves_in_none():
    wood = bark(0.03)
    assert np.median(turning(wood)) < 0.01
    assert np.median(turning(leaves())) > 0.04


def test_lines_surfaces_and_bodies_fill_space_by_one_two_and_three():
    chance = np.random.default_rng(0)
    line, sheet, body = (np.pad(chance.uniform(size=(4000, k)), ((0, 0), (0, 3 - k))) for k in (1, 2, 3))
    assert [round(float(np.median(filling(one, one)))) for one in (line, sheet, body)] == [1, 2, 3]


def test_the_excess_of_green_is_2g_r_b_over_their_sum():
    assert excess(np.array([[0.2, 0.6, 0.2], [0.3, 0.3, 0.3], [0.0, 0.0, 0.0]])) == pytest.approx([0.8, 0.0, 0.0])


def test_colour_tells_where_wood_is_less_green_than_what_it_bears():
    brown, green = [0.4, 0.3, 0.2], [0.2, 0.4, 0.15]
    wood = np.arange(10) < 4
    assert green_odds(np.where(wood[:, None], brown, green), wood, ~wood) == pytest.approx(np.where(wood, -1, 1))
    assert green_odds(np.tile(green, (10, 1)), wood, ~wood) is None  # a herb
    assert green_odds(np.where(wood[:, None], green, brown), wood, ~wood) is None
    assert green_odds(None, wood, ~wood) is None


def test_a_plant_whose_leaves_are_green_is_in_leaf(scan):
    points, leaf = np.concatenate([bark(0.03), scan[0][scan[1]]]), np.repeat([False, True], [len(bark(0.03)), scan[1].sum()])
    some = ~leaf | (np.arange(len(points)) % 2 == 0)
    colour = np.where(leaf[:, None], [0.25, 0.5, 0.15], [0.4, 0.33, 0.28])
    assert not told(points[some]).in_leaf
    found = told(points[some], colour=colour[some])
    assert found.in_leaf and found.green
    assert np.mean(leaf[some][found.leaf]) > 0.98


def test_leaves_that_are_sure_are_some_of_those_that_are_no_wood(scan):
    points, leaf = scan
    found = told(points)
    assert not (found.sure & ~found.leaf).any()
    assert 0.3 < found.sure.sum() / found.leaf.sum() < 1
    assert leaf[found.sure].mean() >= leaf[found.leaf].mean()


@pytest.mark.parametrize("share", [0.1, 0.4, 0.8])
def test_the_share_of_leaves_that_explains_the_odds_is_the_true_one(share):
    """Normal odds of two kinds: of leaves about 2, of wood about −2, with variance 4, which are the log odds of themselves."""
    chance = np.random.default_rng(0)
    odds = np.where(chance.random(20_000) < share, 2.0, -2.0) + 2.0 * chance.normal(size=20_000)
    assert leaves_among(odds) == pytest.approx(share, abs=0.02)


def test_leaves_become_hardly_any_wood(tree):
    assert 0.75 * LENGTH < tree.skeleton.length[: tree.seen].sum() < 3 * LENGTH
    assert (tree.skeleton.kind[: tree.seen] == int(Kind.OBSERVED)).all() and (tree.skeleton.kind[tree.seen :] == int(Kind.GROWN)).all()


def test_though_all_points_are_wood_where_a_person_says_so(scan):
    points, _ = scan
    assert traced(points, feet(points)).skeleton.length.sum() > 10 * LENGTH


def test_twigs_grow_to_where_leaves_were_seen(tree):
    new = tree.skeleton.tip[tree.seen :]
    assert len(new) > 20
    assert cKDTree(OUTER).query(new)[0].max() < REACH + 0.25


@pytest.mark.parametrize(("share", "points"), [(1.0, 8), (0.1, 8), (0.3, 30)])
def test_as_many_leaves_are_worn_as_there_were_however_few_and_however_densely_scanned(tree, share, points):
    dress, other = Dress("apple", "apple", "summer", tree.model.dress.habit), root_key(7)
    grew = populate(tree.skeleton, dress.habit, key=other, model="apple")
    grew = select(grew, np.random.default_rng(0).random(len(grew)) < share)
    scanned = over([leaf_mesh(replace(grew, shoot=grew.shoot[:0]))], points * len(grew), key=other)
    worn, _ = Covering(scanned)(tree.skeleton, dress, KEY)
    assert leaf_area_of(worn).sum() == pytest.approx(leaf_area_of(grew).sum(), rel=0.25)


def test_and_where_they_say_so_bare_boughs_stay_bare(tree):
    assert cKDTree(OUTER).query(tree.model.leaves.position)[0].max() < REACH + 0.3


def test_leaves_stand_at_tips_and_on_young_wood_never_on_what_is_thick(tree):
    skeleton, on = tree.skeleton, np.unique(tree.model.leaves.segment)
    assert skeleton.radius[on].max() <= 8 * tree.model.dress.habit.twig_radius
    assert np.isin(on, np.flatnonzero(is_tip(skeleton.parent))).mean() > 0.2
    assert (skeleton.order[on] > 0).mean() > 0.9


def test_how_they_stand_how_long_they_are_and_at_which_angle_is_the_species(tree):
    habit = tree.model.dress.habit
    lilac, willow = (tree.finish.leafing(tree.skeleton, Dress("apple", name, habit=habit), KEY)[0] for name in ("lilac", "willow"))
    assert lilac.model == "lilac" and willow.model == "willow"
    assert np.median(willow.direction[:, 1]) < np.median(lilac.direction[:, 1]) - 0.2  # a willow's hang
    assert np.median(willow.size) > np.median(lilac.size)


def test_where_no_leaf_is_named_none_is_worn_and_auto_names_the_template_s(tree):
    def worn(leaf, leafing):
        return replace(tree.finish, tree=TreeOptions(leaf=leaf, wood="tubes"), leafing=leafing)(tree.skeleton)[0].leaves

    assert len(worn(None, tree.finish.leafing)) == 0
    assert len(worn("auto", tree.finish.leafing)) > 100
    assert len(worn("auto", None)) == 0  # of a bare scan


def test_points_on_the_bark_of_a_limb_are_no_leaves(tree):
    xyz = tree.prepared.cloud.xyz
    low = xyz[:, 1] < 1.5
    found = off_bark(replace(tree.leafy, leaf=np.ones(len(xyz), bool)), xyz, tree.skeleton)
    assert found.leaf[low].mean() < 0.1 and found.leaf.mean() > 0.6


def test_a_person_is_told_and_the_report_says_it(scan, tree):
    share = round(100 * tree.leafy.share)
    assert tree.warnings[0] == f"About {share} % of the points are leaves; they are no wood."
    block = cloud_report(tree, command="cloud", seed=0, seconds={}, options={})["cloud"]["leaves"]
    assert block["in_leaf"] and block["share"] == pytest.approx(tree.leafy.share) and not block["green"]


def test_the_same_key_puts_the_same_leaves(tree):
    again = Covering(np.array(tree.finish.leafing.place))
    dress = Dress("apple", "apple", "summer", tree.model.dress.habit)
    one, other = (how(tree.skeleton, dress, KEY)[0] for how in (tree.finish.leafing, again))
    assert len(one) and (one.position == other.position).all()


def test_a_covering_without_a_leaf_makes_none(tree):
    assert len(tree.finish.leafing(tree.skeleton, Dress("apple", None), KEY)[0]) == 0


def test_wood_that_lies_in_its_points_leaves_none_of_them_out():
    """A stem of 2 m; traced as it is, twice as low, and six times as thick, so that its points lie inside."""
    turn, high = np.random.default_rng(0).uniform(0, [[2 * np.pi], [2.0]], (2, 400))
    points = np.stack([0.05 * np.cos(turn), high, 0.05 * np.sin(turn)], axis=1)
    whole, half, fat = (
        TreeSkeleton.from_columns(np.array([NULL, 0, 1]), np.array([[0, 0, 0], [0, top / 2, 0], [0, top, 0]], float), np.full(3, radius))
        for top, radius in ((2.0, 0.05), (1.0, 0.05), (2.0, 0.3))
    )
    assert left_out(points, whole) == 0
    assert left_out(points, half) == pytest.approx(0.47, abs=0.05)
    assert left_out(points, fat) == 1


@pytest.mark.parametrize("model", ["apple", "ash", "pine"])
def test_spots_lie_on_what_is_drawn_of_a_leaf(model):
    place = spots_of(model)
    assert len(place) == 10 and len(np.unique(place, axis=0)) == 10
    assert np.abs(place).max() < 2.0 and place[:, 1].min() > -0.05


def test_a_leaf_before_another_hides_it():
    """A wall of four sides and the floor under it, round a spot; and the same with a gap."""
    side = np.stack(np.meshgrid(np.linspace(-1, 1, 60), np.linspace(-1, 1, 60)), axis=-1).reshape(-1, 2)
    wall = np.concatenate([np.insert(side, axis, at, axis=1) for axis in (0, 1, 2) for at in (-1.0, 1.0)])
    middle = np.zeros((1, 3))
    assert not shown(np.concatenate([middle, wall]), 0.08)[0]
    assert shown(np.concatenate([middle, wall[wall[:, 2] < 0.9]]), 0.08)[0]
    assert shown(wall, 0.08).mean() > 0.6


def test_a_spot_stands_for_a_tenth_of_what_is_drawn(tree):
    leaves = tree.model.leaves
    assert 10 * pixel_of(leaves) ** 2 == pytest.approx(leaf_area_of(leaves).mean())
    assert spots(leaves).shape == (len(leaves), 10, 3)
    assert np.linalg.norm(spots(leaves) - leaves.position[:, None], axis=2).max() < 2 * leaves.size.max()


def test_points_are_counted_by_the_cubes_that_hold_some():
    assert len(cubes(np.array([[0.1, 0.1, 0.1], [0.9, 0.9, 0.9], [1.1, 0.0, 0.0], [-0.1, 0.0, 0.0]]), 1.0)) == 3
