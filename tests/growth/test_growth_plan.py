"""The tree at any time of its life."""

import numpy as np
import pytest
from growth_trees import bare_trunk, crown, curved, same, trunk_and_branch

from sketchtree.errors import OptionError
from sketchtree.growth.plan import MODES, GrowthPlan
from sketchtree.skeleton import TreeSkeleton

TREES = {"two limbs": trunk_and_branch, "curved": curved, "a crown": crown}
TIMES = np.linspace(0, 1, 101)
every_way = pytest.mark.parametrize(("mode", "bend"), [(mode, bend) for mode in MODES for bend in (0.0, -25.0, 20.0)])


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("make", TREES.values(), ids=TREES)
def test_at_time_1_the_tree_is_the_one_that_was_given(make, mode):
    tree = make()
    assert same(GrowthPlan.of(tree, mode=mode).at(1.0), tree)


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("make", TREES.values(), ids=TREES)
def test_poses_at_time_1_are_those_of_the_tree_that_was_given(make, mode):
    tree = make()
    poses = GrowthPlan.of(tree, mode=mode).poses([0.5, 1.0], dtype=np.float64)
    assert np.array_equal(poses.tip[-1], tree.tip) and np.array_equal(poses.radius[-1], tree.radius)


@every_way
def test_at_time_0_there_are_only_the_points_on_the_ground(mode, bend):
    seed = GrowthPlan.of(crown(), mode=mode, bend=bend).at(0.0)
    assert seed.segment_count == 0 and len(seed) == 1


@every_way
def test_lengths_radii_and_count_never_shrink(mode, bend):
    poses = GrowthPlan.of(crown(), mode=mode, bend=bend).poses(TIMES, dtype=np.float64)
    length = np.linalg.norm(poses.tip - poses.base, axis=2)
    assert np.diff(length, axis=0).min() > -1e-12
    assert (np.diff(poses.length) > -1e-12).all() and (np.diff(poses.count) >= 0).all()
    assert (np.diff(poses.radius, axis=0) >= 0).all()
    assert (np.diff(poses.grown, axis=0) >= 0).all()


@every_way
def test_nothing_jumps(mode, bend):
    tree = crown()
    plan = GrowthPlan.of(tree, mode=mode, bend=bend)
    for around in (0.013, 0.1, 0.31, 0.5, 0.77, 0.9, 0.949):
        near = plan.poses([around, around + 1e-4], dtype=np.float64)
        step = np.linalg.norm(np.diff(near.tip, axis=0)[0], axis=1)
        assert step.max() < 1e-4 * 40 * tree.height
        assert np.diff(near.radius, axis=0).max() < 0.05 * tree.radius.max()


@every_way
def test_the_tree_at_a_time_is_the_pose_at_that_time(mode, bend):
    tree = crown()
    plan = GrowthPlan.of(tree, mode=mode, bend=bend)
    poses, rows, now = plan.poses([0.4], dtype=np.float64), plan.rows_at(0.4), plan.at(0.4)
    assert np.array_equal(now.limb, tree.limb[rows])
    assert now.tip == pytest.approx(poses.tip[0, rows]) and now.radius == pytest.approx(poses.radius[0, rows])


def test_many_times_at_once_are_the_same_as_one_by_one(monkeypatch):
    plan = GrowthPlan.of(crown(), bend=-14)
    together = plan.poses(TIMES)
    monkeypatch.setattr("sketchtree.growth.plan._AT_ONCE", 1)
    apart = plan.poses(TIMES)
    assert np.array_equal(together.tip, apart.tip) and np.array_equal(together.radius, apart.radius)


def test_poses_of_pieces_have_every_drawn_point():
    tree = curved()
    plan = GrowthPlan.of(tree, mode="age", bend=-5)
    rows, pieces = plan.poses([0.3, 0.7]), plan.poses([0.3, 0.7], pieces=True)
    assert pieces.tip.shape[1] == len(tree) + len(tree.curve_points)
    assert np.array_equal(pieces.tip[:, plan.straight.last], rows.tip)


def test_a_curved_segments_share_is_that_of_its_way():
    tree = curved()
    poses = GrowthPlan.of(tree, mode="age").poses(TIMES)
    assert (np.diff(poses.grown, axis=0) >= 0).all() and ((poses.grown[:, 1] > 0.2) & (poses.grown[:, 1] < 0.8)).any()
    assert (poses.grown[-1] == 1).all() and (poses.grown[0, 1:] == 0).all()


def test_a_segment_that_has_not_begun_lies_at_the_tip_it_will_grow_from():
    tree = trunk_and_branch()
    poses = GrowthPlan.of(tree, mode="age").poses([0.1], dtype=np.float64)
    assert 0 < poses.tip[0, 1, 1] < 1
    assert (poses.tip[0, 2:] == poses.tip[0, 1]).all()


def test_a_curved_segment_grows_along_its_curve():
    tree = curved()
    plan = GrowthPlan.of(tree, mode="age")
    for time in np.linspace(0.05, 0.9, 18):
        now = plan.at(time)
        inner = now.curve_points
        assert all((np.abs(tree.curve_points - point).sum(axis=1) == 0).any() for point in inner)
        assert len(now) == 1 or now.curve(1).shape[1] == 3
    assert len(plan.at(0.5).curve_points) >= 1


def test_a_young_tree_in_mode_full_has_fewer_orders_thinner_wood_and_shorter_segments():
    tree = crown()
    young = GrowthPlan.of(tree, mode="full").at(0.1)
    assert 0 < young.segment_count < 0.3 * tree.segment_count
    assert young.order.max() < tree.order.max()
    assert young.radius.max() < 0.5 * tree.radius.max()
    assert young.height < 0.6 * tree.height
    assert np.median(young.length[1:4]) < 0.7 * np.median(tree.length[1:4])


