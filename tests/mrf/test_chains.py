"""The chains sample the posterior they are given, and their moves do what they say."""

import itertools

import jax
import numpy as np
import pytest

from sketchtree.mrf.sampling import chains, proposals
from sketchtree.mrf.compilation import compiled
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.log_posterior import log_posterior
from sketchtree.mrf.padding import bucket
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.sampling.teams import KINDS
from tests.mrf.drawings import random_tree, sketch, small_tree

CHAINS, BLOCK = 24, 40


def _run(graph, blocks, seed=0, temperature=1.0):
    """ψ after every step of several blocks (step, chain, row), and the chains at the end."""
    segments, limbs = bucket(graph)
    posterior, moves = log_posterior(graph, Prior()), proposals.moves(graph, segments, limbs)
    state = chains.start(np.zeros((CHAINS, segments), np.float32))
    heat = np.full(BLOCK, temperature, np.float32)
    kind = np.resize(np.array(KINDS, np.int32), BLOCK)
    paths = []
    for block in range(blocks):
        key = jax.random.fold_in(jax.random.key(seed), block)
        draws = proposals.draw(key, BLOCK, CHAINS, len(graph), segments)
        arguments = (posterior, moves, state, draws, heat, kind)
        state, path, _ = compiled(chains.run, *arguments, name="chains")(*arguments)
        paths.append(np.asarray(path)[:, :, : len(graph)])
    return np.concatenate(paths), state


def test_samples_have_the_moments_of_the_enumerated_posterior():
    """Two unknowns that matter: a lateral and the trunk below it."""
    graph = factor_graph(sketch([-1, 0, 1], [[0, 0], [0, 60], [35, 90]], [0, 0, 1]))
    posterior = log_posterior(graph, Prior())
    trunk, lateral = np.linspace(-0.4, 0.4, 61), np.linspace(-1.39, 1.39, 241)
    grid = np.zeros((61 * 241, 32), np.float32)
    grid[:, 1:3] = list(itertools.product(trunk, lateral))
    value = np.asarray(jax.jit(lambda p, x: jax.vmap(lambda at: p(at))(x))(posterior, grid), float)
    weight = np.exp(value - value.max())
    weight /= weight.sum()
    path, _ = _run(graph, 32)
    samples = path[200:].reshape(-1, 3)
    for expect, found in (
        (weight @ np.abs(grid[:, 2]), np.abs(samples[:, 2]).mean()),
        (weight @ grid[:, 2] ** 2, (samples[:, 2] ** 2).mean()),
        (weight @ np.abs(grid[:, 1]), np.abs(samples[:, 1]).mean()),
    ):
        assert found == pytest.approx(expect, rel=0.06)
    assert abs(samples[:, 2].mean()) < 0.12 * np.abs(samples[:, 2]).mean()


def test_every_state_stays_within_eighty_degrees_and_bases_stay_at_zero():
    graph = factor_graph(small_tree())
    path, state = _run(graph, 3, temperature=4.0)
    assert np.abs(path).max() < np.radians(80)
    assert (path[:, :, 0] == 0).all()
    assert np.isfinite(state.value).all()


def test_cold_chains_climb():
    graph = factor_graph(small_tree())
    _, warm = _run(graph, 4)
    _, cold = _run(graph, 4, temperature=0.02)
    assert np.median(cold.value) > np.median(warm.value)


def _draws(**numbers):
    return proposals.Draws(**({"noise": np.zeros(32), "limb": 0.0, "kind": 0.0, "partner": 0, "shift": 0.3, "accept": 0.0} | numbers))


@pytest.mark.parametrize(
    "kind, rows, expected",
    [
        (0.1, [5, 9], -0.4),  # limb 1 alone
        (0.4, [5, 9, 10], -0.4),  # with what grows on it
        (0.9, [5, 9], 0.7),  # shifted
    ],
)
def test_mirror_moves_change_one_limb(kind, rows, expected):
    graph = factor_graph(small_tree())
    posterior = log_posterior(graph, Prior())
    moves = proposals.moves(graph, *bucket(graph))
    psi = np.full(32, 0.4, np.float32)
    moved = np.asarray(proposals.mirror(moves, posterior.page, psi, _draws(kind=kind, limb=0.0)))
    changed = np.flatnonzero(moved != psi)
    assert changed.tolist() == rows
    np.testing.assert_allclose(moved[changed], expected, rtol=1e-6)


