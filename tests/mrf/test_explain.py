"""Which factor pulls a limb where."""

from functools import cache

import jax
import jax.numpy as jnp
import numpy as np
import optimistix
import pytest

from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.explain import explain
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.log_posterior import KINDS, log_posterior
from sketchtree.mrf.prior import Prior
from tests.mrf.drawings import small_tree

H = small_tree().height


class Forward:
    """Limb s2, row 6, leans to the viewer."""

    def log_potential(self, assignment, theta):
        return 3.0 * assignment.elevation[6:7]


@cache
def _graph():
    return factor_graph(small_tree())


@cache
def _solver(theta_mode):
    return Elevation(theta_mode=theta_mode, typical=False, polish=optimistix.LBFGS(rtol=1e-5, atol=1e-5))


@cache
def _best(theta_mode):
    return infer(_graph(), Prior(), _solver(theta_mode), key=jax.random.key(0))


@cache
def _explained(theta_mode):
    return explain(_graph(), Prior(), _solver(theta_mode), _best(theta_mode).depth)


def _psi(depth):
    graph, z = _graph(), depth / H
    rise = np.where(graph.is_base, 0.0, z - z[np.maximum(graph.parent, 0)])
    return np.pad(np.arctan2(rise, np.maximum(graph.length, 1e-12)), (0, 21)).astype(np.float32)


def test_every_kind_of_the_model_is_told_but_a_plane_that_there_is_none_of():
    assert list(_explained("fit").energy) == [kind for kind in KINDS if kind != "plane"]
    assert set(_explained("fit").pull) == set(_explained("fit").energy)
    assert "plane" in explain(_graph(), Prior(), Elevation(planar=True), _best("fit").depth).energy


def test_energies_add_up_to_the_factors_sum():
    posterior = log_posterior(_graph(), Prior())
    psi = _psi(_best("fit").depth)
    given = float(posterior.given(posterior.page.assign(psi), posterior.theta(psi)))
    assert sum(_explained("fit").energy.values()) == pytest.approx(given, abs=1e-3)


def test_with_a_fixed_theta_energies_add_up_to_the_log_posterior():
    assert sum(_explained("fixed").energy.values()) == pytest.approx(_best("fixed").log_posterior, abs=1e-3)


def test_at_the_peak_pulls_on_every_limb_add_up_to_nothing():
    total = sum(_explained("fixed").pull.values())
    strongest = np.max(np.abs(list(_explained("fixed").pull.values())), axis=0)
    assert (np.abs(total) < 0.02 * strongest + 0.02).all()


def test_where_theta_is_learnt_what_remains_of_the_pulls_is_the_part_of_theta():
    """d/dψ (factors + log p(Θ) − log p(Θ | ψ)) = 0 at the peak, so the pulls add up to d/dψ log p(Θ | ψ)."""
    posterior, psi = log_posterior(_graph(), Prior()), jnp.asarray(_psi(_best("fit").depth))
    theta = posterior.theta(psi)
    slope = jax.grad(lambda at: jnp.sum(posterior.updated(at).log_density(theta)))(psi)
    moving = np.bincount(_graph().limb, np.asarray(slope, float)[:11], minlength=6)
    total = sum(_explained("fit").pull.values())
    np.testing.assert_allclose(total, moving, atol=0.05)


@pytest.mark.parametrize("kind", ["lateral", "segment_length", "siblings", "crown"])
def test_a_pull_is_the_slope_of_its_energy(kind):
    """Against finite differences: all of a limb turned by a little, Θ held."""
    posterior = log_posterior(_graph(), Prior())
    psi = _psi(_best("fit").depth)
    theta, factor, step = posterior.theta(psi), posterior.factors[kind], 2e-3

    def energy(limb, by):
        return float(jnp.sum(factor.log_potential(posterior.page.assign(psi + by * np.pad(_graph().limb == limb, (0, 21))), theta)))

    for limb in (1, 3, 5):
        secant = (energy(limb, step) - energy(limb, -step)) / (2 * step)
        assert _explained("fit").pull[kind][limb] == pytest.approx(secant, abs=0.05, rel=0.02)


def test_the_mirror_image_is_pulled_the_other_way():
    mirrored = explain(_graph(), Prior(), _solver("fit"), -_best("fit").depth)
    for kind, pull in _explained("fit").pull.items():
        assert mirrored.energy[kind] == pytest.approx(_explained("fit").energy[kind], abs=1e-4)
        np.testing.assert_allclose(mirrored.pull[kind], -pull, atol=1e-3)


def test_units_do_not_matter():
    large = factor_graph(small_tree().replace(xy=small_tree().xy * 1e4))
    told = explain(large, Prior(), _solver("fit"), _best("fit").depth * 1e4)
    for kind, energy in told.energy.items():
        assert energy == pytest.approx(_explained("fit").energy[kind], abs=1e-3)


def test_a_factor_of_one_s_own_is_told_under_its_name():
    told = explain(_graph(), Prior(), Elevation(factors={"forward": Forward(), "crown": None}), _best("fit").depth)
    assert "crown" not in told.energy
    np.testing.assert_allclose(told.pull["forward"], [0, 0, 3, 0, 0, 0])


def test_the_strongest_pulls_of_a_limb_come_first():
    told = _explained("fit").strongest(1, 4)
    assert len(told) == 4
    assert (np.diff([abs(pull) for _, pull in told]) <= 0).all()
    assert told[0][1] == max((pull[1] for pull in _explained("fit").pull.values()), key=abs)


def test_in_print_every_kind_has_a_line_and_its_limb_a_name():
    lines = str(_explained("fit")).splitlines()
    assert lines[0] == "kind                energy   pulls hardest at"
    assert [line.split()[0] for line in lines[1:]] == list(_explained("fit").energy)
    assert all(line.split()[2] in _graph().limb_name and line.endswith(" nats/rad)") for line in lines[1:])