def test_mode_age_leaves_what_has_grown_in_its_place():
    tree = crown()
    plan = GrowthPlan.of(tree, mode="age")
    poses = plan.poses([0.6], dtype=np.float64)
    whole = poses.grown[0] >= 1
    assert 1 < whole.sum() < len(tree) and np.array_equal(poses.tip[0, whole], tree.tip[whole])


def test_mode_scale_is_the_final_tree_smaller():
    tree = crown()
    small = GrowthPlan.of(tree, mode="scale").at(0.3)
    factor = small.height / tree.height
    assert 0 < factor < 1 and small.tip == pytest.approx(factor * tree.tip) and small.radius == pytest.approx(factor * tree.radius)


def test_births_are_in_order_from_parent_to_child_and_before_the_end():
    tree = crown()
    for mode in MODES:
        birth = GrowthPlan.of(tree, mode=mode).birth
        assert (birth >= 0).all() and (birth < 1).all()
        assert (birth[1:] >= birth[tree.parent[1:]]).all()


def test_a_segment_is_there_just_after_its_birth_and_not_before():
    tree = crown()
    plan = GrowthPlan.of(tree, mode="full")
    row = int(np.argsort(plan.birth)[len(tree) // 2])
    birth = plan.birth[row]
    assert row not in plan.rows_at(birth - 1e-6) and row in plan.rows_at(birth + 1e-6)


def test_trees_on_several_bases_grow_each_from_its_own():
    one = trunk_and_branch()
    both = TreeSkeleton.from_columns(
        np.r_[one.parent, np.where(one.parent < 0, -1, one.parent + len(one))], np.r_[one.tip, one.tip + [5, 0, 0]], np.r_[one.radius, one.radius],
        limb=np.r_[one.limb, one.limb + 10],
    )
    young = GrowthPlan.of(both, mode="full").at(0.3)
    assert young.is_base.sum() == 2 and young.segment_count > 0
    assert young.tip[young.tip[:, 0] > 2.5] == pytest.approx(young.tip[young.tip[:, 0] <= 2.5] + [5, 0, 0])


@pytest.mark.parametrize("mode", MODES)
def test_a_tree_without_wood_and_an_empty_one_have_a_life_too(mode):
    point = TreeSkeleton.from_columns([-1], np.zeros((1, 3)), [0.1])
    empty = TreeSkeleton.from_columns([], np.zeros((0, 3)), [])
    for tree in (point, empty):
        plan = GrowthPlan.of(tree, mode=mode, bend=-10)
        assert len(plan.at(0.5)) == len(tree) and plan.poses([0.0, 1.0]).tip.shape == (2, len(tree), 3)


def test_a_segment_of_no_length_does_no_harm():
    tree = TreeSkeleton.from_columns([-1, 0, 1, 2], np.array([[0, 0, 0], [0, 1, 0], [0, 1, 0], [1, 2, 0]], float), [0.1, 0.1, 0.1, 0.05])
    poses = GrowthPlan.of(tree, bend=-20).poses(TIMES)
    assert np.isfinite(poses.tip).all() and (np.diff(poses.radius, axis=0) >= 0).all()


def test_the_same_tree_grows_the_same():
    assert same(GrowthPlan.of(bare_trunk(), bend=-9).at(0.37), GrowthPlan.of(bare_trunk(), bend=-9).at(0.37))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"mode": "fast"}, "There is no mode of growth called 'fast'. Choose one of: age, full, scale."),
        (
            {"bend": -61},
            "bend is -61, but must lie between -60 and 60 degrees. Above 0 branches rise, below 0 they hang; the paper's pictures go from -25 to 20.",
        ),
        (
            {"bend": float("nan")},
            "bend is nan, but must lie between -60 and 60 degrees. Above 0 branches rise, below 0 they hang; the paper's pictures go from -25 to 20.",
        ),
        ({"thickness_weight": 2}, "thickness_weight is 2, but must lie between 0 and 1. The paper's is 0.001."),
    ],
)
def test_wrong_options_are_named(options, message):
    with pytest.raises(OptionError) as error:
        GrowthPlan.of(trunk_and_branch(), **options)
    assert str(error.value) == message


@pytest.mark.parametrize("time", [-0.1, 1.1, float("nan")])
def test_a_time_that_is_none_is_refused(time):
    with pytest.raises(OptionError) as error:
        GrowthPlan.of(trunk_and_branch()).at(time)
    assert str(error.value) == "A time of growth is not a number from 0 to 1. 0 is before the seed, 1 the tree that was given."


def test_leaves_unfold_after_their_wood_has_grown_and_are_all_whole_in_the_end():
    tree = crown()
    plan = GrowthPlan.of(tree, mode="full")
    scales = np.array([plan.leaf_scale(time) for time in TIMES])
    assert (np.diff(scales, axis=0) >= 0).all() and (scales[-1] == 1).all() and (scales[0, 1:] == 0).all()
    assert np.abs(np.diff(scales, axis=0)).max() < 0.5
    for time, scale in zip(TIMES, scales, strict=True):
        assert (scale[plan.end > time] == 0).all()


def test_leaves_of_old_inner_wood_may_fall():
    tree = crown()
    plan = GrowthPlan.of(tree, mode="full")
    trunk = 1
    sizes = [plan.leaf_scale(time, falling=True)[trunk] for time in TIMES]
    assert max(sizes) == 1 and sizes[-1] == 0
    outer = int(np.argmax(plan.end))
    assert plan.leaf_scale(1.0, falling=True)[outer] == 1
