"""Each option of the generator does what the README says of it."""

import numpy as np
import pytest

from sketchtree.templates.growing.procedural import grow
from sketchtree.templates.growing.recipe import parse_recipe
from sketchtree.templates.growing.space import Space
from sketchtree.traverse import is_tip, limb_chains


def grown(text, **kwargs):
    return grow(parse_recipe(text, file="x.toml"), **kwargs)


def trunk(minimal, **options):
    """The recipe with options of its trunk."""
    lines = "".join(f"{name} = {value}\n" for name, value in options.items())
    return minimal.replace("spacing = 1.0\n", "spacing = 1.0\n" + lines)


def arms(minimal, **options):
    """The recipe with options of its arms."""
    return minimal.replace("[habit]", "".join(f"{name} = {value}\n" for name, value in options.items()) + "[habit]")


def crown(minimal, **options):
    """The recipe with options of its crown."""
    return minimal.replace("levels = 2\n", "levels = 2\n" + "".join(f"{name} = {value}\n" for name, value in options.items()))


def elevation(tree, rows):
    return np.degrees(np.arcsin(tree.vector[rows][:, 1] / tree.length[rows]))


@pytest.mark.parametrize("goal", [-20.0, 0.0, 35.0])
def test_a_limb_comes_to_rest_at_its_elevation_and_stays_in_its_plane(minimal, goal):
    tree = grown(arms(minimal, rest=goal, tropism=300.0))
    tips = np.flatnonzero(is_tip(tree.parent) & (tree.order == 1))
    np.testing.assert_allclose(elevation(tree, tips), goal, atol=1e-6)
    for rows in limb_chains(tree.parent, tree.limb)[1:]:
        azimuth = np.arctan2(tree.vector[rows, 2], tree.vector[rows, 0])
        np.testing.assert_allclose(azimuth, azimuth[0], atol=1e-9)


def test_a_vertical_shoot_can_level_off_too(minimal):
    tree = grown(trunk(minimal, rest=0.0, tropism=90.0, clip="false"))
    assert np.isfinite(tree.tip).all() and abs(elevation(tree, [np.flatnonzero(tree.limb == 0)[-1]])[0]) < 1e-6


def test_sway_makes_a_sinuous_trunk_about_its_old_line(minimal):
    tree = grown(trunk(minimal, sway=35.0, sway_length=1.5, clip="false").replace("segment = 0.5", "segment = 0.1"))
    rows = np.flatnonzero(tree.limb == 0)[1:]
    lean = 90 - elevation(tree, rows)
    assert 20 < lean.max() < 60
    side = tree.vector[rows, 0]
    turns = np.count_nonzero(np.diff(np.sign(np.diff(side))))
    assert 3 <= turns <= 9, "two turning points a wave on 4 m"
    assert np.hypot(*tree.tip[rows[-1], [0, 2]]) < 1.5


def test_a_sympodial_limb_turns_at_nodes_and_only_there(minimal):
    text = trunk(minimal, sympodial=1.0, relay_angle=40.0)
    tree = grown(text)
    rows = np.flatnonzero(tree.limb == 0)[1:]
    v = tree.vector[rows] / tree.length[rows, None]
    bends = np.degrees(np.arccos(np.clip(np.sum(v[1:] * v[:-1], axis=1), -1, 1)))
    assert sorted(np.round(bends).astype(int)) == [0, 0, 0, 0, 40, 40, 40]
    straight = grown(trunk(minimal, sympodial=0.0))
    assert np.ptp(straight.tip[straight.limb == 0][:, 0]) < 1e-9


def test_every_limb_breaks_where_the_chance_is_one_and_its_stump_stays_thick(minimal):
    whole, broken = grown(minimal), grown(arms(minimal, broken=1.0, broken_at=0.5).replace("segment = 0.4", "segment = 0.1"))
    lengths = [broken.length[rows].sum() for rows in limb_chains(broken.parent, broken.limb)[1:]]
    assert len(lengths) == 4 and max(lengths) <= 1.2 * 2 / 3 + 1e-9 and min(lengths) >= 1.2 / 3 - 0.1
    stumps = is_tip(broken.parent) & (broken.order == 1)
    assert broken.radius[stumps].min() > 1.2 * whole.radius[is_tip(whole.parent)].max()


