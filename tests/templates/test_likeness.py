"""Likeness is §7's formula for `chen`, and the density of Student's t for ours."""

from dataclasses import replace

import numpy as np
import pytest

from sketchtree.templates.seen.branching import Branching
from sketchtree.templates.exemplar import Views
from sketchtree.templates.matching.likeness import (
    LACKING,
    NU,
    SIGMA_FLOOR,
    SketchShape,
    branching_likeness,
    calibrated_terms,
    chen_terms,
    crown_likeness,
)
from sketchtree.templates.matching.metric import BRANCHING, HARMONICS, POSTURE, TRAITS
from sketchtree.templates.matching.weights import BARE, CROWN


@pytest.fixture(scope="module")
def random_world():
    rng = np.random.default_rng(6)
    e, v = 5, 4

    def moments(*shape):
        return Branching(rng.uniform(0.2, 2, (*shape, 3)), rng.uniform(0.1, 1, (*shape, 3)), np.full((*shape, 3), 9.0))

    views = Views(rng.uniform(0.1, 0.7, (e, v, 64)), moments(e, v), rng.normal(size=(e, v, 11)))
    shape = SketchShape(rng.uniform(0.1, 0.7, 64), moments(1), rng.normal(size=11))
    return shape, views


def test_lc_is_minus_the_distance_of_the_footprints(random_world):
    shape, views = random_world
    for e in range(5):
        for v in range(4):
            twin = -sum((shape.footprint[k] - views.footprint[e, v, k]) ** 2 for k in range(64)) ** 0.5
            assert crown_likeness(shape, views)[e, v] == pytest.approx(twin)


def test_lb_is_minus_the_sum_of_squared_differences_over_both_variances(random_world):
    shape, views = random_world
    for e in range(5):
        for v in range(4):
            twin = 0.0
            for x in range(3):
                difference = shape.branching.mean[0, x] - views.branching.mean[e, v, x]
                twin -= difference**2 / (shape.branching.sd[0, x] ** 2 + views.branching.sd[e, v, x] ** 2)
            assert branching_likeness(shape, views)[e, v] == pytest.approx(twin)


def test_lb_leaves_out_what_a_drawing_lacks_and_never_divides_by_zero(random_world):
    shape, views = random_world
    lacking = Branching(np.array([[0.5, np.nan, np.nan]]), np.array([[0.0, np.nan, np.nan]]), np.array([[1.0, 0, 0]]))
    still = Branching(views.branching.mean, 0 * views.branching.sd, views.branching.count)
    found = branching_likeness(SketchShape(None, lacking, shape.posture), Views(views.footprint, still, views.posture))
    np.testing.assert_allclose(found, -((0.5 - still.mean[..., 0]) ** 2) / SIGMA_FLOOR[0] ** 2)


def student(off, covariance, weight):
    """−w (NU + k)/2 ln(1 + q/NU), one vector at a time."""
    q = off @ np.linalg.solve(covariance, off)
    return -weight * (NU + len(off)) / 2 * np.log(1 + q / NU)


def test_our_terms_are_students_t_in_the_metric(random_world):
    shape, views = random_world
    crown, branching, posture = calibrated_terms(shape, views, CROWN)
    angle = 2 * np.pi * np.arange(64) / 64
    for e in range(5):
        for v in range(4):
            off = shape.traits - CROWN.shift - np.r_[views.branching.mean[e, v], views.posture[e, v]]
            for found, among, weight in ((branching, BRANCHING, CROWN.weight[1]), (posture, POSTURE, CROWN.weight[2])):
                assert found[e, v] == pytest.approx(student(off[among], CROWN.covariance(among), weight))
            f, q = shape.footprint - views.footprint[e, v], 0.0
            for k in range(HARMONICS + 1):
                power = abs(np.sum(f * np.exp(1j * k * angle)) / 64) ** 2
                q += (2 if k else 1) * power / CROWN.harmonic_sd[k] ** 2
            expected = -CROWN.weight[0] * (NU + 2 * HARMONICS + 1) / 2 * np.log(1 + q / NU)
            assert crown[e, v] == pytest.approx(expected)


def test_what_the_sketch_does_not_show_is_left_out(random_world):
    shape, views = random_world
    posture = shape.posture.copy()
    posture[[3, 8]] = np.nan
    kept = np.setdiff1d(np.arange(11), [3, 8])
    _, _, found = calibrated_terms(replace(shape, footprint=None, posture=posture), views, BARE)
    off = (posture - BARE.shift[POSTURE] - views.posture[2, 1])[kept]
    assert found[2, 1] == pytest.approx(student(off, BARE.covariance(POSTURE)[np.ix_(kept, kept)], BARE.weight[2]))


def test_what_an_exemplar_lacks_counts_as_two_standard_deviations(random_world):
    shape, views = random_world
    lacking = views.posture.copy()
    lacking[2, 1, 4] = np.nan
    _, _, found = calibrated_terms(shape, replace(views, posture=lacking), BARE)
    off = views.posture[2, 1] - (shape.posture - BARE.shift[POSTURE])
    off[4] = LACKING * BARE.sd[POSTURE][4]
    assert found[2, 1] == pytest.approx(student(off, BARE.covariance(POSTURE), BARE.weight[2]))


def test_without_a_crown_there_is_no_crown_term(random_world):
    shape, views = random_world
    bare = replace(shape, footprint=None)
    assert chen_terms(bare, views)[0] is None and calibrated_terms(bare, views, BARE)[0] is None


@pytest.mark.parametrize("metric", [CROWN, BARE], ids=lambda m: m.name)
def test_the_learnt_metrics_are_proper(metric):
    assert len(metric.shift) == len(metric.sd) == len(metric.correlation) == len(TRAITS)
    assert (metric.sd > 0).all() and (metric.weight >= 0).all() and (metric.harmonic_sd > 0).all()
    for among in (BRANCHING, POSTURE):
        assert np.linalg.eigvalsh(metric.covariance(among)).min() > 0
