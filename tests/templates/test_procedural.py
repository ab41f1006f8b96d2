"""The generator does what a recipe says."""

import numpy as np
import pytest

from sketchtree.errors import TemplateError
from sketchtree.templates.growing.draws import Draws, limb_stream_id
from sketchtree.templates.growing.headings import UP, bend, cross, lateral, side, tropism, turn, unit
from sketchtree.templates.growing.pipes import pipe_radii
from sketchtree.templates.growing.procedural import grow
from sketchtree.templates.growing.recipe import parse_recipe
from sketchtree.traverse import is_tip, limb_chains


def grown(text, **kwargs):
    return grow(parse_recipe(text, file="x.toml"), **kwargs)


def angle(a, b):
    a, b = np.array(a), np.array(b)
    return np.degrees(np.arccos(np.clip(a @ b / np.linalg.norm(a) / np.linalg.norm(b), -1, 1)))


def test_the_trunk_has_the_height_and_laterals_the_ratio_and_angle_written_down(minimal):
    tree = grown(minimal)
    trunk = tree.limb == 0
    assert np.ptp(tree.tip[trunk, 1]) == pytest.approx(4.0)
    chains = limb_chains(tree.parent, tree.limb)[1:]
    assert len(chains) == 4, "nodes at 1, 2, 3 and 4 m"
    for rows in chains:
        assert tree.length[rows].sum() == pytest.approx(0.3 * 4.0)
        assert angle(tree.vector[rows[0]], UP) == pytest.approx(60.0)
        assert (tree.order[rows] == 1).all()


def test_the_same_seed_gives_the_same_tree_and_another_seed_another(minimal):
    text = minimal.replace("bend = 0.0", "bend = 8.0")
    np.testing.assert_array_equal(grown(text).tip, grown(text).tip)
    assert not np.array_equal(grown(text).tip, grown(text, seed=2).tip)


def test_a_whorl_bears_its_laterals_evenly_around(minimal):
    tree = grown(minimal.replace("bare = 0.25", "bare = 0.9\nwhorl = 5\nazimuth_sd = 0.0"))
    first = [rows[0] for rows in limb_chains(tree.parent, tree.limb)[1:]]
    azimuth = np.sort(np.arctan2(tree.vector[first, 2], tree.vector[first, 0]))
    np.testing.assert_allclose(np.diff(azimuth), 2 * np.pi / 5, atol=1e-9)


def test_opposite_laterals_of_a_horizontal_limb_lie_flat_when_planar(minimal):
    deeper = minimal.replace("levels = 2", "levels = 3").replace("angle = 60.0", "angle = 90.0").replace(
        "[habit]", "spacing = 0.4\nwhorl = 2\nphyllotaxis = 0.0\nplanar = true\nazimuth_sd = 0.0\n[habit]"
    )  # fmt: skip
    tree = grown(deeper)
    np.testing.assert_allclose(tree.vector[tree.order == 2][:, 1], 0, atol=1e-9)


def test_droop_bends_down_but_never_past_the_vertical(minimal):
    text = minimal.replace("[habit]", "tropism = -400.0\n[habit]").replace("segment = 0.4", "segment = 0.1")
    tree = grown(text)
    tips = is_tip(tree.parent) & (tree.order == 1)
    assert (tree.vector[tips][:, 1] < -0.99 * tree.length[tips]).all()


def test_limbs_stop_at_the_envelope(minimal):
    text = minimal.replace("envelope = 9.0", "envelope = 0.5\noutline_sd = 0.0").replace("segment = 0.4", "segment = 0.05")
    assert np.hypot(*grown(text).tip[:, [0, 2]].T).max() <= 0.5 + 1e-9
    free = grown(text.replace("[habit]", "clip = false\n[habit]"))
    assert np.hypot(*free.tip[:, [0, 2]].T).max() > 0.9


def test_nothing_grows_into_the_ground(minimal):
    text = minimal.replace("ratio = 0.3", "ratio = 2.0").replace("[habit]", "tropism = -90.0\n[habit]")
    assert grown(text).tip[:, 1].min() >= 0.0