def test_a_broken_trunk_keeps_the_laterals_below_the_break_where_they_were(minimal):
    whole, snag = grown(minimal), grown(trunk(minimal, broken=1.0, broken_at=0.5))
    assert snag.tip[snag.limb == 0][:, 1].max() < 2.7
    low = limb_chains(whole.parent, whole.limb)[1]
    same = limb_chains(snag.parent, snag.limb)[1]
    np.testing.assert_allclose(snag.tip[same], whole.tip[low])


def test_the_wind_bends_growth_downwind_the_more_the_higher(minimal):
    text = crown(minimal, wind="[[0.0, 0.0], [1.0, 30.0]]", downwind=90.0)
    calm, windy = grown(minimal), grown(text)
    assert windy.tip[is_tip(windy.parent)][:, 2].mean() > calm.tip[is_tip(calm.parent)][:, 2].mean() + 0.3
    rows = np.flatnonzero(windy.limb == 0)[1:]
    lean = np.degrees(np.arctan2(windy.vector[rows, 2], windy.vector[rows, 1]))
    assert (np.diff(lean) > 0).all() and abs(windy.tip[rows[-1], 0]) < 1e-9
    assert lean[1] - lean[0] < lean[-1] - lean[-2]


def test_the_wind_sheds_what_points_against_it(minimal):
    tree = grown(crown(trunk(minimal, whorl=12), wind_shed=1.0, downwind=0.0).replace("angle = 60.0", "angle = 90.0"))
    first = [rows[0] for rows in limb_chains(tree.parent, tree.limb)[1:]]
    along = tree.vector[first, 0] / tree.length[first]
    assert (along > 0.3).sum() >= 12 and (along < -0.9).sum() == 0
    assert len(first) < 4 * 12


def test_the_envelope_may_lie_downwind(minimal):
    text = crown(minimal, drift=0.6, outline_sd=0.0).replace("envelope = 9.0", "envelope = 0.8").replace("segment = 0.4", "segment = 0.05")
    tree = grown(text.replace("ratio = 0.3", "ratio = 0.6"))
    assert np.hypot(tree.tip[:, 0] - 0.6, tree.tip[:, 2]).max() <= 0.8 + 1e-9
    assert tree.tip[:, 0].max() > 0.9


def dense(minimal):
    """Many crooked arms."""
    text = trunk(minimal, whorl=9).replace("spacing = 1.0", "spacing = 0.5").replace("segment = 0.4", "segment = 0.1")
    return text.replace("bend = 0.0\n\n[habit]", "bend = 9.0\n\n[habit]")


def test_a_limb_keeps_clear_of_wood_that_stands_already(minimal):
    free, kept = grown(dense(minimal)), grown(arms(dense(minimal), clearance=0.2))
    assert kept.length.sum() < free.length.sum()
    for tree, wanted in ((free, False), (kept, True)):
        outer = np.hypot(tree.tip[:, 0], tree.tip[:, 2]) > 0.7
        gaps = [
            np.linalg.norm(tree.tip[(tree.limb == limb) & outer][:, None] - tree.tip[(tree.limb != limb) & outer][None], axis=2).min()
            for limb in np.unique(tree.limb[outer])
        ]
        assert (min(gaps) >= 0.2 - 1e-9) == wanted


def test_a_limb_that_may_bend_away_gets_farther_than_one_that_stops(minimal):
    stops = grown(arms(dense(minimal), clearance=0.2))
    bends = grown(arms(dense(minimal), clearance=0.2, avoid=40.0))
    assert bends.length.sum() > 1.02 * stops.length.sum()


