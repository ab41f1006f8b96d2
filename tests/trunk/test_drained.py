"""Limbs among twigs, by what runs through them."""

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt
from silhouettes import capsules, forked

from sketchtree.trunk.binary import binary_trunk
from sketchtree.trunk.drained import around, drainage, drained
from sketchtree.trunk.skeletonise import trunk_skeleton


def veiled(seed: int = 0) -> np.ndarray:
    """A stem with two limbs, and round their upper halves a veil of specks."""
    alpha = capsules([((100.0, 240.0), (100.0, 30.0), 7.0), ((100.0, 150.0), (40.0, 60.0), 4.0), ((100.0, 130.0), (160.0, 50.0), 4.0)], (250, 200))
    y, x = np.mgrid[:250, :200]
    specks = (np.random.default_rng(seed).random((250, 200)) < 0.55) & (np.hypot(x - 100, y - 75) < 62)
    return np.maximum(alpha, specks)


def test_all_opacity_of_a_piece_runs_to_the_ground():
    piece = forked() >= 0.5
    water = drainage(forked(), piece, distance_transform_edt(piece), (115, 50))
    assert water.flow[115, 50] == pytest.approx(forked()[piece].sum())
    assert set(water.order[water.onward == -1]) == {115 * piece.shape[1] + 50}


def test_a_clean_silhouette_stays_as_it_is_and_a_few_holes_change_hardly_a_pixel():
    piece = forked() >= 0.5
    assert np.array_equal(drained(forked(), piece, piece), piece)
    holed = piece.copy()
    holed[[110, 95, 40], 50] = False
    left = drained(forked(), holed, piece)
    assert not (left & ~piece).any() and (piece & ~left).sum() <= 0.02 * piece.sum()


@pytest.mark.parametrize("seed", range(3))
def test_in_a_veil_of_twigs_limbs_are_left_and_no_thicker_than_they_carry(seed):
    alone, found = binary_trunk(capsules([((100.0, 240.0), (100.0, 30.0), 7.0)], (250, 200))), binary_trunk(veiled(seed))
    assert found.mask.sum() < 3.0 * alone.mask.sum()
    skeleton = trunk_skeleton(veiled(seed))
    assert skeleton.radius[skeleton.xy[:, 1] < 110].max() < 8.0
    ends = skeleton.xy[skeleton.tips]
    assert all(np.hypot(*(ends - at).T).min() < 25.0 for at in ([40.0, 60.0], [160.0, 50.0]))


def test_discs_are_as_large_as_their_places_say():
    ways, radius = np.zeros((40, 40), bool), np.zeros((40, 40))
    ways[10, 10], ways[25, 25], radius[10, 10], radius[25, 25] = True, True, 3.0, 6.0
    y, x = np.mgrid[:40, :40]
    np.testing.assert_array_equal(around(ways, radius), (np.hypot(y - 10, x - 10) <= 3.0) | (np.hypot(y - 25, x - 25) <= 6.0))
