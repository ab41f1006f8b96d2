import numpy as np
import pytest
from growing import bushy, fork, stick

from sketchtree.errors import OptionError
from sketchtree.geometry.radii import PipeRadii, never_thicker, pipe_radii
from sketchtree.parameters import Habit
from sketchtree.stage import SkeletonStage
from sketchtree.traverse import child_count, is_tip

HABIT = Habit(trunk_ratio=0.03, pipe_exponent=2.3, twig_radius=0.003)


def test_it_is_a_stage():
    assert isinstance(PipeRadii(HABIT), SkeletonStage)


@pytest.mark.parametrize("exponent", [2.0, 2.3, 3.0])
def test_pipe_model_r_n_is_the_sum_over_the_children_where_they_leave_the_fork(exponent):
    tree = bushy(1)
    at_tip, at_start = pipe_radii(tree, Habit(trunk_ratio=0.03, pipe_exponent=exponent, twig_radius=0.002))
    rows = np.flatnonzero(~tree.is_base)
    total = np.bincount(tree.parent[rows], at_start[rows] ** exponent, minlength=len(tree))
    inner = child_count(tree.parent) > 0
    np.testing.assert_allclose(total[inner], at_tip[inner] ** exponent, rtol=1e-9)


def test_base_is_trunk_ratio_times_height():
    tree = PipeRadii(HABIT)(bushy(2))
    assert tree.radius[0] == pytest.approx(0.03 * tree.height)


def test_every_tip_is_a_twig():
    tree = PipeRadii(HABIT)(bushy(2))
    np.testing.assert_allclose(tree.radius[is_tip(tree.parent)], 0.003)


def test_more_tips_than_pipes_still_meets_both_ends():
    tree = PipeRadii(Habit(trunk_ratio=0.003, twig_radius=0.003))(bushy(2))
    assert tree.radius[0] == pytest.approx(0.003 * tree.height)
    np.testing.assert_allclose(tree.radius[is_tip(tree.parent)], 0.003)


def test_no_row_is_thicker_than_its_parent():
    tree = PipeRadii(HABIT)(bushy(3))
    rows = np.flatnonzero(~tree.is_base)
    assert (tree.radius[rows] <= tree.radius[tree.parent[rows]] * (1 + 1e-12)).all()


def test_an_unbranched_limb_tapers_gently():
    tree = PipeRadii(HABIT)(stick([(0, y, 0) for y in range(11)], 1.0))
    fall = tree.radius[1:] / tree.radius[:-1]
    assert (fall < 1).all() and (fall[:-3] > 0.8).all()


def test_only_the_radius_changes():
    before = bushy(4)
    after = PipeRadii(HABIT)(before)
    for name in ("parent", "tip", "limb", "order", "curve_points", "curve_start"):
        np.testing.assert_array_equal(getattr(after, name), getattr(before, name))


def test_height_scales_the_trunk_of_each_tree_by_itself():
    small, large = stick([(0, 0, 0), (0, 2, 0)], 1.0), stick([(5, 0, 0), (5, 8, 0)], 1.0)
    both = small.append({name: getattr(large, name) for name in ("tip", "radius", "order")} | {"parent": large.parent + 2 * (large.parent >= 0), "tree": np.ones(2, int)})
    np.testing.assert_allclose(PipeRadii(HABIT)(both).radius[both.is_base], [0.06, 0.24])


def test_palm_trunk_is_nearly_a_cylinder_and_fronds_are_thin():
    trunk = stick([(0, y, 0) for y in range(9)], 1.0)
    fronds = {"parent": [8, 9, 8, 11], "tip": [(1, 9, 0), (2, 9, 0), (-1, 9, 0), (-2, 9, 0)], "radius": np.ones(4), "order": np.ones(4, int), "limb": [1, 1, 2, 2]}
    tree = PipeRadii(Habit(trunk_ratio=0.02, twig_radius=0.009, leaf_arrangement="frond"))(trunk.append(fronds))
    assert tree.radius[8] > 0.75 * tree.radius[0]
    assert tree.radius[9:].max() < 0.2 * tree.radius[0]


def varying(tree, factor=0.8):
    drawn = np.full(len(tree), np.nan)
    rows = np.flatnonzero(tree.order == 0)[1:]
    drawn[rows] = 0.3 * factor ** np.arange(len(rows))
    return drawn, rows


def test_drawn_radii_that_vary_are_kept():
    tree = bushy(5)
    drawn, rows = varying(tree)
    np.testing.assert_allclose(PipeRadii(HABIT, drawn)(tree).radius[rows], drawn[rows])


def test_drawn_radii_that_grow_towards_the_tip_are_cut_back():
    tree = stick([(0, y, 0) for y in range(6)], 1.0)
    radius = PipeRadii(HABIT, np.array([np.nan, 0.1, 0.2, 0.05, 0.3, 0.02]))(tree).radius
    np.testing.assert_allclose(radius[1:], [0.1, 0.1, 0.05, 0.05, 0.02])


