"""The cost m of a slanted plane: 0 where patches are the same, not where they are not."""

import numpy as np
import pytest
from ring import camera_at, rendered

from sketchtree.multiview.cost import SIDE, UNSEEN, mean_of_best, patch_of, source_cost
from sketchtree.multiview.homography import transfer
from sketchtree.multiview.patchmatch import IMPOSSIBLE, PRIOR, REACH, energy_of

ONE, OTHER = camera_at(0.0), camera_at(10.0)
GREYS = [rendered(camera)[0].mean(axis=2).astype(np.float32) for camera in (ONE, OTHER)]
DEPTH = rendered(ONE)[1]
T = transfer(ONE, OTHER).astype(np.float32)
X, Y = 50, 48  # on the trunk, whose bark faces the camera there


def patch(grey, x=X, y=Y, step=1):
    weight, value = np.empty(SIDE * SIDE, np.float32), np.empty(SIDE * SIDE, np.float32)
    return (weight, value, *patch_of(grey, x, y, step, weight, value))


def cost(rho, other=GREYS[1], x=X, y=Y):
    weight, value, total, mean, variance, middle = patch(GREYS[0], x, y)
    return source_cost(x, y, rho, 0.0, 0.0, T, other, 96, 96, 1, weight, value, total, mean, variance, middle)


def test_the_true_depth_costs_least():
    true = 1 / DEPTH[Y, X]
    tried = np.linspace(0.8 * true, 1.2 * true, 81)
    costs = [cost(rho) for rho in tried]
    assert abs(tried[int(np.argmin(costs))] - true) < 0.02 * true
    assert cost(true) < 0.1 < 0.6 < np.median(costs)


def test_light_and_contrast_do_not_count():
    assert cost(1 / DEPTH[Y, X], (0.5 * GREYS[1] + 0.3).astype(np.float32)) == pytest.approx(cost(1 / DEPTH[Y, X]), abs=1e-3)


def test_weights_are_bilateral():
    grey = np.full((9, 9), 0.5, np.float32)
    grey[:, 5:] = 0.9
    weight, _, total, mean, variance, middle = patch(grey, 4, 4)
    weight = weight.reshape(SIDE, SIDE)
    assert weight[2, 2] == 1 and weight[2, 1] == pytest.approx(np.exp(-1 / 8), rel=1e-5)
    assert weight[2, 3] == pytest.approx(np.exp(-1 / 8 - 0.4**2 / (2 * 0.06**2)), rel=1e-4)
    assert middle + mean == pytest.approx(0.5, abs=1e-6) and total == pytest.approx(weight.sum(), rel=1e-5) and variance < 1e-6


def test_an_even_patch_says_nothing():
    assert cost(0.4, np.full_like(GREYS[1], 0.5)) == 1.0


def test_what_the_other_photo_does_not_show_costs_as_much():
    assert cost(1 / 0.2) == UNSEEN


def test_of_several_photos_the_best_count():
    assert mean_of_best(np.array([0.9, 0.1, 1.5, 0.3]), 2) == pytest.approx(0.2)
    assert mean_of_best(np.array([0.9]), 2) == pytest.approx(0.9)


def test_eq2_adds_how_far_the_plane_of_the_segment_is():
    weight, value, total, mean, variance, middle = patch(GREYS[0])
    true, low, high = 1 / DEPTH[Y, X], 0.2, 0.9

    def energy(prior, rho=true, bound=np.inf):
        return energy_of(X, Y, rho, 0.0, 0.0, low, high, 125.0, prior, T[None], GREYS[1][None], np.array([[96, 96]]), 1, 2, weight, value, total, mean, variance, middle, np.empty(1), bound)

    own = energy(0.0)
    assert own == pytest.approx(cost(true))
    assert energy(true) == pytest.approx(own)
    assert energy(true + 0.5 * REACH * (high - low)) == pytest.approx(own + 0.5 * PRIOR, rel=1e-4)
    assert energy(true + 7 * REACH * (high - low)) == pytest.approx(own + PRIOR)
    assert energy(0.0, rho=1.1 * high) == IMPOSSIBLE


def test_what_cannot_be_less_than_a_bound_is_not_reckoned_out_and_the_rest_is_the_same():
    weight, value, *about = patch(GREYS[0])
    true, low, high = 1 / DEPTH[Y, X], 0.2, 0.9
    views = (np.stack([T, T, T]), np.stack([GREYS[1], 1 - GREYS[1], GREYS[1]]), np.array([[96, 96]] * 3), 1, 2)
    for rho in np.linspace(0.9 * true, 1.1 * true, 21):
        whole = energy_of(X, Y, rho, 0.0, 0.0, low, high, 125.0, true, *views, weight, value, *about, np.empty(3), np.inf)
        for bound in (0.02, 0.1, 0.3, 0.6, 1.2):
            found = energy_of(X, Y, rho, 0.0, 0.0, low, high, 125.0, true, *views, weight, value, *about, np.empty(3), bound)
            assert found == whole or (found >= bound and whole >= bound)