def test_a_mirror_move_undoes_itself():
    graph = factor_graph(random_tree(2, 9))
    posterior, moves = log_posterior(graph, Prior()), proposals.moves(graph, *bucket(graph))
    psi = np.random.default_rng(0).normal(size=32).astype(np.float32)
    for limb in np.linspace(0, 0.99, 7):
        draws = _draws(kind=0.5, limb=limb)
        twice = proposals.mirror(moves, posterior.page, proposals.mirror(moves, posterior.page, psi, draws), draws)
        np.testing.assert_array_equal(twice, psi)


def test_a_segment_is_turned_with_all_that_grows_on_it():
    graph = factor_graph(small_tree())
    posterior, moves = log_posterior(graph, Prior()), proposals.moves(graph, *bucket(graph))
    psi = np.full(32, 0.4, np.float32)
    for u, rows in ((0.45, [5, 9, 10]), (0.85, [9]), (0.25, [3, 4, 8])):  # of rows 1 … 10
        moved = np.asarray(proposals.mirror(moves, posterior.page, psi, _draws(kind=0.6, limb=u)))
        assert np.flatnonzero(moved != psi).tolist() == rows


def test_an_exchange_swaps_a_subtree_and_undoes_itself():
    graph = factor_graph(small_tree())
    posterior, moves = log_posterior(graph, Prior()), proposals.moves(graph, *bucket(graph))
    one, other = np.random.default_rng(0).normal(size=(2, 32)).astype(np.float32)
    for kind, side in ((0.2, 1), (0.8, -1)):
        draws = _draws(kind=kind, limb=0.45)
        a, b = (np.asarray(proposals.exchange(moves, posterior.page, *pair, draws)) for pair in ((one, other), (other, one)))
        np.testing.assert_array_equal(a[[5, 9, 10]], side * other[[5, 9, 10]])
        np.testing.assert_array_equal(np.delete(a, [5, 9, 10]), np.delete(one, [5, 9, 10]))
        np.testing.assert_array_equal(np.asarray(proposals.exchange(moves, posterior.page, a, b, draws)), one)


@pytest.mark.parametrize("count, teams", [(24, 2), (5, 1), (6, 2)])
def test_partners_are_mutual_and_of_one_team(count, teams):
    partner = proposals.draw(jax.random.key(0), 7, count, 3, 32, teams).partner
    for team in np.split(partner, teams, axis=1) if count % teams == 0 else [partner]:
        me = np.broadcast_to(np.arange(team.shape[1]), team.shape)
        np.testing.assert_array_equal(np.take_along_axis(team, team.astype(int), axis=1), me)
        assert (team == me).sum(axis=1).tolist() == [team.shape[1] % 2] * 7


def test_held_rows_are_never_turned_nor_exchanged():
    graph = factor_graph(small_tree())
    held = np.isin(np.arange(11), [1, 5])
    moves = proposals.moves(graph, *bucket(graph), held=held)
    assert not {1, 5} & set(np.asarray(moves.segment)[: int(moves.segment_count)].tolist())
    assert 1 not in np.asarray(moves.lateral)[: int(moves.lateral_count)]
    assert (np.asarray(moves.pace)[[1, 5]] == 0).all()


def test_trunks_are_never_mirrored():
    moves = proposals.moves(factor_graph(small_tree()), 32, 8)
    assert moves.lateral[:5].tolist() == [1, 2, 3, 4, 5]
    assert moves.lateral_count == 5


def test_the_numbers_of_a_row_do_not_depend_on_the_padding():
    key = jax.random.key(3)
    narrow, wide = (proposals.draw(key, 4, 2, 11, segments) for segments in (32, 64))
    np.testing.assert_array_equal(narrow.noise[:, :, :11], wide.noise[:, :, :11])
    np.testing.assert_array_equal(narrow.accept, wide.accept)
    assert not wide.noise[:, :, 11:].any()


def test_the_langevin_ratio_is_that_of_its_gaussian():
    moves = proposals.moves(factor_graph(small_tree()), 32, 8)
    rng = np.random.default_rng(0)
    psi, gradient = rng.normal(size=(2, 32)).astype(np.float32) * (np.asarray(moves.pace) > 0)
    noise = rng.normal(size=32).astype(np.float32) * (np.asarray(moves.pace) > 0)
    y = proposals.langevin(moves, psi, gradient, 0.3, 2.0, _draws(noise=noise))
    log_q = proposals.langevin_log_density(moves, y, psi, gradient, 0.3, 2.0)
    assert float(log_q) == pytest.approx(-0.5 * np.sum(noise**2), rel=1e-4)