def test_a_child_is_never_thicker_than_its_drawn_parent():
    tree = bushy(5)
    drawn = np.full(len(tree), np.nan)
    drawn[np.random.default_rng(0).choice(len(tree), 60, replace=False)] = 0.07
    radius = PipeRadii(HABIT, drawn)(tree).radius
    rows = np.flatnonzero(~tree.is_base)
    assert (radius[rows] <= radius[tree.parent[rows]] * (1 + 1e-12)).all()


def test_twigs_stay_twigs_beyond_drawn_radii():
    tree = bushy(5)
    drawn, _ = varying(tree)
    radius = PipeRadii(HABIT, drawn)(tree).radius
    tips = is_tip(tree.parent) & np.isnan(drawn)
    np.testing.assert_allclose(radius[tips], 0.003)


def test_a_limb_drawn_with_one_width_tapers_to_a_twig():
    tree = stick([(0, y, 0) for y in range(8)], 1.0)
    radius = PipeRadii(HABIT, np.r_[np.nan, np.full(7, 0.2)])(tree).radius
    assert 0.15 < radius[1] <= 0.2
    assert radius[-1] == pytest.approx(0.003)
    assert (np.diff(radius) <= 0).all()


def test_a_limb_of_two_strokes_takes_the_width_of_each_where_it_starts():
    tree = stick([(0, y, 0) for y in range(9)], 1.0, stroke=np.array([0, 0, 0, 0, 0, 1, 1, 1, 1]))
    radius = PipeRadii(HABIT, np.r_[np.nan, np.full(4, 0.2), np.full(4, 0.08)])(tree).radius
    assert 0.1 < radius[4] < 0.2 and 0.05 < radius[5] <= 0.08
    assert radius[-1] == pytest.approx(0.003)
    assert (np.diff(radius) <= 0).all()


def test_wood_below_a_drawn_lateral_is_thick_enough_to_carry_it():
    tree = fork(50, 0.5)
    drawn = np.full(len(tree), np.nan)
    drawn[[4, 5, 6]] = [0.4, 0.3, 0.2]
    radius = PipeRadii(HABIT, drawn)(tree).radius
    np.testing.assert_allclose(radius[[4, 5, 6]], [0.4, 0.3, 0.2])
    assert radius[1] >= 0.4 and radius[0] >= 0.4


@pytest.mark.parametrize("width", [1e-6, 1e-4, 0.02])
def test_wood_drawn_too_thin_is_a_third_of_what_its_twigs_need(width):
    tree = bushy(5)
    model, _ = pipe_radii(tree, HABIT)
    thin = np.where(tree.order < 2, width * 0.98 ** np.arange(len(tree)), np.nan)
    radius = PipeRadii(HABIT, np.maximum(thin, 1e-9))(tree).radius
    assert (radius >= np.maximum(model / 3, HABIT.twig_radius) * (1 - 1e-12)).all()


def test_a_hairline_of_one_width_still_carries_its_twigs():
    tree = bushy(5)
    model, _ = pipe_radii(tree, HABIT)
    radius = PipeRadii(HABIT, np.where(tree.order == 0, 1e-5, np.nan))(tree).radius
    assert (radius >= np.maximum(model / 3, HABIT.twig_radius) * (1 - 1e-12)).all()
    assert (radius[1:] <= radius[tree.parent[1:]] * (1 + 1e-12)).all()


def test_a_tree_of_one_point_gets_a_radius():
    assert PipeRadii(HABIT)(stick([(0, 0, 0)], 1.0)).radius[0] > 0


def test_an_empty_tree_passes():
    assert len(PipeRadii(HABIT)(stick(np.zeros((0, 3)), 1.0))) == 0


def test_never_thicker_takes_the_least_of_all_ancestors():
    np.testing.assert_array_equal(never_thicker(np.array([-1, 0, 1, 1]), [3.0, 1.0, 2.0, 0.5]), [3, 1, 1, 0.5])


def test_wrong_length_of_drawn_radii_is_named():
    with pytest.raises(OptionError, match=r"`drawn_radius` has shape \(3,\), but the tree has 2 rows. Give one radius per row"):
        PipeRadii(HABIT, np.ones(3))(stick([(0, 0, 0), (0, 1, 0)], 1.0))


def test_a_drawn_radius_of_zero_is_named():
    with pytest.raises(OptionError, match="The drawn radius of row 1 is 0, which is not a positive length. Give metres above zero"):
        PipeRadii(HABIT, np.array([np.nan, 0.0]))(stick([(0, 0, 0), (0, 1, 0)], 1.0))


def test_a_tip_may_count_for_part_of_a_pipe():
    tree = bushy(3)
    half = 0.5 * is_tip(tree.parent)
    whole, light = (pipe_radii(tree, Habit(trunk_ratio=0.003, twig_radius=0.003), weight)[0] for weight in (None, half))
    same, _ = pipe_radii(tree, Habit(trunk_ratio=0.003, twig_radius=0.003), 2 * half)
    np.testing.assert_array_equal(whole, same)
    assert (light[is_tip(tree.parent)] == 0.003).all()
    assert light[0] == pytest.approx(whole[0])
