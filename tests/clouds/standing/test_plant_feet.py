"""Where a plant stands: on the stems that come out of the ground, or where the density of projected points is highest."""

import numpy as np
import pytest
from stems_made import stem

from sketchtree.clouds.standing.apart import apart, slim
from sketchtree.clouds.standing.density import density
from sketchtree.clouds.standing.feet import feet
from sketchtree.clouds.standing.peaks import peaks
from sketchtree.clouds.standing.stems import breast_height, stems
from sketchtree.errors import OptionError


def crown(seed: int = 1, low: float = 2.0, high: float = 5.0, wide: float = 1.5, count: int = 3000) -> np.ndarray:
    return np.random.default_rng(seed).uniform([-wide, low, -wide], [wide, high, wide], (count, 3))


TREE = np.concatenate([stem(height=3.0), crown()])
SHRUB = np.concatenate([stem(0.05, 1.5, noise=0.001, count=800, seed=k, lean=0.2) + [0.25 * k, 0, 0.1 * (k % 2)] for k in range(3)] + [crown(low=1.2, high=2.2, wide=0.8)])


def test_a_tree_has_one_foot_its_lowest_ring():
    found = feet(TREE)
    assert len(found.rows) == 1
    assert TREE[found.rows[0], 1].max() < 0.1
    np.testing.assert_allclose(found.place[0], [0, 0, 0], atol=0.1)


def test_a_shrub_has_a_foot_for_each_stem():
    found = feet(SHRUB)
    assert len(found.rows) == 3
    np.testing.assert_allclose(sorted(found.place[:, 0]), [0.0, 0.25, 0.5], atol=0.05)


def test_stems_that_cross_below_breast_height_have_feet_of_their_own():
    crossing = np.concatenate([stem(0.03, 0.8, noise=0.0005, count=1500, lean=0.25), stem(0.03, 0.8, noise=0.0005, count=1500, lean=-0.25, seed=1) + [0.2, 0, 0], crown(low=0.7, high=4.0)])
    np.testing.assert_allclose(sorted(feet(crossing).place[:, 0]), [0.0, 0.2], atol=0.03)


def test_a_trunk_scanned_from_two_sides_has_one_foot():
    front, back = stem(0.5, 3.0, seen=0.35, noise=0.003, count=4000), stem(0.5, 3.0, seen=0.35, noise=0.003, count=4000, seed=1)
    assert len(feet(np.concatenate([front, back * [-1, 1, 1], crown(low=2.5, high=12.0, count=9000)])).rows) == 1


def test_so_many_roots_as_are_asked_for_the_largest_first():
    assert len(feet(SHRUB, count=2).rows) == 2
    assert len(feet(SHRUB, count=1).rows) == 1


def test_more_roots_than_stems_are_sought_by_density():
    two = np.concatenate([stem(0.1, 0.4, noise=0.001, count=400), stem(0.1, 0.4, noise=0.001, count=300) + [0.4, 0, 0], crown(low=0.35, high=3.0)])
    found = feet(two, count=2)
    np.testing.assert_allclose(sorted(found.place[:, 0]), [0.0, 0.4], atol=0.06)


CLUMP = [np.array([0.1 * np.cos(k), 0.1 * np.sin(k)]) for k in np.arange(6) * np.pi / 3]
def fork(arms: int, height: float, bends: bool) -> np.ndarray:
    """A trunk whose arms part at so many metres; straight, or rising more steeply farther up."""
    parts = [stem(0.2, height, count=600)]
    for k in range(arms):
        one = stem(0.2 / np.sqrt(arms), 1.2 - height, taper=0.0, count=900, seed=k + 1)
        out = 0.5 * (0.3 * one[:, 1] + 0.7 * 0.25 * (1 - np.exp(-4 * one[:, 1])) if bends else one[:, 1])
        turn = 2 * np.pi * k / arms + 0.3
        parts.append(one + np.c_[out * np.cos(turn), np.full(len(one), height), out * np.sin(turn)])
    return np.concatenate(parts)


LEANING = [stem(0.08, 0.8, noise=0.002, count=250, seed=k) for k in range(6)]
SPREADING = np.concatenate([some + np.c_[(x * (1 + 1.5 * some[:, 1])), np.zeros(len(some)), (z * (1 + 1.5 * some[:, 1]))] for some, (x, z) in zip(LEANING, CLUMP, strict=True)])
LILAC = np.concatenate([SPREADING, crown(low=0.9, high=4.4, wide=1.2)])


@pytest.mark.parametrize("count", ["auto", 6])
def test_stems_that_touch_at_the_ground_are_told_apart_farther_up(count):
    found = feet(LILAC, count=count)
    away = np.linalg.norm(found.place[:, None, [0, 2]] - np.array(CLUMP)[None], axis=2)
    assert sorted(away.argmin(axis=1)) == [0, 1, 2, 3, 4, 5]
    assert away.min(axis=1).max() < 0.04
    assert all(LILAC[ring, 1].max() < 0.05 for ring in found.rows)


def test_stems_whose_feet_are_joined_by_ground_are_told_apart():
    chance = np.random.default_rng(4)
    soil = np.c_[chance.uniform(-0.15, 0.15, 300), chance.uniform(0, 0.05, 300), chance.uniform(-0.15, 0.15, 300)]
    assert len(feet(np.concatenate([LILAC, soil])).rows) == 6


