import numpy as np
import pytest

from sketchtree.foliage.outline import closed, inside, pointed, rounded, serrate, smooth, wavy

HALF = [(0, 0), (0.2, 0.2), (0.3, 0.5), (0.1, 0.9), (0, 1)]


@pytest.mark.parametrize("half", [smooth(HALF), pointed(HALF, 0.05), serrate(smooth(HALF), 9, 0.02), wavy(smooth(HALF), 5, 0.01)])
def test_a_half_outline_runs_from_joint_to_tip(half):
    assert np.allclose(half[0], (0, 0), atol=1e-9) and np.allclose(half[-1], (0, 1), atol=1e-9)


def test_a_smooth_outline_passes_through_its_points():
    half = smooth(HALF)
    gaps = [np.linalg.norm(half - point, axis=1).min() for point in HALF]
    assert max(gaps) < 1e-9


def test_a_smooth_outline_is_smooth():
    step = np.diff(smooth(HALF, samples=100), axis=0)
    turn = np.abs(np.diff(np.unwrap(np.arctan2(step[:, 1], step[:, 0]))))
    assert turn.max() < np.radians(6)


def test_rounded_corners_stay_on_the_midrib_at_both_ends():
    half = rounded(HALF, 0.03)
    assert half[0, 0] == 0 and half[-1, 0] == 0 and (half[1:-1, 0] > 0).all()


def test_teeth_stand_out_by_their_depth_at_most():
    half = smooth(HALF)
    toothed = serrate(half, 9, 0.02)
    gap = [np.linalg.norm(half - point, axis=1).min() for point in toothed]
    assert 0.005 < max(gap) < 0.02 + 2e-3


def test_a_closed_outline_mirrors_its_half():
    outline = closed(smooth(HALF))
    assert np.isclose(outline[:, 0].min(), -outline[:, 0].max())


def test_inside_follows_the_even_odd_rule():
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
    assert inside(np.array([[0.5, 0.5], [1.5, 0.5], [0.5, -0.1]]), square).tolist() == [True, False, False]
