"""Corners of blunt ends, noise, and where limbs end."""

import numpy as np
import pytest
from silhouettes import capsules

from sketchtree.trunk.blunt import SPUR, without_blunt
from sketchtree.trunk.ends import clear_of_end, clear_of_ground, led_out, smooth, telling
from sketchtree.trunk.noise import LEAST, noise_level, roughness
from sketchtree.trunk.rooted import Rooted, chains
from sketchtree.trunk.skeletonise import trunk_skeleton


def fork(reach: float, wide: float = 4.0) -> Rooted:
    """A stem of this radius, going on upwards, with a side branch that reaches so far from the fork."""
    xy = np.array([[0.0, 0.0], [0.0, -30.0], [0.0, -60.0], [reach, -30.0]])
    return Rooted(np.array([-1, 0, 1, 1]), xy, np.array([wide, wide, 1.0, 1.0]))


def kept(tree: Rooted, least: float = 1.0, asked: bool = False) -> int:
    return len(without_blunt(tree, np.array([False, False, False, asked]), least).parent)


def test_a_branch_stays_if_it_protrudes_by_half_the_radius_at_its_fork():
    assert kept(fork(4.0 + 2.0 - 1.0 + 0.01)) == 4
    assert kept(fork(4.0 + 2.0 - 1.0 - 0.01)) == 3


def test_and_by_the_least_in_any_case():
    assert kept(fork(4.0 + 5.0 - 1.0 + 0.01), least=5.0) == 4
    assert kept(fork(4.0 + 5.0 - 1.0 - 0.01), least=5.0) == 3


def test_a_branch_that_was_asked_for_stays():
    assert kept(fork(1.0), asked=True) == 4


def test_of_two_corners_one_goes_and_the_limb_keeps_the_other():
    xy = np.array([[0.0, 0.0], [0.0, -30.0], [3.0, -33.0], [-3.5, -33.5]])
    left = without_blunt(Rooted(np.array([-1, 0, 1, 1]), xy, np.array([4.0, 4.0, 0.5, 0.5])), np.zeros(4, bool), 1.0)
    assert left.xy[-1] == pytest.approx([-3.5, -33.5]) and len(left.parent) == 3


def test_a_limb_cut_square_has_one_end_in_its_middle():
    alpha = np.zeros((60, 120))
    alpha[20:40, 10:110] = 1.0
    skeleton = trunk_skeleton(alpha, root=(12.0, 30.0))
    assert len(skeleton.tips) == 1
    assert skeleton.xy[skeleton.tips[0]] == pytest.approx([110.0, 30.0], abs=1.0)
    assert skeleton.radius[skeleton.tips[0]] == pytest.approx(10.0, abs=0.5)


def test_a_foot_that_widens_into_two_roots_is_one_foot():
    alpha = capsules([((50.0, 100.0), (50.0, 20.0), 8.0), ((50.0, 100.0), (38.0, 119.0), 6.0), ((50.0, 100.0), (62.0, 119.0), 6.0)])
    alpha[112:, 40:60] = 1.0
    skeleton = trunk_skeleton(alpha)
    assert len(skeleton.tips) == 1 and skeleton.xy[skeleton.root] == pytest.approx([50.0, 120.0], abs=4.0)


@pytest.mark.parametrize("sd", [0.5, 1.0, 2.0])
def test_the_contours_roughness_is_the_noises_standard_deviation(sd):
    angle = np.linspace(0.0, 2.0 * np.pi, 3000, endpoint=False)
    radius = 500.0 + sd * np.random.default_rng(0).normal(size=3000)
    ring = radius[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    assert roughness([ring]) == pytest.approx(sd, rel=0.1)


def test_an_even_contour_is_evolved_by_the_least_all_the_same():
    angle = np.linspace(0.0, 2.0 * np.pi, 3000, endpoint=False)
    assert noise_level([500.0 * np.column_stack([np.cos(angle), np.sin(angle)])]) == LEAST


def test_smoothing_keeps_both_ends_and_takes_the_wavering_away():
    line = np.column_stack([np.arange(101.0), np.random.default_rng(0).normal(0.0, 0.5, 101)])
    even = smooth(line, 12.0)
    assert np.array_equal(even[[0, -1]], line[[0, -1]])
    assert np.abs(even[20:-20, 1]).max() < 0.5 < np.abs(line[20:-20, 1]).max()


def test_a_line_is_led_out_along_its_own_direction_and_not_into_a_corner():
    line = np.array([[float(x), 0.0] for x in range(41)] + [[41.0, 1.0], [42.0, 2.0], [43.0, 3.0], [44.0, 4.0]])
    radius = np.array([5.0] * 41 + [4.0, 3.0, 2.0, 1.0])
    out, wide = led_out(line, radius, clear_of_end(line, radius), lambda points: points[:, 0] < 45.0)
    assert out[-1] == pytest.approx([45.0, 0.0], abs=0.3) and wide == 5.0


def test_circles_of_a_foots_corner_touch_the_ground_and_no_other_do():
    line = np.array([[0.0, 0.0], [0.0, 90.0], [3.0, 95.0], [6.0, 99.0]])
    assert clear_of_ground(line, np.array([8.0, 8.0, 4.0, 0.5])).tolist() == [True, True, False, False]


def test_straight_lines_have_few_points_and_no_long_pieces():
    line = telling(np.column_stack([np.arange(31.0), np.zeros(31)]))
    assert len(line) == 4 and np.diff(line[:, 0]).max() <= 12.0


def test_chains_run_from_fork_to_fork():
    assert chains(np.array([-1, 0, 1, 2, 2, 3])) == [[0, 1, 2], [2, 3, 5], [2, 4]]


def test_a_spur_shorter_than_it_is_thick_is_no_limb():
    def spur(reach):
        xy = np.array([[0.0, 0.0], [0.0, -30.0], [0.0, -60.0], [6.5, -30.0], [reach, -30.0]])
        return len(without_blunt(Rooted(np.array([-1, 0, 1, 1, 3]), xy, np.array([6.0, 6.0, 1.0, 4.0, 4.0])), np.zeros(5, bool), 1.0).parent)

    assert spur(6.0 + SPUR * 4.0 - 4.0 + 0.01) == 5 and spur(6.0 + SPUR * 4.0 - 4.0 - 0.01) == 3
