"""The samples: what is written of them, Θ drawn from them, and what they are not."""

import importlib.util
from functools import cache

import jax
import numpy as np
import pytest

from sketchtree.errors import ExportError, InferenceError, OptionError
from sketchtree.mrf.answer.posterior import Posterior
from sketchtree.mrf.conjugate import LimbBelief, LimbTheta, draw_theta, limb_prior, theta_names
from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.log_posterior import log_posterior
from sketchtree.mrf.methods import METHODS, solver_named
from sketchtree.mrf.prior import Prior
from sketchtree.parameters import TreeParameters
from tests.mrf.drawings import lone_stroke, small_tree

H = small_tree().height


@cache
def _graph():
    return factor_graph(small_tree())


@cache
def _fit(seed=0):
    return infer(_graph(), Prior(), Elevation(), key=jax.random.key(seed))


def _posterior() -> Posterior:
    return _fit().posterior


def test_columns_are_what_interfaces_say():
    told, n = _posterior().columns(), len(_posterior())
    shapes = {name: (column.shape, column.dtype.kind) for name, column in told.items()}
    parameters = len(theta_names())
    assert shapes == {
        "z": ((n, 11), "f"),
        "theta": ((n, parameters), "f"),
        "parameter": ((parameters,), "U"),
        "apical": ((n, 11), "b"),
        "log_posterior": ((n,), "f"),
        "chain": ((n,), "i"),
        "segment_id": ((11,), "i"),
    }
    assert all(np.isfinite(column).all() for name, column in told.items() if name != "parameter")


def test_the_parameters_are_theta_s_fields_by_order():
    assert theta_names() == (
        "divergence_mean_1", "divergence_mean_2+", "divergence_sd_1", "divergence_sd_2+", "length_mean_1", "length_mean_2+", "length_sd_1",
        "length_sd_2+", "segment_mean_1", "segment_mean_2+", "segment_sd_1", "segment_sd_2+", "bend_sd_0", "bend_sd_1", "bend_sd_2+",
    )  # fmt: skip


def test_depths_are_in_sketch_units_and_a_scale_takes_them_elsewhere():
    told = _posterior().columns(np.arange(50, 70), 0.1)
    assert told["segment_id"].tolist() == list(range(50, 61))
    np.testing.assert_allclose(told["z"], 0.1 * _posterior().columns()["z"])
    psi = _posterior().elevation.reshape(len(_posterior()), -1).astype(float)
    np.testing.assert_allclose(_posterior().depth[:, 5] - _posterior().depth[:, 1], np.tan(psi[:, 5]) * _graph().length[5] * H)
    assert (_posterior().depth[:, 0] == 0).all()


def test_samples_stand_draw_by_draw_and_chain_by_chain():
    draws, chains = _posterior().value.shape
    assert _posterior().columns()["chain"].tolist() == list(range(chains)) * draws
    assert _posterior().log_posterior[chains + 2] == _posterior().value[1, 2]


def test_the_log_posterior_of_a_sample_is_that_of_its_depths():
    posterior, psi = log_posterior(_graph(), Prior()), np.zeros((5, 32), np.float32)
    psi[:, :11] = _posterior().elevation[-1, :5]
    value = jax.jit(lambda p, x: jax.vmap(lambda at: p(at))(x))(posterior, psi)
    np.testing.assert_allclose(value, _posterior().value[-1, :5], atol=1e-3)


def test_what_is_written_can_be_read_again(tmp_path):
    _posterior().write(tmp_path / "p.npz", segment_id=np.arange(3, 14), scale=2.0)
    with np.load(tmp_path / "p.npz", allow_pickle=False) as file:
        told = _posterior().columns(np.arange(3, 14), 2.0)
        assert set(file.files) == set(told)
        for name, column in told.items():
            np.testing.assert_array_equal(file[name], column)


