"""Colours as mixtures of Gaussians (§2): G(I, θ) = Σ_k w_k N(I; μ_k, Σ_k)."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from sketchtree.keys import root_key
from sketchtree.photo.appearance import Mixture, fit_mixture

KEY = root_key(1)
SKY, LEAF = np.array([150.0, 190.0, 235.0]), np.array([60.0, 120.0, 40.0])


@pytest.fixture
def mixture() -> Mixture:
    draw = np.random.default_rng(0)
    root = draw.normal(0, 10, (2, 3, 3))
    return Mixture(np.array([0.3, 0.7]), np.stack([SKY, LEAF]), root @ root.transpose(0, 2, 1) + 25 * np.eye(3))


def test_eq_density_is_the_weighted_sum_of_gaussians(mixture):
    colour = np.random.default_rng(1).uniform(0, 255, (4, 5, 3))
    parts = [w * multivariate_normal(m, c).pdf(colour) for w, m, c in zip(mixture.weight, mixture.mean, mixture.covariance, strict=True)]
    np.testing.assert_allclose(mixture.log_density(colour), np.log(np.sum(parts, axis=0)), rtol=1e-9)
    np.testing.assert_allclose(mixture.log_parts(colour), np.log(np.moveaxis(parts, 0, -1)), rtol=1e-9)


def test_some_of_its_components_are_a_mixture_again(mixture):
    alone = mixture.only([1])
    assert len(alone) == 1 and alone.weight.tolist() == [1.0]
    np.testing.assert_array_equal(alone.mean, LEAF[None])


def test_a_mixture_is_found_again():
    draw = np.random.default_rng(2)
    colour = np.concatenate([draw.normal(SKY, 5, (600, 3)), draw.normal(LEAF, 8, (400, 3))])
    found = fit_mixture(colour, 2, key=KEY)
    order = np.argsort(found.mean[:, 2])
    np.testing.assert_allclose(found.mean[order], [LEAF, SKY], atol=2)
    np.testing.assert_allclose(found.weight[order], [0.4, 0.6], atol=0.02)


def test_where_there_are_few_colours_there_are_few_components():
    assert len(fit_mixture(np.repeat([SKY, LEAF, SKY / 2, LEAF / 2], 50, axis=0), 10, key=KEY)) == 2
    flat = fit_mixture(np.repeat([SKY], 100, axis=0), 10, key=KEY)
    assert len(flat) == 1 and np.isfinite(flat.log_density(SKY))


def test_the_same_key_fits_the_same_mixture():
    colour = np.random.default_rng(3).uniform(0, 255, (30_000, 3))
    one, two = (fit_mixture(colour, 5, key=KEY) for _ in range(2))
    np.testing.assert_array_equal(one.mean, two.mean)
