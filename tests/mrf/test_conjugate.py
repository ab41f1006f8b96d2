"""Priors on Θ, and how a template moves them."""

import numpy as np
import pytest

from sketchtree.mrf.conjugate import GENERIC_BELIEF, limb_prior
from sketchtree.mrf.prior import Prior
from sketchtree.parameters import LimbStatistics
from tests.twins import limb_model as twin


def _statistics(count):
    return LimbStatistics(
        divergence_count=np.array([count, 0]),
        divergence_mean=np.array([0.5, 0.0]),
        divergence_variance=np.array([0.01, 0.0]),
        length_count=np.array([count, count]),
        length_mean=np.array([-0.7, -0.6]),
        length_variance=np.array([0.05, 0.02]),
        bend_count=np.array([count, count, 0]),
        bend_square=np.array([0.02, 0.1, 0.0]),
    )


def test_without_a_template_the_prior_is_the_generic_one():
    belief = limb_prior(Prior(), np.float64)
    for name, value in GENERIC_BELIEF.items():
        np.testing.assert_array_equal(getattr(belief, name), value)


def test_a_template_moves_the_mean_by_its_own_count():
    belief = limb_prior(Prior(limbs=_statistics(30)), np.float64)
    m0, k0, _, _ = np.array(GENERIC_BELIEF["divergence"])[:, 0]
    assert belief.divergence[0, 0] == pytest.approx((k0 * m0 + 30 * 0.5) / (k0 + 30))
    assert belief.divergence[1, 0] == 8.0
    assert belief.divergence[2, 0] == 12.0


def test_a_template_with_few_limbs_counts_as_few():
    belief = limb_prior(Prior(limbs=_statistics(3)), np.float64)
    assert belief.length[1, 0] == pytest.approx(0.69 + 3)


def test_what_a_template_does_not_know_stays_generic():
    belief = limb_prior(Prior(limbs=_statistics(30)), np.float64)
    np.testing.assert_array_equal(belief.divergence[:, 1], np.array(GENERIC_BELIEF["divergence"])[:, 1])
    np.testing.assert_array_equal(belief.bend[:, 2], np.array(GENERIC_BELIEF["bend"])[:, 2])


def test_the_map_variance_is_that_of_the_inverse_gamma():
    belief = limb_prior(Prior(), np.float64)
    nu, s2 = np.array(GENERIC_BELIEF["divergence"])[2:]
    np.testing.assert_allclose(np.square(belief.mode().divergence_sd), (nu * s2 / 2) / (nu / 2 + 1), rtol=1e-6)


def test_the_update_keeps_the_variance_of_one_observation_near_the_prior():
    """Never the plain variance: one limb does not make σ collapse."""
    *_, s2 = twin.normal_update(1.045, 0.42, 6.0, 0.039, [1.045])
    assert s2 == pytest.approx(6 * 0.039 / 7)