@pytest.mark.parametrize("name", ["p.csv", "p", "npz"])
def test_another_ending_is_refused_and_nothing_is_written(tmp_path, name):
    with pytest.raises(ExportError) as raised:
        _posterior().write(tmp_path / name)
    assert str(raised.value) == f"A posterior is written as .npz, not as {name}. Let the name end in .npz."
    assert list(tmp_path.iterdir()) == []


def test_the_same_key_draws_the_same_theta_and_another_another():
    again, other = (Posterior(*_columns(), key=key) for key in (_posterior().key, jax.random.key(99)))
    np.testing.assert_array_equal(again.theta, _posterior().theta)
    assert (other.theta != _posterior().theta).all(axis=0).any()


def _columns():
    it = _posterior()
    return it.graph, it.elevation, it.value, it.answer, it.model


def test_theta_does_not_depend_on_how_many_samples_are_drawn_beside_it():
    """Beliefs are looked up in packs; the last pack is padded, and padding is never drawn."""
    graph, elevation, value, answer, model = _columns()
    few = Posterior(graph, elevation[:1, :5], value[:1, :5], answer, model, _posterior().key)
    assert few.theta.shape == (5, len(theta_names())) and np.isfinite(few.theta).all()


def test_theta_is_drawn_from_the_belief_that_its_depths_leave():
    """Means and spreads over many samples: E[θ] = E[E[θ | ψ]]."""
    it = _posterior()
    beliefs = [it.model.updated(np.pad(psi, (0, 21))) for psi in it.elevation.reshape(len(it), -1)[::40]]
    mean = np.mean([belief.divergence[0, 0] for belief in beliefs])
    found = it.theta[:, theta_names().index("divergence_mean_1")]
    assert found.mean() == pytest.approx(float(mean), abs=4 * found.std() / np.sqrt(len(found)) + 0.1)


def test_draws_have_the_moments_of_the_conjugate_posterior():
    """σ² ~ scaled Inverse-χ²(ν, s²): mean ν s²/(ν − 2); μ given σ²: mean m, so over both variance (ν s²/(ν − 2))/κ."""
    count = 40_000
    one = LimbBelief(
        divergence=np.array([[1.0, 0.8], [4.0, 9.0], [20.0, 40.0], [0.04, 0.09]]),
        length=np.array([[-1.0, -0.5], [2.0, 8.0], [24.0, 30.0], [0.2, 0.1]]),
        segment=np.array([[-2.0, -2.5], [3.0, 5.0], [22.0, 26.0], [0.3, 0.2]]),
        bend=np.array([[20.0, 30.0, 40.0], [0.02, 0.05, 0.1]]),
    )
    many = jax.tree.map(lambda x: np.broadcast_to(x, (count, *x.shape)), one)
    theta = dict(zip(theta_names(), draw_theta(many, np.random.default_rng(0)).T, strict=True))
    for kind in ("divergence", "length", "segment"):
        for k, order in enumerate(("1", "2+")):
            m, kappa, nu, s2 = getattr(one, kind)[:, k]
            mean, sd = theta[f"{kind}_mean_{order}"], theta[f"{kind}_sd_{order}"]
            variance = nu * s2 / (nu - 2)
            assert np.mean(sd**2) == pytest.approx(variance, rel=0.02)
            assert np.var(sd**2) == pytest.approx(2 * variance**2 / (nu - 4), rel=0.1)
            assert np.mean(mean) == pytest.approx(m, abs=4 * np.sqrt(variance / kappa / count))
            assert np.var(mean) == pytest.approx(variance / kappa, rel=0.03)
            assert abs(np.corrcoef(mean, sd)[0, 1]) < 0.02
    for k, order in enumerate(("0", "1", "2+")):
        nu, s2 = one.bend[:, k]
        assert np.mean(theta[f"bend_sd_{order}"] ** 2) == pytest.approx(nu * s2 / (nu - 2), rel=0.02)


