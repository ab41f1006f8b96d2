"""Thickness where the matte is wrong."""

import numpy as np
import pytest
from silhouettes import capsules

from sketchtree.trunk.borne import EXPONENT, SPARE, SWELLS, TAPERS, borne_radius
from sketchtree.trunk.limbs import trunk_drawing
from sketchtree.trunk.skeletonise import trunk_skeleton


TAPERING = [6.0] * 6 + [4.0] * 5  # a trunk that is thinner beyond its fork


def stem(radius) -> np.ndarray:
    """The thickness of a stem, upright, a node every ten pixels, that measures this."""
    count = len(radius)
    return borne_radius(np.arange(-1, count - 1), np.column_stack([np.zeros(count), -10.0 * np.arange(count)]), np.array(radius, float), np.zeros(count, int))


def with_limbs(trunk, *limbs, at=5):
    """(parent, xy, measured radius, limb) of a stem of ten pieces with level limbs at one fork."""
    parent, xy, radius, limb = [-1, *range(10)], [(0.0, -10.0 * k) for k in range(11)], list(trunk), [0] * 11
    for number, measured in enumerate(limbs, 1):
        for k, one in enumerate(measured, 1):
            parent.append(at if k == 1 else len(parent) - 1), xy.append((10.0 * k, -10.0 * at - number)), radius.append(one), limb.append(number)
    return np.array(parent), np.array(xy), np.array(radius, float), np.array(limb)


def test_what_tapers_as_wood_does_is_as_thick_as_it_measures():
    assert stem([6, 5.8, 5.5, 5, 4.2, 3]).tolist() == [6, 5.8, 5.5, 5, 4.2, 3]


def test_a_trunk_is_no_thinner_at_its_foot_than_above():
    assert stem([2, 2, 6, 6, 6, 6, 6, 5, 4, 3]).min() == 3 and stem([2, 2, 6, 6, 6, 6, 6, 5, 4, 3])[:2] == pytest.approx([6, 6])


def test_wood_does_not_end_at_a_step():
    thick = stem([8, 8, 8, 8, 8, 3, 3, 3, 3, 3])
    assert np.diff(thick).min() >= -10 * TAPERS - 1e-9 and thick[5:].tolist() == [3] * 5


def test_a_blunt_end_stays_as_thick_as_it_is():
    assert stem([6, 6, 6, 6, 6]).tolist() == [6] * 5


def test_a_blot_of_twigs_makes_no_limb_thick():
    columns = with_limbs(TAPERING, [2, 2, 2, 9, 9, 2])
    assert borne_radius(*columns)[11:].max() == pytest.approx(SWELLS * 2.0)


def test_a_limb_is_no_thicker_than_its_share_of_what_bears_it():
    columns = with_limbs(TAPERING, [6, 6])
    assert borne_radius(*columns)[11] == pytest.approx(6.0 * SPARE * (20 / 70) ** (1 / EXPONENT), rel=0.02)


def test_wood_is_no_thinner_than_what_it_bears_needs():
    columns = with_limbs([3.0] * 5 + [2.8] * 6, [2.5] * 5, [2.5] * 5)
    thick = borne_radius(*columns)
    assert thick[5] ** EXPONENT == pytest.approx(thick[6] ** EXPONENT + thick[11] ** EXPONENT + thick[16] ** EXPONENT) and thick[5] > 2.8


def test_a_trunk_is_at_the_ground_as_thick_as_it_measures_and_limbs_too_thick_for_it_all_thinner():
    columns = with_limbs([3.0] * 11, *[[3.0] * 6] * 8)
    thick = borne_radius(*columns)
    assert thick[0] == pytest.approx(3.0) and thick[11:].max() < 2.5


def test_thickness_never_grows_towards_the_tips_of_a_trunk_from_a_matte():
    matte = capsules([((50.0, 130.0), (50.0, 90.0), 3.0), ((50.0, 90.0), (50.0, 20.0), 6.0), ((50.0, 80.0), (20.0, 50.0), 3.0), ((28.0, 56.0), (20.0, 48.0), 7.0)])
    _, graph = trunk_drawing(trunk_skeleton(matte))
    inner = graph.parent >= 0
    assert np.all(graph.width[inner] <= graph.width[graph.parent[inner]] + 1e-9)
