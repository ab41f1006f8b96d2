"""How one plant grows: the equations of Guo et al. 2018, §5, each by itself."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.clouds.growing.collapse import collapsed, kept
from sketchtree.clouds.growing.colonise import takes
from sketchtree.clouds.growing.heading import ALPHA, BETA, decided, headed, optimal
from sketchtree.clouds.growing.hermite import curve, smoothed
from sketchtree.clouds.growing.logistic import Constant, Logistic, growth_units, length_at
from sketchtree.clouds.growing.metamer import Buds, branched, carried, rolled, seeds
from sketchtree.clouds.growing.patience import Patience
from sketchtree.clouds.growing.perception import Detour, perceived, taken
from sketchtree.clouds.growing.rules import Seen, one_each, shoots
from sketchtree.clouds.growing.species import species
from sketchtree.clouds.growing.thickness import radii
from sketchtree.clouds.growing.wanted import Growing, plain
from sketchtree.clouds.growing.weights import point_weights
from sketchtree.errors import OptionError

UP = np.array([[0.0, 1.0, 0.0]])


# Eq. 5: thickness


def test_children_share_their_parents_thickness_by_the_wood_that_they_bear():
    parent, step = np.array([NULL, 0, 1, 1, 3]), np.array([0.0, 1.0, 2.0, 3.0, 3.0])
    radius = radii(parent, step, np.full(5, 0.1), 0.45)
    assert radius[2] == pytest.approx(radius[1] * (2 / 8) ** 0.45)
    assert radius[3] == pytest.approx(radius[1] * (6 / 8) ** 0.45)


def test_an_only_child_tapers_since_its_parents_internode_counts():
    radius = radii(np.array([NULL, 0, 1]), np.array([0.0, 1.0, 1.0]), np.full(3, 0.1), 0.5)
    assert radius == pytest.approx([0.1, 0.1, 0.1 * 0.5**0.5])


# Eq. 6 and 7: logistic growth


def test_length_begins_with_two_internodes_and_comes_to_all(most=200.0):
    assert length_at(0, most) == pytest.approx(2.0)
    assert length_at(200, most) == pytest.approx(most)


def test_growth_units_are_the_slope_of_length(most=200.0):
    for t in (0.0, 5.0, 15.0, 30.0):
        assert growth_units(t, most) == pytest.approx((length_at(t + 1e-5, most) - length_at(t - 1e-5, most)) / 2e-5, rel=1e-5)


def test_buds_look_four_internodes_when_young_and_old_and_twelve_in_between():
    influence = Logistic(200.0)
    looked = [influence(t) for t in range(60)]
    assert looked[0] == looked[-1] == 4.0
    assert max(looked) == 12.0
    assert not influence.falling(10)
    assert influence.falling(16)


def test_a_constant_influence_never_changes():
    assert {Constant(5.0)(t) for t in range(30)} == {5.0}


def test_what_is_taken_does_not_follow_how_far_buds_look_though_it_does_as_printed():
    looked = Logistic(200.0)
    assert {takes(t, looked, Growing()) for t in range(60)} == {0.5 * 4.0}
    printed = [takes(t, looked, Growing(holds=False)) for t in range(60)]
    assert (min(printed), max(printed)) == (0.5 * 4.0, 0.5 * 12.0)
    assert takes(9, Constant(5.0), Growing(influence=5.0)) == 2.5


# Eq. 8: weights


def test_a_point_weighs_as_many_points_as_run_the_same_way_near_it():
    line = np.stack([np.linspace(0, 1, 101), np.zeros(101), np.zeros(101)], axis=1)
    weight = point_weights(line, eps_d=0.0305)
    assert weight[50] == 1 + 6
    assert weight[0] == 1 + 3


def test_wood_weighs_more_than_leaves_as_dense():
    rng = np.random.default_rng(0)
    branch = np.stack([np.linspace(0, 1, 400), *rng.normal(0, 0.003, (2, 400))], axis=1)
    leaves = np.array([3.0, 0.0, 0.0]) + 0.04 * rng.normal(size=(400, 3))
    weight = point_weights(np.concatenate([branch, leaves]))
    assert np.median(weight[:400]) > 2 * np.median(weight[400:])


# Eq. 9: direction


def test_the_best_direction_is_the_weighted_mean_of_those_to_the_points():
    way = np.array([[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]])
    assert optimal(way, np.array([3.0, 1.0, 5.0]), np.array([0, 0, 1]), 3) == pytest.approx(np.array([[0.75, 0.25, 0], [0, 0, 1], [0, 0, 0]]))


def test_a_bud_turns_between_its_heading_the_points_and_the_tropism_as_printed():
    best = np.array([[1.0, 0.0, 0.0]])
    found = headed(UP, best, np.asarray(Growing().tropism))
    assert found[0] == pytest.approx(np.array([ALPHA, 1.0 - BETA, 0.0]) / np.hypot(ALPHA, 1.0 - BETA))
    assert Growing().tropism == (0.0, -1.0, 0.0)
    assert headed(UP, best, np.array([0.0, 1.0, 0.0]))[0, 1] > found[0, 1]


def test_where_points_fork_a_bud_takes_the_way_of_most():
    fork = np.array([[0.5, 0.866, 0.0]] * 6 + [[-0.5, 0.866, 0.0]] * 3)
    weight, bud = np.ones(9), np.zeros(9, int)
    between = optimal(fork, weight, bud, 1)
    assert abs(between[0, 0]) < 0.2
    assert decided(fork, weight, bud, between)[0, 0] > 0.4


# metamers and the L-system


def test_rolling_turns_the_side_and_leaves_the_heading():
    side = rolled(np.array([[1.0, 0.0, 0.0]]), UP, np.radians([90.0]))
    assert side[0] == pytest.approx([0.0, 0.0, -1.0])


def test_a_lateral_leaves_at_the_branching_angle():
    assert branched(UP, np.array([[1.0, 0.0, 0.0]]), np.radians([38.0]))[0] == pytest.approx([np.sin(np.radians(38)), np.cos(np.radians(38)), 0.0])


def test_a_side_stays_across_the_heading():
    found = carried(np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]), np.array([[0.6, 0.8, 0.0], [0.0, 1.0, 0.0]]))
    assert found[0] == pytest.approx([0.8, -0.6, 0.0])
    assert abs(found[1] @ [0.0, 1.0, 0.0]) < 1e-12
    assert np.linalg.norm(found, axis=1) == pytest.approx([1.0, 1.0])


def shoot(points, **wanted):
    bud = seeds(np.zeros((1, 3)), np.zeros(1), np.zeros(1))
    seen = Seen(np.zeros(len(points), int), np.asarray(points, float), np.ones(len(points)))
    return shoots(bud, seen, 12.0, 1, species("pentagon_maple"), Growing(spread=0.0, beta=0.0, **wanted), 0.0, np.uint64(1))


def test_an_apical_bud_becomes_metamers_each_with_a_lateral_bud_and_an_apical_bud():
    new = shoot([[0.0, 0.3, 0.0]])
    assert new.place[:, 1] == pytest.approx(0.05 * np.arange(1, 7))  # to the centroid of its points: six internodes of 5 cm
    assert list(new.parent) == [0, 1, 2, 3, 4, 5]
    assert len(new.buds) == 6 + 1
    lateral, apical = new.buds.heading[:6], new.buds.heading[6]
    assert np.degrees(np.arccos(lateral[:, 1])) == pytest.approx(np.full(6, 38.0))
    assert apical == pytest.approx([0.0, 1.0, 0.0])
    azimuth = np.degrees(np.arctan2(-lateral[:, 2], lateral[:, 0]))
    assert (np.diff(azimuth) % 360) == pytest.approx(np.full(5, 120.0))


def test_a_shoot_turns_at_every_internode_where_the_papers_is_straight():
    bow = [[0.02 * k, 0.1 * k, 0.03 * k * k] for k in range(1, 5)]
    straight, steered = shoot(bow, steered=False).place, shoot(bow).place
    off = [np.linalg.norm(np.cross(place[1:] - place[0], place[-1] - place[0]), axis=1).max() for place in (straight, steered)]
    assert off[0] < 1e-9 < off[1]
    distance = [cKDTree(place).query(bow)[0].mean() for place in (straight, steered)]
    assert distance[1] < distance[0]


# perception


def test_a_bud_sees_what_lies_in_its_cone_and_within_its_reach():
    points = np.array([[0.0, 0.5, 0.0], [0.0, -0.5, 0.0], [0.5, 0.3, 0.0], [0.3, 0.5, 0.0], [0.0, 1.5, 0.0]])
    assert list(perceived(points, np.zeros((1, 3)), UP, np.array([1.0]))) == [0, NULL, NULL, 0, NULL]


def test_a_point_goes_to_the_nearest_bud_that_sees_it():
    place, heading = np.array([[0.0, 0.0, 0.0], [0.0, 0.8, 0.0]]), np.array([[0.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    assert list(perceived(np.array([[0.0, 0.7, 0.0], [0.0, 0.9, 0.0]]), place, heading, np.ones(2))) == [0, 1]


def test_a_bud_that_is_a_detour_is_not_asked():
    place, heading = np.array([[0.0, 0.0, 0.0], [0.0, 0.8, 0.0]]), np.array([[0.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    detour = Detour(np.array([0.0, 3.0]), np.zeros((2, 3)), 1.3)
    assert list(perceived(np.array([[0.0, 0.9, 0.0]]), place, heading, np.ones(2), detour=detour)) == [0]


def test_points_within_the_kill_distance_are_taken():
    tree = cKDTree(np.array([[0.0, 0.0, 0.0], [0.3, 0.0, 0.0], [1.0, 0.0, 0.0]]))
    assert list(taken(tree, np.array([[0.1, 0.0, 0.0], [0.9, 0.0, 0.0]]), np.array([0.15, 0.15]))) == [0, 2]


def test_of_buds_that_would_grow_to_the_same_place_one_does():
    place = np.array([[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [5.0, 0.0, 0.0]])
    seen = Seen(np.array([0, 1, 1, 2]), np.array([[0.0, 1.0, 0.0], [0.1, 1.0, 0.0], [0.1, 1.0, 0.0], [5.0, 1.0, 0.0]]), np.ones(4))
    buds, left = one_each(np.arange(3), seen, place, 0.5)
    assert list(buds) == [1, 2]
    assert list(left.bud) == [0, 0, 1]


# patience


def lost(patience, cycle=50):
    """All that buds try, one after the other, as long as none grows: (internodes that they look, τ)."""
    tried = [(patience.look(cycle), patience.detour)]
    while patience.lost(cycle):
        tried.append((patience.look(cycle), patience.detour))
    return tried


def test_buds_that_see_nothing_look_farther_then_round_more_and_at_last_over_gaps():
    tried = lost(Patience(Constant(4.0), Growing()))
    assert tried[:5] == [(4.0, 1.15), (6.0, 1.15), (9.0, 1.15), (12.0, 1.15), (4.0, 1.3)]
    assert [detour for _, detour in tried] == sorted(detour for _, detour in tried)
    assert tried[-1] == (60.0, np.inf)


def test_plain_growth_ends_where_no_bud_sees_a_point():
    assert lost(Patience(Constant(5.0), plain(5.0))) == [(5.0, np.inf)]


def test_as_soon_as_a_bud_grows_all_look_as_far_as_before():
    patience = Patience(Constant(4.0), Growing())
    patience.lost(50)
    patience.grew()
    assert patience.look(50) == 4.0


def test_while_buds_will_look_farther_anyhow_nothing_is_given_up():
    patience = Patience(Logistic(200.0), Growing())
    assert patience.lost(3)
    assert (patience.look(3), patience.detour) == (4.0, 1.15)


# collapse and Hermite


def test_nodes_on_a_straight_shoot_collapse_and_forks_and_turns_stay():
    place = np.array([[0.0, 0, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0], [1, 4, 0], [2, 5, 0], [-1, 4, 0]])
    parent = np.array([NULL, 0, 1, 2, 3, 4, 3])
    stays, above = collapsed(parent, place, np.full(7, 0.1))
    assert list(stays) == [True, False, False, True, False, True, True]
    assert list(kept(stays, above)) == [NULL, 0, 1, 1]


def test_nodes_of_a_bow_stay_though_each_turns_little():
    turn = np.radians(np.arange(0, 91, 5))
    place = np.stack([np.cos(turn), np.sin(turn), np.zeros(len(turn))], axis=1)
    stays, _ = collapsed(np.arange(len(turn)) - 1, place, np.full(len(turn), 0.02))
    assert 3 < stays.sum() < len(turn)


def test_nodes_where_thickness_changes_stay():
    place = np.stack([np.zeros(4), np.arange(4.0), np.zeros(4)], axis=1)
    assert collapsed(np.arange(4) - 1, place, np.array([0.1, 0.1, 0.05, 0.05]))[0][1:3].any()


def test_a_hermite_curve_begins_and_ends_as_it_is_told():
    p0, m0, p1, m1 = np.zeros((1, 3)), np.array([[1.0, 0, 0]]), np.array([[1.0, 1.0, 0]]), np.array([[0, 1.0, 0]])
    ends = curve(p0, m0, p1, m1, np.array([0.0, 1e-6, 1 - 1e-6, 1.0]))[0]
    assert ends[0] == pytest.approx([0, 0, 0])
    assert ends[3] == pytest.approx([1, 1, 0])
    assert (ends[1] - ends[0]) / 1e-6 == pytest.approx([1, 0, 0], abs=1e-4)
    assert (ends[3] - ends[2]) / 1e-6 == pytest.approx([0, 1, 0], abs=1e-4)


def turns(place):
    way = np.diff(place, axis=0)
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    return np.degrees(np.arccos(np.clip(np.einsum("ni,ni->n", way[1:], way[:-1]), -1, 1)))


def test_a_sharp_turn_is_drawn_out_through_its_node():
    place = np.array([[0.0, 0, 0], [0, 1, 0], [0.8, 1.6, 0]])
    _, smooth, radius = smoothed(np.array([NULL, 0, 1]), place, np.array([0.3, 0.2, 0.1]))
    assert turns(place).max() > 50
    assert turns(smooth).max() < 25
    assert np.linalg.norm(smooth - place[1], axis=1).min() == 0.0
    assert (np.diff(radius) < 0).all()


def test_a_turn_of_less_than_twenty_degrees_stays_as_it_is():
    place = np.array([[0.0, 0, 0], [0, 1, 0], [0.3, 2, 0]])
    assert len(smoothed(np.array([NULL, 0, 1]), place, np.full(3, 0.1))[0]) == 3


# options


def test_plain_space_colonisation_has_neither_weights_nor_anything_of_ours():
    given = plain(5.0)
    assert given.influence == 5.0
    assert not (given.weighted or given.steered or given.decided or given.sheds or given.direct or given.dominant or given.settles or given.holds or given.persists)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("theta", 0.0, "`theta` is 0.0. Give a number from 1 to 180."),
        ("kill", 2.0, "`kill` is 2.0. Give a number from 0.05 to 1."),
        ("influence", 0.0, "`influence` is 0.0. Give internodes, 1 to 1000, or None for the logistic model."),
    ],
)
def test_figures_out_of_range_are_refused(name, value, message):
    with pytest.raises(OptionError) as refused:
        Growing(**{name: value})
    assert str(refused.value) == message


def test_buds_are_chosen_and_joined():
    two = seeds(np.zeros((2, 3)), np.ones(2), np.zeros(2))
    assert len(Buds.joined([two, two.select(np.array([True, False]))])) == 3