def test_a_fork_splits_the_trunk_into_limbs_of_its_own_kind(minimal):
    tree = grown(minimal.replace("bare = 0.25", "bare = 1.0\nend = 0.0\nforks = [[0.5, 3]]\nfork_angle = 40.0"))
    assert len(limb_chains(tree.parent, tree.limb)) == 3
    at = np.flatnonzero(np.bincount(tree.parent[tree.parent >= 0]) == 3)
    assert tree.tip[at[0], 1] == pytest.approx(2.0)
    assert (tree.tip[is_tip(tree.parent)][:, 1] > 3.3).all()


def test_several_stems_stand_on_bases_of_their_own(minimal):
    tree = grown(minimal.replace("levels = 2", "levels = 1\nstems = 6\nstem_ring = 0.3\nstem_lean = [[0, 0], [1, 30]]"))
    assert tree.is_base.sum() == 6
    assert (tree.tip[tree.is_base][:, 1] == 0).all()
    np.testing.assert_allclose(tree.tip[0], 0, err_msg="the first stem stands at the origin")
    last = np.flatnonzero(tree.is_base)[-1]
    assert angle(tree.vector[tree.parent == last][0], UP) == pytest.approx(30.0)


def test_a_recipe_that_runs_wild_is_refused(minimal, monkeypatch):
    monkeypatch.setattr("sketchtree.templates.growing.procedural.MAX_SEGMENTS", 900)
    text = minimal.replace("levels = 2", "levels = 8").replace("ratio = 0.3", "ratio = 2.0")
    with pytest.raises(TemplateError, match=r"Recipe stick: it grows more than 900 segments\. Use longer segments"):
        grown(text.replace("spacing = 1.0", "spacing = 0.5").replace("[habit]", "spacing = 0.4\n[habit]"))


def test_pipe_model_sums_to_the_power_n_before_it_is_stretched(minimal):
    recipe = parse_recipe(minimal, file="x.toml")
    tree, habit = grow(recipe), recipe.habit
    radius = pipe_radii(tree, habit)
    assert radius.max() == pytest.approx(habit.trunk_ratio * tree.height)
    assert radius.min() == pytest.approx(habit.twig_radius)
    base = int(np.argmax(radius))
    unstretched = habit.twig_radius * is_tip(tree.parent).sum() ** (1 / habit.pipe_exponent)
    share = (radius[base] - habit.twig_radius) / (unstretched - habit.twig_radius)
    pairs = np.flatnonzero(tree.parent >= 0)
    before = habit.twig_radius + (radius - habit.twig_radius) / share
    carried = np.zeros(len(tree))
    np.add.at(carried, tree.parent[pairs], before[pairs] ** habit.pipe_exponent)
    inner = ~is_tip(tree.parent)
    np.testing.assert_allclose(before[inner] ** habit.pipe_exponent, carried[inner], rtol=1e-9)


def test_headings_turn_as_their_names_say():
    v, x, z, down = unit((1.0, 1.0, 0.3)), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)
    assert angle(v, lateral(v, 0.7, 2.0)) == pytest.approx(np.degrees(0.7))
    assert angle(v, bend(v, 0.3, 1.0)) == pytest.approx(np.degrees(0.3))
    assert lateral(v, np.pi / 2, 0.0) == pytest.approx(side(v))
    assert lateral(x, np.pi / 2, np.pi / 2) == pytest.approx(UP)
    assert turn(x, z, np.pi / 2) == pytest.approx(UP) and cross(z, x) == UP
    assert angle(tropism(v, 0.2), UP) == pytest.approx(angle(v, UP) - np.degrees(0.2))
    assert tropism(v, 9.0) == pytest.approx(UP) and tropism(v, -9.0) == pytest.approx(down)
    assert tropism(UP, 0.3) == UP and side(UP) == x


def test_streams_are_fixed_numbers_of_their_limb():
    assert limb_stream_id(0, 0) != limb_stream_id(0, 1)
    draws = Draws(1, 2)
    first = [draws.uniform() for _ in range(2000)]
    assert Draws(1, 2).uniform() == first[0] == pytest.approx(0.44841514333227195, abs=1e-15)
    assert 0.47 < np.mean(first) < 0.53 and min(first) >= 0 and max(first) < 1
    normal = [draws.normal() for _ in range(3000)]
    assert abs(np.mean(normal)) < 0.08 and np.std(normal) == pytest.approx(1.0, abs=0.06)
    logs = np.log([draws.log_normal(0.2) for _ in range(500)])
    assert np.abs(logs).max() <= 0.4
