"""The fast log posterior against its slow twin, and the pieces it is made of."""

from functools import cache

import jax
import numpy as np
import pytest

from sketchtree.mrf.conjugate import GENERIC_BELIEF
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.log_posterior import LogPosterior, log_posterior
from sketchtree.mrf.padding import bucket
from sketchtree.mrf.prior import Prior
from tests.mrf.drawings import lone_stroke, random_tree, shrub, small_tree
from tests.twins import limb_model as twin

KINDS = ("solid_angle", "lateral", "apical", "stem", "limb_length", "segment_length", "siblings", "competition", "extent", "crown")


@cache
def _program():
    """(E, its gradient, Θ, sum of every kind at that Θ) in one compiled function."""

    def everything(posterior: LogPosterior, psi):
        value, slope = jax.value_and_grad(lambda at: posterior(at))(psi)
        theta = posterior.theta(psi)
        assignment = posterior.page.assign(psi)
        sums = {name: getattr(posterior, name).log_potential(assignment, theta).sum() for name in KINDS}
        return value, slope, theta, sums

    return jax.jit(everything)


def _evaluate(graph, psi, **options):
    posterior = log_posterior(graph, Prior(), dtype=np.float64, **options)
    padded = np.zeros(bucket(graph)[0])
    padded[: len(graph)] = psi
    return jax.tree.map(np.asarray, _program()(posterior, padded))


def _psi(graph, seed, sd=0.5):
    return np.where(graph.is_base, 0.0, np.clip(np.random.default_rng(seed).normal(0, sd, len(graph)), -1.3, 1.3))


def _worlds():
    one_sided = small_tree().replace(xy=np.abs(small_tree().xy))
    return {"small": small_tree(), "random": random_tree(3, 7), "one-sided": one_sided, "collinear": _collinear(), "shrub": shrub()}


def _collinear():
    """A limb drawn on top of the trunk."""
    return small_tree().replace(xy=np.array([[0, 10.0 * k] for k in range(11)]))


@pytest.mark.parametrize("world", ["small", "random", "one-sided", "collinear", "shrub"])
@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_its_twin(world, kind, double):
    graph = factor_graph(_worlds()[world])
    psi = _psi(graph, 1)
    _, _, theta, sums = _evaluate(graph, psi)
    assert sums[kind] == pytest.approx(twin.kinds(graph, psi, theta)[kind], abs=1e-5, rel=1e-5)


@pytest.mark.parametrize("world", ["small", "random", "one-sided"])
def test_the_gradient_is_that_of_finite_differences(world, double):
    graph = factor_graph(_worlds()[world])
    psi = _psi(graph, 2, 0.4)
    _, slope, *_ = _evaluate(graph, psi)
    step = 1e-5
    for row in np.flatnonzero(~graph.is_base)[::2]:
        up, down = psi.copy(), psi.copy()
        up[row] += step
        down[row] -= step
        secant = (_evaluate(graph, up)[0] - _evaluate(graph, down)[0]) / (2 * step)
        assert slope[row] == pytest.approx(secant, abs=1e-4, rel=1e-4)


def test_a_base_and_the_padding_have_no_gradient(small, double):
    _, slope, *_ = _evaluate(small, _psi(small, 2))
    assert slope[0] == 0
    assert (slope[len(small) :] == 0).all()


def test_theta_is_the_conjugate_update_of_the_limbs(small, double):
    psi = _psi(small, 4)
    theta = _evaluate(small, psi)[2]
    told = {"divergence": twin.divergences, "length": twin.excesses, "segment": twin.log_lengths}
    for name, data in ((name, told[name](small, psi)) for name in told):
        for o in (1, 2):
            prior = [row[o - 1] for row in GENERIC_BELIEF[name]]
            m, _, _, s2 = twin.normal_update(*prior, [x for order, x in data if order == o])
            assert getattr(theta, f"{name}_mean")[o - 1] == pytest.approx(m, abs=1e-8)
            assert getattr(theta, f"{name}_sd")[o - 1] ** 2 == pytest.approx(s2, abs=1e-8)
    nu, s2 = np.array(GENERIC_BELIEF["bend"])
    for o in (0, 1, 2):
        a = [x for order, x in twin.bends(small, psi) if order == o]
        expected = (nu[o] * s2[o] + sum(x * x for x in a)) / (nu[o] + 2 * len(a))
        assert theta.bend_sd[o] ** 2 == pytest.approx(expected, abs=1e-8)


