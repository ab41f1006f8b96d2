import dataclasses

import numpy as np
import pytest
from tests.propagate.after.hanging import grown, rod
from tests.propagate.worlds import HABIT, circle

from sketchtree.errors import OptionError
from sketchtree.geometry.radii import pipe_radii
from sketchtree.propagate.after import sag
from sketchtree.propagate.after.sag import Sag, rotation, twigs_fed
from sketchtree.propagate.space.envelope import Envelope
from sketchtree.propagate.space.space import Space
from sketchtree.skeleton import Kind, TreeSkeleton
from sketchtree.stage import SkeletonStage

FREE = Space()


@pytest.fixture(scope="module")
def tree():
    return grown()


def out(rows, length=2.0, rise=0.0):
    """Points of a limb straight out to +x from the post's top."""
    along = np.arange(1, rows + 1)[:, None] * length / rows
    return [0, 3.0, 0] + along * [np.cos(rise), np.sin(rise), 0]


def test_it_is_a_stage():
    assert isinstance(Sag(1.0), SkeletonStage)


def test_strength_0_leaves_the_tree_as_it_was(tree):
    assert Sag(0.0, HABIT)(tree) is tree


def test_euler_bernoulli_the_end_of_a_level_rod_sinks_by_w_l4_over_8_e_i(monkeypatch):
    monkeypatch.setattr(sag, "_LEAF_AREA", 0.0)
    length, radius = 2.0, 0.02
    limb = rod(out(20, length), radius)
    weight = 9.81 * 1000.0 * np.pi * radius**2
    stiffness = 9.0e9 * np.pi / 4 * radius**4
    sinks = 3.0 - Sag(0.5, HABIT)(limb).tip[-1, 1]
    assert sinks == pytest.approx(0.5 * weight * length**4 / (8 * stiffness), rel=0.01)


def test_drawn_rows_never_move_and_lengths_stay(tree):
    cut = Sag(3.0, HABIT, FREE).run(tree)
    hung, rows = cut.skeleton, cut.rows
    drawn = np.isin(tree.kind, (Kind.DRAWN, Kind.ROOT))
    np.testing.assert_array_equal(hung.tip[hung.kind == Kind.DRAWN], tree.tip[drawn])
    np.testing.assert_allclose(hung.length, tree.length[rows], atol=1e-12)
    assert np.linalg.norm(hung.tip - tree.tip[rows], axis=1).max() > 0.02


def test_what_bears_drawn_wood_does_not_move():
    tree = rod(out(4))
    tree = tree.replace(kind=np.r_[0, 0, 1, 1, 0, 1])
    hung = Sag(5.0, HABIT)(tree)
    np.testing.assert_array_equal(hung.tip[:5], tree.tip[:5])
    assert hung.tip[5, 1] < tree.tip[5, 1]


def test_more_weight_sinks_lower(tree):
    height = [Sag(strength, HABIT).run(tree).skeleton.tip[:, 1].mean() for strength in (0.0, 0.5, 1.0, 2.0)]
    assert sorted(height, reverse=True) == height


@pytest.mark.parametrize("rise", [-1.2, -0.5, 0.0, 0.6, 1.4])
def test_nothing_bends_past_hanging_straight_down(rise):
    limb = rod(out(12, 1.5, rise), 0.0008)
    way = Sag(5.0, HABIT).run(limb).skeleton.vector[2:]
    assert (way[:, 0] >= -1e-9).all() and np.abs(way[:, 2]).max() < 1e-9
    falls = way[:, 1] / np.linalg.norm(way, axis=1)
    assert (np.diff(falls) <= 1e-9).all()


def test_an_upright_and_a_hanging_rod_stay():
    for points in ([[0, 3.5, 0], [0, 4.0, 0]], [[0, 2.5, 0], [0, 2.0, 0]]):
        limb = rod(points, 0.004)
        np.testing.assert_allclose(Sag(5.0, HABIT)(limb).tip, limb.tip, atol=1e-12)


def test_it_agrees_with_the_slow_twin_row_by_row(tree):
    cut = Sag(2.0, HABIT).run(tree)
    np.testing.assert_allclose(cut.skeleton.tip, _slowly(tree, 2.0)[cut.rows], atol=1e-9)


