"""From points as they were read to one tree at the origin, y up; all that is done is said."""

import numpy as np
import pytest
from scenes import box, buttressed, floor, limb, lying, tree, weeping, wide_in_leaf

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.placed import Placed, Placement
from sketchtree.clouds.prepared.doubled import single_rows
from sketchtree.clouds.prepared.finite import finite
from sketchtree.clouds.prepared.ground import ground
from sketchtree.clouds.prepared.outliers import height_without, outliers
from sketchtree.clouds.prepared.pot import pot
from sketchtree.clouds.prepared.prepare import prepare
from sketchtree.clouds.prepared.several import plants
from sketchtree.clouds.prepared.up_axis import up_chances, upright
from sketchtree.clouds.standing.stems import stems
from sketchtree.errors import OptionError, SketchError

TREE = tree()
TURNS = np.radians([0, 40, 90, 200])


def turned(xyz, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.c_[c * xyz[:, 0] + s * xyz[:, 2], xyz[:, 1], c * xyz[:, 2] - s * xyz[:, 0]]


# which axis is up


@pytest.mark.parametrize("angle", TURNS)
def test_up_is_told_by_the_trunk(angle):
    assert up_chances(turned(TREE, angle)) > 0.9
    assert up_chances(lying(turned(TREE, angle))) < 0.1


@pytest.mark.parametrize("angle", TURNS)
def test_up_is_told_by_the_foot_of_a_wide_tree_in_leaf_whose_trunk_has_few_points(angle):
    leafy = turned(wide_in_leaf(), angle)
    assert up_chances(leafy) > 0.9
    assert up_chances(lying(leafy)) < 0.1


@pytest.mark.parametrize("slope", [0.0, 0.3])
def test_up_is_told_by_the_ground(slope):
    scene = np.concatenate([TREE, floor(slope=slope)])
    assert up_chances(scene) > 0.9
    assert up_chances(lying(scene)) < 0.1


def test_turning_keeps_the_hand_and_the_normals():
    cloud = PointCloud(lying(TREE), normal=np.tile([0.0, 0.0, 1.0], (len(TREE), 1)))
    found = upright(cloud)
    np.testing.assert_array_equal(found.cloud.xyz, TREE)
    np.testing.assert_array_equal(found.cloud.normal[0], [0, 1, 0])
    assert (found.axis, found.remark) == ("z", None)


def test_what_is_said_of_up_goes_before_what_is_seen():
    assert upright(PointCloud(TREE), "z").axis == "z"
    assert upright(PointCloud(TREE), "auto", "z").axis == "z"
    assert upright(PointCloud(TREE), "y", "z").axis == "y"


def test_where_up_is_hard_to_say_it_is_z_and_that_is_said():
    ball = np.random.default_rng(0).normal(size=(1000, 3))
    found = upright(PointCloud(np.concatenate([ball, lying(ball), lying(lying(ball)), lying(lying(lying(ball)))])))
    assert found.axis == "z"
    assert found.remark == "Which axis of the cloud is up is hard to say; z was taken. If the tree lies down, say which with `--up y` or `--up z`."


def test_another_axis_is_refused():
    with pytest.raises(OptionError, match=r"`up` is 'x'\. Say auto, y or z\."):
        upright(PointCloud(TREE), "x")


# ground


@pytest.mark.parametrize("slope", [0.0, 0.2, 0.5])
def test_ground_is_taken_away_and_the_tree_is_left(slope):
    soil = floor(slope=slope)
    found = ground(np.concatenate([TREE, soil]))
    assert found.is_ground[len(TREE) :].mean() > 0.97
    assert found.is_ground[: len(TREE)].mean() < 0.02
    assert np.tan(found.slope) == pytest.approx(slope, abs=0.03)


@pytest.mark.parametrize("angle", TURNS)
def test_a_crown_has_no_ground(angle):
    assert ground(turned(TREE, angle)) is None
    assert ground(lying(turned(TREE, angle))) is None


def test_heights_are_above_the_ground_under_each_point():
    soil = floor(slope=0.3)
    found = ground(np.concatenate([TREE + [2.0, 0.6, 0.0], soil]))
    trunk = np.linalg.norm(TREE[:, [0, 2]], axis=1) < 0.15
    np.testing.assert_allclose(found.above[: len(TREE)][trunk], TREE[trunk, 1], atol=0.12)


# a pot

POTTED = np.concatenate([TREE + [0.0, 1.0, 0.0], box()])


def test_a_pot_is_taken_away_and_that_is_said():
    found = prepare(PointCloud(POTTED), up="y")
    assert pot(POTTED, POTTED[:, 1]) == pytest.approx(1.0, abs=0.15)
    assert found.cloud.height == pytest.approx(6.0, abs=0.3)
    assert np.linalg.norm(found.cloud.xyz[found.above < 0.5][:, [0, 2]], axis=1).max() < 0.2
    assert found.remarks[0].endswith(" points are of a pot, or of what else the plant stands in, 1.1 m high: they were taken away (`--keep-pot` leaves them).")


def test_a_pot_is_kept_where_that_is_asked():
    found = prepare(PointCloud(POTTED), up="y", keep_pot=True)
    assert found.cloud.height == pytest.approx(7.0, abs=0.3)
    assert not any("pot" in remark for remark in found.remarks)


def test_a_pot_on_the_ground_goes_with_the_ground():
    found = prepare(PointCloud(np.concatenate([POTTED, floor()])), up="y")
    assert found.ground
    assert found.cloud.height == pytest.approx(6.0, abs=0.3)


def test_a_pot_that_was_seen_from_outside_is_its_soil_and_its_wall():
    soil, wall = box(high=0.0, count=1500) + [0.0, 1.0, 0.0], box(count=3000)
    wall[:, [0, 2]] *= 0.8 / np.linalg.norm(wall[:, [0, 2]], axis=1)[:, None]
    seen = np.concatenate([TREE + [0.0, 1.0, 0.0], soil, wall])
    assert pot(seen, seen[:, 1]) == pytest.approx(1.0, abs=0.15)


def test_buttresses_are_no_pot():
    assert pot(buttressed(), buttressed()[:, 1]) is None


def test_many_stems_are_no_pot():
    many = np.concatenate([tree(5.0, k, (0.5 * np.cos(k), 0.5 * np.sin(k))) for k in range(12)])
    assert pot(many, many[:, 1]) is None


def test_a_tier_of_leaves_over_the_trunk_is_no_pot():
    tier = np.concatenate([TREE, box(high=0.3) + [0.0, 1.0, 0.0]])
    assert pot(tier, tier[:, 1]) is None


def test_leaves_round_the_foot_thin_out_and_are_no_pot():
    leaves = np.abs(np.random.default_rng(9).normal(0, 0.5, (3000, 3))) * np.random.default_rng(10).choice([-1.0, 1.0], (3000, 3))
    bushy = np.concatenate([TREE, np.c_[leaves[:, 0], np.abs(leaves[:, 1]), leaves[:, 2]]])
    assert pot(bushy, bushy[:, 1]) is None


# no places, doubles, outliers


def test_points_that_are_no_places_are_left_out_and_counted():
    cloud, lost = finite(np.array([[1.0, 2, 3], [np.nan, 0, 0], [4, 5, np.inf]]), np.array([[0.1] * 3, [0.2] * 3, [0.3] * 3]))
    assert cloud.xyz.tolist() == [[1, 2, 3]]
    assert cloud.colour.tolist() == [[0.1] * 3]
    assert lost == 2
    with pytest.raises(SketchError, match="The cloud has no points"):
        finite(np.full((2, 3), np.nan))


def test_points_that_are_there_twice_are_merged_into_the_first():
    xyz = np.array([[0.0, 0, 0], [1, 1, 1], [0, 0, 0], [1, 1, 1 + 1e-7], [1, 1, 1.001]])
    assert single_rows(xyz).tolist() == [0, 1, 4]


def test_what_belongs_to_nothing_is_left_out_and_twigs_are_kept():
    noise = np.random.default_rng(2).uniform([-4, 0, -4], [4, 8, 4], (60, 3))
    found = outliers(np.concatenate([TREE, noise]))
    assert found[len(TREE) :].mean() > 0.8
    assert found[: len(TREE)].mean() < 0.002


def test_what_belongs_to_nothing_makes_a_plant_no_higher():
    assert height_without(np.concatenate([TREE, [[0.0, 9.0, 0.0], [1.0, -3.0, 1.0]]])) == pytest.approx(np.ptp(TREE[:, 1]), abs=0.2)


def test_a_handful_of_points_has_no_outliers():
    assert not outliers(np.eye(3)).any()


# several trees


def two(gap: float = 3.0):
    other = tree(5.0, 1, (gap, 0.0))
    return np.concatenate([TREE, other]), np.repeat([0, 1], [len(TREE), len(other)])


def test_every_point_goes_with_the_tree_it_is_reached_from():
    xyz, whose = two()
    found = plants(xyz, xyz[:, 1] - xyz[:, 1].min())
    assert len(found) == 2
    assert (found.of_point == whose).mean() > 0.97
    np.testing.assert_allclose(found.place[:, 0], [0.0, 3.0], atol=0.1)
    np.testing.assert_allclose(found.height, [6.0, 5.0], atol=0.3)


def test_several_trees_are_named_with_their_places():
    with pytest.raises(SketchError) as error:
        prepare(PointCloud(two()[0]))
    assert str(error.value) == (
        "2 trees stand in the cloud (1: 5.9 m high, at x 0.0, z 0.0; 2: 4.9 m high, at x 3.0, z 0.0). Say which with `--tree K`, or cut it out of the cloud."
    )


def test_their_places_are_said_in_the_files_coordinates():
    with pytest.raises(SketchError, match=r"2: 4\.9 m high, at x 103\.0, y 50\.0\)"):
        prepare(PointCloud(lying(two()[0]) + [100.0, 50.0, 7.0]))


def test_one_of_them_is_taken_by_its_number():
    xyz, whose = two()
    first, second = (prepare(PointCloud(xyz), tree=k) for k in (1, 2))
    assert first.cloud.height == pytest.approx(6.0, abs=0.3)
    assert second.cloud.height == pytest.approx(5.0, abs=0.3)
    assert (first.trees, second.trees) == (2, 2)
    with pytest.raises(OptionError, match=r"There is no tree 3: the cloud has 2\. Say 1 to 2; 1 is the largest\."):
        prepare(PointCloud(xyz), tree=3)


@pytest.mark.parametrize("height", [1.5, 0.4])
def test_low_plants_beside_a_tree_are_left_out_and_that_is_said(height):
    low = tree(height, 2, (2.5, 1.0))
    found = prepare(PointCloud(np.concatenate([TREE, low])))
    assert found.cloud.height == pytest.approx(6.0, abs=0.3)
    assert found.remarks[0] == f"{len(low):,} points are of low plants, or of what lies on the ground; they were left out."


def test_a_branch_that_hangs_to_the_ground_is_of_the_tree():
    hanging = limb([1.7, 2.4, 0.0], [2.0, 0.02, 0.0], 0.01, 0.006, np.random.default_rng(4), 150)
    bough = limb([0.0, 2.0, 0.0], [1.7, 2.4, 0.0], 0.03, 0.01, np.random.default_rng(5), 150)
    found = prepare(PointCloud(np.concatenate([TREE, bough, hanging])))
    assert found.remarks == ()
    assert len(found.cloud) == len(TREE) + len(bough) + len(hanging)


def test_curtains_of_leaves_that_hang_to_the_ground_are_of_the_tree():
    found = prepare(PointCloud(weeping()), up="y")
    assert found.trees == 1
    assert len(found.cloud) > 0.99 * len(weeping())
    assert len(stems(weeping(), weeping()[:, 1]).rows) == 4


def test_a_young_tree_beside_a_rough_trunk_is_a_tree():
    chance = np.random.default_rng(3)
    rough = limb([0, 0, 0], [0, 6, 0], 0.3, 0.2, chance, 400) + chance.normal(0, 0.012, (2403, 3))
    assert len(plants(np.concatenate([TREE, rough, tree(4.0, 5, (2.2, 0.0))]), np.concatenate([TREE, rough, tree(4.0, 5, (2.2, 0.0))])[:, 1])) == 2


# all of it


def test_a_tree_with_ground_stands_at_the_origin_in_the_end():
    scene = lying(np.concatenate([TREE + [1.0, 0.3, 2.0], floor(slope=0.3)]))
    found = prepare(PointCloud(scene))
    assert found.ground
    assert found.placement.up == "z"
    np.testing.assert_allclose(found.placement.to_world(lying(np.array([[1.0, 0.3, 2.0]]))), 0.0, atol=0.08)
    assert found.remarks[0].endswith("points are ground (it slopes by 17°); they were taken away.")


def test_the_placement_leads_back_to_the_file():
    given = lying(TREE) + [3.0, 4.0, 5.0]
    found = prepare(PointCloud(given))
    there = found.placement.to_file(found.cloud.xyz)
    assert len(there) > 0.99 * len(given)
    assert {tuple(row) for row in np.round(there, 6)} <= {tuple(row) for row in np.round(given, 6)}
    np.testing.assert_allclose(found.placement.to_world(there), found.cloud.xyz, atol=1e-9)


def test_what_was_done_is_said_once_each():
    given = np.concatenate([TREE, TREE[:500], [[3.0, 3.0, 3.0]]])
    found = prepare(Placed(PointCloud(given), Placement(), "PLY", "y", len(given), 0.0, ("read",)), points=2000)
    assert len(found.cloud) <= 2000
    assert found.remarks[:2] == ("read", "500 points were there twice; they were merged.")
    assert found.remarks[2].startswith(f"The tree has {len(TREE) + 1:,} points; ")


def test_columns_go_along_with_their_points():
    colour = np.linspace(0, 1, len(TREE))[:, None].repeat(3, axis=1)
    found = prepare(PointCloud(TREE, colour))
    back = {tuple(row): value for row, value in zip(np.round(TREE, 6), colour[:, 0], strict=True)}
    there = np.round(found.placement.to_file(found.cloud.xyz), 6)
    assert all(back[tuple(row)] == value for row, value in zip(there, found.cloud.colour[:, 0], strict=True))


def test_a_cloud_that_is_not_in_metres_is_told():
    found = prepare(PointCloud(TREE * 100))
    assert found.remarks[-1].startswith("The tree would be ")
    assert found.remarks[-1].endswith(" m high: the cloud is probably not in metres (`--unit 0.001` for millimetres, 0.3048 for feet).")


def test_too_few_points_are_named():
    with pytest.raises(SketchError) as error:
        prepare(PointCloud(np.tile([[1.0, 2.0, 3.0]], (5000, 1))))
    assert str(error.value) == "Only one point of the cloud may be a tree. Give a cloud with more points, or one with a tree in it."


def test_ground_alone_is_no_tree():
    with pytest.raises(SketchError) as error:
        prepare(PointCloud(tree() * [1.0, 0.0, 1.0]), up="y")
    assert str(error.value) == "None of the points of the cloud may be a tree. Give a cloud with more points, or one with a tree in it."


def test_uneven_ground_alone_is_no_tree_whichever_axis_is_up():
    chance = np.random.default_rng(0)
    level = np.c_[chance.uniform(-3, 3, 4000), chance.normal(0, 0.005, 4000), chance.uniform(-3, 3, 4000)]
    for xyz in (level, level[:, [0, 2, 1]]):
        with pytest.raises(SketchError, match=r"^The points lie 6 m wide and 0\.01\d m high: nothing stands there\."):
            prepare(PointCloud(xyz))


def test_points_that_all_lie_at_one_height_are_no_tree():
    with pytest.raises(SketchError) as error:
        prepare(PointCloud(tree() * [1.0, 0.0, 0.0]), up="y")
    assert str(error.value).endswith("m wide and 0 m high: nothing stands there. Check which axis is up (`--up y` or `--up z`).")
