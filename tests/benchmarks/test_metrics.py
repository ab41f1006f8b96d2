"""What the figures of depth mean, on trees small enough to check by hand."""

import numpy as np
import pytest

from benchmarks import metrics
from benchmarks.drawing import make_case


def _fork(z=(0, 0, 0, 3, -3), radius=0.1) -> "metrics.Case":
    """A trunk of two segments and two limbs at its middle; H = 8."""
    tip = np.array([[0, 0], [0, 4], [0, 8], [3, 8], [-3, 8]], float)
    parent, limb = np.array([-1, 0, 1, 1, 1]), np.array([0, 0, 0, 1, 2])
    return make_case("fork", "test", parent, np.c_[tip, z], limb, np.full(5, radius), 8.0)


def _crown(z=(0, 0, 0, 3, -3, 1)):
    """The fork with a third limb higher up: a crown with an area."""
    tip = np.array([[0, 0], [0, 4], [0, 8], [3, 8], [-3, 8], [1, 10]], float)
    parent, limb = np.array([-1, 0, 1, 1, 1, 2]), np.array([0, 0, 0, 1, 2, 3])
    return make_case("crown", "test", parent, np.c_[tip, z], limb, np.full(6, 0.1), 10.0)


def test_the_truth_itself_is_perfect():
    case = _crown()
    found = metrics.evaluate(case, case.depth)
    assert (found["elev"], found["depth"], found["w_div"], found["w_ratio"], found["w_az"]) == (0, 0, 0, 0, 0)
    assert found["iou"] == found["hull"] == 1 and found["overlaps"] == 0


def test_the_mirror_image_is_as_good():
    case = _crown((0, 0, 0, 3, -2, 1))
    assert metrics.evaluate(case, -case.depth) == pytest.approx(metrics.evaluate(case, case.depth))


def test_elev_is_the_mean_gap_of_steepness():
    steep = 3 / np.sqrt(3**2 + 4**2 + 3**2)
    assert metrics.evaluate(_fork(), np.zeros(5))["elev"] == pytest.approx(2 * steep / 4)


def test_depth_is_the_log_ratio_of_extents_and_a_flat_tree_counts_as_one_percent_of_the_width():
    case = _fork()
    assert metrics.evaluate(case, 2 * case.depth)["depth"] == pytest.approx(np.log(2))
    assert metrics.evaluate(case, 0 * case.depth)["depth"] == 3.0


def test_w_div_is_in_degrees():
    flat, deep = np.degrees(np.arctan2(3, 4)), np.degrees(np.arctan2(np.hypot(3, 3), 4))
    assert metrics.evaluate(_fork(), np.zeros(5))["w_div"] == pytest.approx(deep - flat)


def test_w_ratio_compares_lengths_with_the_parent_s():
    ratio = np.array([1, np.sqrt(34) / 4, np.sqrt(34) / 4]), np.array([1, 5 / 4, 5 / 4])
    assert metrics.evaluate(_fork(), np.zeros(5))["w_ratio"] == pytest.approx(metrics.wasserstein(*ratio))


def test_w_az_is_the_turn_between_siblings():
    case = _fork((0, 0, 0, 3, 3))
    shape = metrics.Shape(case, case.position)
    np.testing.assert_allclose(shape.azimuth_gap, [90.0])
    np.testing.assert_allclose(metrics.Shape(case, case.position * [1, 1, 0]).azimuth_gap, [180.0])


def test_wasserstein_of_a_shift_is_the_shift():
    a = np.random.default_rng(0).normal(size=40)
    assert metrics.wasserstein(a, a + 2.5) == pytest.approx(2.5)
    assert np.isnan(metrics.wasserstein(a, a[:0]))


def test_hull_is_the_better_of_two_mirrors_and_nan_without_laterals():
    case = _crown((0, 0, 0, 3, -1, 1))
    assert metrics.evaluate(case, -case.depth)["hull"] == pytest.approx(1)
    stem = np.array([[0.0, 0, 0], [0, 1, 0]])
    bare = make_case("bare", "test", np.array([-1, 0]), stem, np.zeros(2, int), np.ones(2), 1.0)
    assert np.isnan(metrics.evaluate(bare, np.zeros(2))["hull"])


def test_crossing_limbs_overlap_and_forks_do_not():
    xy = [[0, 0], [0, 3], [0, 9], [0, 12], [3, 5], [6, 8], [3, 7.5], [6, 4.5]]
    parent, limb = np.array([-1, 0, 1, 2, 1, 4, 2, 6]), np.array([0, 0, 0, 0, 1, 1, 2, 2])
    case = make_case("cross", "test", parent, np.c_[xy, np.zeros(8)], limb, np.full(8, 0.2), 12.0)
    assert metrics.overlaps(case, case.position) == 1
    apart = case.position + np.array([0, 0, 1.0]) * np.isin(np.arange(8), [6, 7])[:, None]
    assert metrics.overlaps(case, apart) == 0


def test_segment_distance_agrees_with_a_dense_search():
    rng = np.random.default_rng(1)
    p, q, r, s = rng.normal(size=(4, 30, 3))
    t = np.linspace(0, 1, 201)[:, None]
    for k, found in enumerate(metrics.segment_distance(p, q, r, s)):
        a, b = p[k] + t * (q[k] - p[k]), r[k] + t * (s[k] - r[k])
        assert found == pytest.approx(np.linalg.norm(a[:, None] - b[None], axis=2).min(), abs=0.02)


def test_a_draw_is_half_a_win():
    assert metrics.win_rate([1.0, 2.0, 3.0, np.nan], [2.0, 2.0, 1.0, 0.0]) == 0.5
    assert metrics.win_rate([0.9], [0.5], lower=False) == 1.0


def test_medians_leave_nan_out():
    table = metrics.medians([{"a": 1.0, "b": np.nan}, {"a": 3.0, "b": np.nan}, {"a": np.nan, "b": np.nan}])
    assert table["a"] == 2.0 and np.isnan(table["b"])