def _slowly(tree, strength):
    thick, fed = sag.start_radius(tree), twigs_fed(tree, HABIT)
    load, own = np.zeros((2, len(tree), 4))
    for row in reversed(range(len(tree))):
        a, b, length = thick[row], tree.radius[row], tree.length[row]
        mass = np.pi * length * (a * a + a * b + b * b) / 3 * 1000.0 + 5000.0 * np.pi * HABIT.twig_radius**2 * 0.25 * fed[row]
        own[row] = np.r_[mass * (tree.start[row] + tree.tip[row]) / 2, mass]
        load[row] += own[row]
        if tree.parent[row] >= 0:
            load[tree.parent[row]] += load[row]
    turned, tip = [np.eye(3)] * len(tree), np.array(tree.tip)
    for row in range(len(tree)):
        above = tree.parent[row]
        if tree.kind[row] == Kind.DRAWN:
            continue
        chord = turned[above] @ tree.vector[row]
        beyond = load[row] - own[row]
        moment = load[row, :3] - load[row, 3] * tree.start[row] + beyond[:3] - beyond[3] * tree.tip[row]
        lever = turned[above] @ moment / 2
        along = chord / np.linalg.norm(chord)
        torque = np.cross(lever, [0, -1.0, 0])
        torque -= torque @ along * along
        axis = torque / np.linalg.norm(torque)
        angle = strength * 9.81 * np.linalg.norm(torque) * tree.length[row] / (9.0e9 * np.pi / 4 * (thick[row] * tree.radius[row]) ** 2)
        assert angle < np.radians(40)
        turn, half = rotation(np.array([axis, axis]), np.array([angle, angle / 2]))
        turned[row], tip[row] = turn @ turned[above], tip[above] + half @ chord
    return tip


def test_what_sags_out_of_the_crown_or_into_the_ground_is_cut_there():
    outline = circle(points=90)
    space, inside = Space((Envelope.from_outlines((outline,)),)), grown(crown=(outline,))
    hung = Sag(5.0, HABIT, space).run(inside).skeleton
    moved = hung.tip[hung.kind == Kind.PROPAGATED]
    assert hung.length.sum() < inside.length.sum() - 1e-3 and (space.barriers[0].lobes[0].margin(moved) >= -1e-6).all()
    low = rod(out(12, 4.0), 0.003)
    assert Sag(5.0, HABIT)(low).tip[:, 1].min() == pytest.approx(0.0, abs=1e-9)


def test_an_implied_crown_does_not_cut_what_sags():
    free = Envelope.from_outlines((circle(points=90),))
    free = dataclasses.replace(free, binding=False)
    tree = grown()
    np.testing.assert_array_equal(Sag(2.0, HABIT, Space((free,)))(tree).tip, Sag(2.0, HABIT)(tree).tip)


def test_pipe_model_the_twigs_fed_along_a_tree_are_all_its_pipes():
    tree = grown()
    habit = dataclasses.replace(HABIT, trunk_ratio=0.05)
    at_tip, _ = pipe_radii(tree, habit)
    tree = tree.replace(radius=at_tip)
    pipes = (at_tip[0] / habit.twig_radius) ** habit.pipe_exponent
    assert twigs_fed(tree, habit).sum() == pytest.approx(pipes, rel=1e-6)


def test_rodrigues_turns_about_the_axis():
    turn = rotation(np.array([[0, 0, 1.0]]), np.array([np.pi / 2]))[0]
    np.testing.assert_allclose(turn @ [1, 0, 0], [0, 1, 0], atol=1e-15)


def test_an_empty_tree_stays_empty():
    empty = TreeSkeleton.from_columns(np.zeros(0, int), np.zeros((0, 3)), np.zeros(0))
    assert len(Sag(1.0)(empty)) == 0


@pytest.mark.parametrize("strength", [-0.1, 5.1, np.nan])
def test_a_strength_out_of_range_is_refused(strength):
    with pytest.raises(OptionError) as caught:
        Sag(strength)
    assert str(caught.value) == f"sag is {strength:g}, but must lie between 0 and 5. 1 is as heavy as wood is; 0 is none."