def test_a_fixed_theta_stays_the_prior_s(small, double):
    theta = _evaluate(small, _psi(small, 5), learns=False)[2]
    np.testing.assert_allclose(theta.divergence_mean, GENERIC_BELIEF["divergence"][0])
    np.testing.assert_allclose(theta.length_sd**2, GENERIC_BELIEF["length"][3])
    np.testing.assert_allclose(theta.bend_sd**2, GENERIC_BELIEF["bend"][1])


def test_a_fixed_theta_leaves_the_factors_sum(small, double):
    psi = _psi(small, 6)
    value, _, theta, _ = _evaluate(small, psi, learns=False)
    assert value == pytest.approx(sum(twin.kinds(small, psi, theta).values()), abs=1e-6)


def test_the_trunk_s_bend_is_not_learnt_from_two_laterals(double):
    rows = [0, 1, 2, 3, 4, 5, 6]
    two = small_tree()
    graph = factor_graph(
        two.replace(
            parent=two.parent[rows], xy=two.xy[rows], limb=two.limb[rows], stroke=two.stroke[rows], tree=two.tree[rows],
            width=two.width[rows], joined=two.joined[rows], root=two.root[rows], curve_start=np.zeros(8, int), limb_id=two.limb_id[:3],
        )
    )  # fmt: skip
    theta = _evaluate(graph, _psi(graph, 7, 1.0))[2]
    assert theta.bend_sd[0] ** 2 == pytest.approx(GENERIC_BELIEF["bend"][1][0])


def test_integrating_theta_out_does_not_depend_on_the_theta_taken(small, double):
    """Bayes' rule: factors + log p(Θ) − log p(Θ | ψ) is one number for all Θ."""
    posterior = log_posterior(small, Prior(), dtype=np.float64)
    psi = np.zeros(bucket(small)[0])
    psi[: len(small)] = _psi(small, 8)

    def at(posterior, psi, theta):
        assignment = posterior.page.assign(psi)
        learnt = posterior.belief.updated(posterior.data(assignment))
        bayes = posterior.belief.log_density(theta).sum() - learnt.log_density(theta).sum()
        return posterior.given(assignment, theta) + bayes

    theta = _program()(posterior, psi)[2]
    other = jax.tree.map(lambda x: x * 1.3 + 0.02, theta)
    program = jax.jit(at)
    assert float(program(posterior, psi, theta)) == pytest.approx(float(program(posterior, psi, other)), abs=1e-9)


def test_the_mirror_image_is_as_likely(small, double):
    psi = _psi(small, 9)
    assert _evaluate(small, psi)[0] == pytest.approx(_evaluate(small, -psi)[0], abs=1e-9)


def test_steeper_than_eighty_degrees_is_impossible(small, double):
    assert _evaluate(small, np.full(len(small), np.radians(81)) * ~small.is_base)[0] == -np.inf


def test_planar_drops_the_terms_that_force_depth(small, double):
    posterior = log_posterior(small, Prior(), planar=True)
    assert not np.any(posterior.extent.weight)
    assert not np.any(posterior.crown.weight)
    assert not np.any(posterior.siblings.strength)
    assert not np.any(posterior.competition.present)
    assert np.sum(posterior.plane.present) == small.is_base.size - 1


@pytest.mark.parametrize("limbs, expected", [(5, (32, 8)), (9, (32, 16)), (13, (64, 16)), (28, (64, 32))])
def test_buckets_are_powers_of_two(limbs, expected):
    assert bucket(factor_graph(random_tree(0, limbs))) == expected


def test_a_lone_stroke_has_no_extent_to_hold():
    posterior = log_posterior(factor_graph(lone_stroke()), Prior())
    assert not np.any(posterior.extent.weight)
