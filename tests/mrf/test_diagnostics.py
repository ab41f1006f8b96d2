"""R̂ and the effective sample size against known cases and against their slow twin."""

import numpy as np
import pytest

from sketchtree.mrf.answer.diagnostics import ess, rhat
from tests.twins import rhat as twin


def _independent(seed=0, draws=500, chains=4, quantities=6):
    return np.random.default_rng(seed).standard_normal((draws, chains, quantities))


def _autoregressive(rho, seed=0, draws=4000, chains=4):
    """x_t = ρ x_{t−1} + √(1 − ρ²) ξ, from its stationary distribution."""
    rng = np.random.default_rng(seed)
    noise = rng.standard_normal((draws, chains))
    x = np.empty_like(noise)
    x[0] = noise[0]
    for t in range(1, draws):
        x[t] = rho * x[t - 1] + np.sqrt(1 - rho**2) * noise[t]
    return x


def test_independent_draws_have_rhat_one_and_as_many_effective_draws():
    x = _independent()
    np.testing.assert_allclose(rhat(x), 1.0, atol=0.01)
    np.testing.assert_allclose(ess(x), 2000, rtol=0.15)


@pytest.mark.parametrize("rho", [-0.3, 0.5, 0.8, 0.95])
def test_autocorrelated_draws_count_as_few(rho):
    x = _autoregressive(rho)
    assert float(ess(x)) == pytest.approx(x.size * (1 - rho) / (1 + rho), rel=0.2)
    assert float(rhat(x)) < 1.05


def test_chains_that_do_not_meet_are_told():
    x = _independent()
    x[:, 0] += 5
    assert (rhat(x) > 1.5).all()
    assert (ess(x) < 20).all()


def test_chains_that_meet_in_the_middle_and_differ_in_spread_are_told():
    """What the folded R̂ is for."""
    x = _independent()
    x[:, 0] *= 8
    assert (rhat(x) > 1.1).all()


def test_a_chain_that_drifts_is_told():
    """What the splitting is for: both chains drift alike, so only their halves differ."""
    x = _independent(chains=2) + np.linspace(-3, 3, 500)[:, None, None]
    assert (rhat(x) > 1.5).all()


def test_only_ranks_count():
    x = _independent()
    np.testing.assert_allclose(ess(np.exp(3 * x)), ess(x), rtol=1e-12)


@pytest.mark.parametrize("draws, chains", [(4, 2), (5, 3), (20, 4), (33, 2)])
@pytest.mark.parametrize("world", ["independent", "autoregressive", "ties", "one chain away"])
def test_both_are_their_twins(world, draws, chains):
    x = {
        "independent": _independent(1, draws, chains, 1)[:, :, 0],
        "autoregressive": _autoregressive(0.9, 2, draws, chains),
        "ties": np.round(_independent(3, draws, chains, 1)[:, :, 0]),
        "one chain away": _independent(4, draws, chains, 1)[:, :, 0] + 4.0 * (np.arange(chains) == 0),
    }[world]
    columns = x.T.tolist()
    assert float(rhat(x)) == pytest.approx(twin.rhat(columns), rel=1e-9)
    assert float(ess(x)) == pytest.approx(twin.ess(columns), rel=1e-9)


def test_quantities_are_looked_at_one_by_one():
    x = _independent(quantities=3)
    for figure in (rhat, ess):
        np.testing.assert_allclose(figure(x), [figure(x[:, :, k]) for k in range(3)], rtol=1e-12)


def test_what_never_varies_has_neither():
    x = _independent()
    x[:, :, 2] = 0.7
    for figure in (rhat, ess):
        assert np.flatnonzero(np.isnan(figure(x))).tolist() == [2]


@pytest.mark.parametrize("draws", [0, 1, 2, 3])
def test_fewer_than_four_draws_say_nothing(draws):
    x = _independent(draws=draws)
    for figure in (rhat, ess):
        found = figure(x)
        assert found.shape == (6,) and np.isnan(found).all()


def test_four_draws_say_something():
    assert np.isfinite(rhat(_independent(draws=4))).all()
