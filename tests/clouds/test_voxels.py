"""One real point stands for each voxel: the nearest to its middle."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from sketchtree.clouds.voxels import voxel_count, voxel_rows, voxel_size

CLOUDS = arrays(np.float64, st.tuples(st.integers(1, 40), st.just(3)), elements=st.floats(-3, 3, width=32))


@settings(max_examples=60, deadline=None)
@given(CLOUDS)
def test_the_nearest_to_the_middle_of_each_voxel_is_kept(xyz):
    best = {}
    for row, point in enumerate(xyz):
        cell = tuple(np.floor(point / 0.7))
        away = ((point / 0.7 - np.floor(point / 0.7) - 0.5) ** 2).sum()
        if cell not in best or away < best[cell][0]:
            best[cell] = (away, row)
    np.testing.assert_array_equal(voxel_rows(xyz, 0.7), sorted(row for _, row in best.values()))


def test_a_size_is_found_for_a_number_of_points():
    xyz = np.random.default_rng(0).uniform(size=(20_000, 3))
    size = voxel_size(xyz, 1_000)
    assert 850 <= voxel_count(xyz, size) <= 1_000


def test_points_that_all_lie_at_one_place_are_one():
    assert len(voxel_rows(np.ones((5, 3)), voxel_size(np.ones((5, 3)), 1))) == 1
