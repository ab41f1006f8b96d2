import numpy as np
import pytest

from sketchtree.geometry.detail import Detail
from sketchtree.geometry.resolution import halvings, sides


@pytest.mark.parametrize("radius", [0.01, 0.1, 0.7])
def test_a_polygon_stays_within_the_tolerance(radius):
    n = sides(np.array([radius]), 0.001, Detail(most_sides=256))[0]
    assert 0.8 * radius * (1 - np.cos(np.pi / n)) <= 0.001


def limbs(seed=0):
    rng = np.random.default_rng(seed)
    count = rng.integers(2, 30, 40)
    start = np.r_[0, np.cumsum(count)]
    needed = np.concatenate([np.sort(rng.choice([3, 4, 5, 6, 7, 8, 10, 12, 16, 24], size))[::-1] for size in count])
    whole = rng.integers(1, 8, 40)
    return needed, whole, start, *halvings(needed, whole, start, 24)


@pytest.mark.parametrize("seed", range(4))
def test_every_ring_has_the_sides_it_needs(seed):
    needed, _, start, side, level = limbs(seed)
    limb = np.repeat(np.arange(len(side)), np.diff(start))
    assert (side[limb] % 2**level == 0).all()
    assert (side[limb] >> level >= needed).all()


@pytest.mark.parametrize("seed", range(4))
def test_sides_fall_by_one_halving_at_a_time_and_not_in_a_collar(seed):
    _, whole, start, _, level = limbs(seed)
    for limb, first in enumerate(start[:-1]):
        mine = level[first : start[limb + 1]]
        assert np.isin(np.diff(mine), [0, 1]).all()
        assert (mine[: whole[limb]] == 0).all()


def test_sides_fall_from_sixteen_to_four():
    side, level = halvings(np.array([16, 15, 8, 8, 4, 4, 3]), np.array([1]), np.array([0, 7]), 24)
    assert side[0] == 16
    np.testing.assert_array_equal(16 >> level, [16, 16, 8, 8, 4, 4, 4])