def test_each_belief_is_drawn_from_once():
    belief = limb_prior(Prior(), np.float64)
    two = jax.tree.map(lambda x: np.stack([x, x]), belief)
    two = LimbBelief(two.divergence + np.array([0.0, 9.0])[:, None, None] * np.eye(4)[0][:, None], two.length, two.segment, two.bend)
    draws = draw_theta(two, np.random.default_rng(0))
    assert draws.shape == (2, len(theta_names()))
    assert draws[1, 0] > draws[0, 0] + 4
    assert len(LimbTheta._fields) == 7


def test_the_answer_is_not_among_the_samples():
    away = np.abs(_posterior().depth - _fit().depth).max(axis=1)
    assert away.min() > 1e-3 * H
    np.testing.assert_allclose(_posterior().answer * H, _fit().depth)


def test_odds_of_sides_are_the_same_for_the_mirrored_answer():
    graph, elevation, value, answer, model = _columns()
    mirrored = Posterior(graph, -elevation, value, -answer, model, _posterior().key)
    np.testing.assert_array_equal(mirrored.intervals.same_side_odds, _posterior().intervals.same_side_odds)
    np.testing.assert_array_equal(mirrored.intervals.q50, _posterior().intervals.q50)
    for one, other in ((1, 2), (2, 3), (1, 5)):
        assert mirrored.same_side(one, other) == _posterior().same_side(one, other) == _posterior().same_side(other, one)
    assert _posterior().same_side(2, 2) == 1.0


def test_rhat_and_ess_are_the_worst_over_segments_and_e():
    it = _posterior()
    from sketchtree.mrf.answer import diagnostics

    told = np.concatenate([it.steepness[:, :, 1:], it.value[:, :, None]], axis=2)
    assert it.rhat == pytest.approx(np.max(diagnostics.rhat(told)))
    assert it.ess == pytest.approx(np.min(diagnostics.ess(told)))


def test_too_few_draws_have_neither_rhat_nor_ess():
    graph, elevation, value, answer, model = _columns()
    few = Posterior(graph, elevation[:3], value[:3], answer, model, _posterior().key)
    assert np.isnan([few.rhat, few.ess]).all()


def test_with_samples_keeps_at_least_as_many_and_never_fewer_than_before():
    for count in (1, 480, 481, 2000):
        solver = Elevation().with_samples(count, _graph())
        kept = sum(block.kept for block in solver.schedule(_graph()))
        fit_has = kept * len(_posterior()) // Elevation().keep
        assert fit_has >= max(count, len(_posterior()))
    assert Elevation().with_samples(1, _graph()).keep == Elevation().keep


def test_a_lone_stroke_has_no_posterior():
    assert infer(factor_graph(lone_stroke()), Prior(), Elevation(), key=jax.random.key(0)).posterior is None


@pytest.mark.parametrize("method", [method for method in METHODS if method != "elevation"])
def test_other_methods_have_none_to_sample(method):
    name = solver_named(method).name
    with pytest.raises(OptionError) as raised:
        solver_named(method).with_samples(10, _graph())
    assert str(raised.value) == f"The method `{name}` has no posterior to sample. Use the method `elevation`, or leave the samples out."


@pytest.mark.skipif(importlib.util.find_spec("arviz") is not None, reason="arviz is installed")
def test_without_arviz_its_absence_is_told():
    with pytest.raises(InferenceError) as raised:
        _posterior().to_arviz()
    assert str(raised.value) == "The package `arviz` is not installed. Install it: pip install arviz."


@pytest.mark.skipif(importlib.util.find_spec("arviz") is None, reason="arviz is not installed")
def test_arviz_gets_chains_and_draws():
    data = _posterior().to_arviz()
    draws, chains = _posterior().value.shape
    assert data.posterior["z"].shape == (chains, draws, 11)
    assert data.posterior["theta"].shape == (chains, draws, len(theta_names()))
    assert data.sample_stats["lp"].shape == (chains, draws)


def test_measured_theta_is_chen_s_whatever_the_samples_say():
    assert isinstance(_fit().theta, TreeParameters)