@pytest.mark.parametrize("bends", [False, True])
@pytest.mark.parametrize("height", [0.2, 0.45])
@pytest.mark.parametrize("arms", [2, 5])
def test_a_trunk_that_forks_above_the_ground_is_one_stem(arms, height, bends):
    forked = np.concatenate([fork(arms, height, bends), crown()])
    assert len(feet(forked).rows) == 1


def test_a_low_limb_is_no_stem():
    limb = stem(0.06, 1.2, noise=0.003, count=600, lean=0.7) + [0.0, 0.3, 0.0]
    assert len(feet(np.concatenate([TREE, limb])).rows) == 1


def test_pieces_as_wide_as_apart_are_sprays_of_one_tree_and_slim_ones_may_cross():
    chance = np.random.default_rng(6)
    spot, level = chance.normal(0, 0.2, (200, 2)), chance.uniform(0, 1, (200, 1))
    for wide, stands in ((1.0, 1), (0.1, 2)):
        two = np.concatenate([np.c_[wide * spot + side * (0.3 - 0.6 * level) * [1, 0], level][:, [0, 2, 1]] for side in (-1, 1)])
        assert len(slim(two, two[:, 1], [np.arange(200), np.arange(200, 400)], 1.0)) == stands


def test_a_bough_that_hangs_from_above_goes_down_to_no_ground():
    level = np.linspace(0.0, 1.0, 200)
    upright, hanging = np.c_[0 * level, level, 0 * level], np.c_[0.5 + 0 * level, 0.4 + 0.6 * level, 0 * level]
    both = np.concatenate([upright, hanging])
    assert [len(rows) for rows in apart(both, both[:, 1], [np.arange(200), np.arange(200, 400)], 1.0)] == [200]


def test_no_more_stems_than_the_points_show():
    assert len(feet(LILAC, count=9).rows) == 6


@pytest.mark.parametrize("seen", [1.0, 0.5])
@pytest.mark.parametrize("count", [100, 1500])
def test_one_trunk_is_one_stem_however_many_are_told(seen, count):
    assert len(feet(np.concatenate([stem(0.3, 3.0, seen=seen, count=count), crown()]), count=3).rows) == 1


def test_a_valley_no_deeper_than_chance_parts_no_peaks():
    assert len(peaks(density(np.random.default_rng(0).normal(size=(100, 3)) * [1.0, 4.0, 1.0], cell=0.01))) <= 1


def test_feet_stand_at_their_height_above_sloping_ground():
    sloped = SHRUB + np.outer(SHRUB[:, 0], [0.0, 0.4, 0.0])
    found = feet(sloped, sloped[:, 1] - 0.4 * SHRUB[:, 0])
    assert len(found.rows) == 3
    assert np.ptp(found.place[:, 1]) > 0.15


def test_a_branch_that_hangs_to_the_ground_is_no_foot():
    hanging = np.random.default_rng(3).uniform([0.9, 0.05, 0.0], [0.92, 2.0, 0.02], (300, 3))
    assert len(feet(np.concatenate([TREE, hanging])).rows) == 1


def test_twigs_that_hang_above_the_ground_are_no_stems():
    hanging = np.random.default_rng(3).uniform([0.8, 0.4, 0.0], [0.85, 2.0, 0.05], (400, 3))
    assert len(stems(np.concatenate([TREE, hanging]), np.concatenate([TREE, hanging])[:, 1]).rows) == 1


def test_stems_far_apart_are_of_several_plants():
    both = np.concatenate([TREE, TREE + [3.0, 0, 0]])
    assert stems(both, both[:, 1] - both[:, 1].min()).plant.tolist() == [0, 1]
    assert set(stems(SHRUB, SHRUB[:, 1] - SHRUB[:, 1].min()).plant) == {0}


def test_breast_height_is_1_3_m_or_less_of_a_small_plant():
    assert breast_height(20.0) == 1.3
    assert breast_height(2.0) == pytest.approx(0.24)


def test_section_5_3_the_root_is_where_most_points_lie_above_one_another():
    np.testing.assert_allclose(peaks(density(TREE))[:1], [[0.0, 0.0]], atol=0.05)


def test_section_5_3_k_roots_are_the_k_peaks_of_highest_density():
    low = np.concatenate([stem(0.05, 0.5, noise=0.001, count=count, seed=k) + [0.5 * k, 0, 0] for k, count in enumerate((500, 900, 700))])
    found = peaks(density(low, 2.0))
    np.testing.assert_allclose(found[:, 0], [0.5, 1.0, 0.0], atol=0.02)


def test_density_counts_every_point_once():
    assert density(TREE).value.sum() == pytest.approx(len(TREE), rel=1e-6)


@pytest.mark.parametrize("count", [0, 201])
def test_a_number_of_roots_that_makes_no_sense_is_refused(count):
    with pytest.raises(OptionError) as error:
        feet(TREE, count=count)
    assert str(error.value) == f"`roots` is {count}; the cloud has 4,500 points. Say auto, or 1 to 200."