def test_crowded_limbs_are_shed_whole(minimal):
    tree = grown(arms(dense(minimal), clearance=0.2, shed_short=0.9))
    lengths = [tree.length[rows].sum() for rows in limb_chains(tree.parent, tree.limb)[1:]]
    assert min(lengths) >= 0.9 * 1.2 - 1e-9
    kept = grown(arms(dense(minimal), clearance=0.2))
    assert len(lengths) < len(limb_chains(kept.parent, kept.limb)) - 1
    assert sorted(set(tree.limb)) == list(range(max(tree.limb) + 1)), "limbs are counted without gaps"


def test_space_names_the_nearest_wood_of_others():
    space = Space(0.5)
    for x, limb in ((0.0, 1), (0.3, 2), (-0.4, 3), (0.9, 4)):
        space.add((x, 1.0, -0.2), limb)
    assert space.nearest((0.1, 1.0, -0.2), 0.5, but=()) == (0.0, 1.0, -0.2)
    assert space.nearest((0.1, 1.0, -0.2), 0.5, but=(1,)) == (0.3, 1.0, -0.2)
    assert space.nearest((0.1, 1.0, -0.2), 0.15, but=(1,)) is None


def test_forks_grow_before_laterals_that_would_take_their_room(minimal):
    text = trunk(minimal, forks="[[0.4, 2]]", fork_angle=30.0, clearance=0.25, whorl=8).replace("spacing = 1.0", "spacing = 0.2")
    text = text.replace("segment = 0.5", "segment = 0.2").replace("segment = 0.4", "segment = 0.1")
    tree = grown(text)
    assert (tree.tip[is_tip(tree.parent), 1] > 3.7).sum() >= 2
    tops = [rows for rows in limb_chains(tree.parent, tree.limb) if tree.tip[rows[-1], 1] > 3.7 and tree.length[rows].sum() > 2.0]
    assert len(tops) == 2


def test_nodes_keep_their_spacing_on_average(minimal):
    text = minimal.replace("segment = 0.5", "segment = 0.2").replace("bare = 0.25", "bare = 0.0").replace("spacing = 1.0", "spacing = 0.5")
    tree = grown(text)
    at = np.sort(tree.tip[[tree.parent[rows[0]] for rows in limb_chains(tree.parent, tree.limb)[1:]]][:, 1])
    assert np.diff(at).mean() == pytest.approx(0.5, rel=0.05)


def test_a_limb_that_starts_outside_the_crown_does_not_leave_it_farther(minimal):
    text = crown(minimal).replace("envelope = 9.0", "envelope = [[0.0, 0.3], [0.5, 0.3], [1.0, 0.3]]\noutline_sd = 0.0")
    text = text.replace("segment = 0.4", "segment = 0.1").replace("ratio = 1.0", "ratio = 1.3").replace("bare = 0.25", "bare = 0.25\nclip = false")
    tree = grown(text)
    born_outside = tree.tip[tree.parent[[rows[0] for rows in limb_chains(tree.parent, tree.limb)[1:]]]][:, 1] > 4.0
    assert born_outside.any()
    assert (tree.length[(tree.order == 1) & (tree.tip[:, 1] > 4.2)].sum()) <= 0.1 * born_outside.sum() + 1e-9


def test_an_option_of_one_level_leaves_the_random_numbers_of_others_alone(minimal):
    deeper = minimal.replace("levels = 2", "levels = 3").replace("bend = 0.0", "bend = 6.0")
    plain, changed = grown(deeper), grown(trunk(deeper, broken=0.0, sway=0.0))
    np.testing.assert_array_equal(plain.tip, changed.tip)
    snapped = grown(arms(deeper, broken="[[0.0, 0.0], [0.9, 0.0], [1.0, 1.0]]"))
    first, same = (limb_chains(t.parent, t.limb)[1] for t in (plain, snapped))
    np.testing.assert_array_equal(plain.tip[first], snapped.tip[same])
