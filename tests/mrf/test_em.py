"""Chen §5.3: Eq. 3, the M-step, and the rounds."""

import jax
import numpy as np
import pytest

from sketchtree.mrf.chen.bottom_up import BottomUp
from sketchtree.mrf.chen.em import EM, FLOORS, Rotations, log_probability, maximise, rotations_of
from sketchtree.mrf.chen.estep import Reading
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.prior import Prior
from sketchtree.parameters import GENERIC
from tests.mrf.drawings import lone_stroke, random_tree
from tests.twins.chen_model import log_eq2

KEY = jax.random.key(1)


def _seen(scale, tilt, turn, label, count) -> Rotations:
    n = len(scale)
    columns = (np.arange(n), scale, tilt, turn, label, np.broadcast_to(count, n))
    return Rotations(*(np.array(column) for column in columns))


def test_eq3_log_posterior_is_the_sum_over_all_pairs():
    graph = factor_graph(random_tree(6, 9))
    reading = BottomUp()(graph, GENERIC, Reading(np.zeros(len(graph)), np.zeros(len(graph), int)), KEY)
    seen = rotations_of(graph, reading)
    columns = zip(seen.scale, seen.tilt, seen.turn, seen.label, seen.child_count, strict=True)
    slow = sum(log_eq2(s, a, b, int(label), int(k), GENERIC) for s, a, b, label, k in columns)
    assert log_probability(graph, reading, GENERIC) == pytest.approx(slow)


def test_the_m_step_takes_averages_and_standard_deviations():
    seen = _seen([1.0, 2.0, 0.6, 0.9], [0.1, 0.3, 0.8, 1.2], [0.2, 0.4, 0.3 + np.pi, 0.5 + np.pi], [1, 1, 2, 2], 2)
    theta = maximise(seen, GENERIC)
    assert theta.mu_s == pytest.approx(np.mean(seen.scale)) and theta.sigma_s == pytest.approx(np.std(seen.scale))
    assert theta.mu_alpha == pytest.approx(0.2) and theta.sigma_alpha == pytest.approx(0.1)
    assert theta.mu_beta == pytest.approx(1.0) and theta.sigma_beta == pytest.approx(0.2)
    assert theta.mu_gamma == pytest.approx(0.35)


def test_gamma_is_averaged_round_the_circle():
    seen = _seen([1, 1, 1], [0.2, 0.2, 0.2], [np.pi - 0.1, -np.pi + 0.1, np.pi], [1, 1, 1], 1)
    theta = maximise(seen, GENERIC)
    assert abs(theta.mu_gamma) == pytest.approx(np.pi)
    assert theta.sigma_gamma < 0.15


def test_the_turn_that_a_label_asks_for_is_taken_off():
    k = 5
    label = np.arange(1, k + 1)
    turn = 0.7 + np.where(label == 1, 0, 2 * np.pi * (label - 1) / (k - 1))
    theta = maximise(_seen(np.ones(k), np.full(k, 0.5), turn, label, k), GENERIC)
    assert theta.mu_gamma == pytest.approx(0.7) and theta.sigma_gamma == FLOORS["gamma"]


def test_sigmas_have_floors():
    theta = maximise(_seen([1, 1, 1, 1], [0.1, 0.1, 0.9, 0.9], [0, 0, np.pi, np.pi], [1, 1, 2, 2], 2), GENERIC)
    found = (theta.sigma_s, theta.sigma_alpha, theta.sigma_beta, theta.sigma_gamma)
    assert found == (0.05, 0.03, 0.03, 0.1)


def test_what_was_not_seen_twice_stays_as_it_was():
    theta = maximise(_seen([1.0, 2.0], [0.1, 0.9], [0.0, np.pi], [1, 2], 2), GENERIC)
    assert (theta.mu_alpha, theta.mu_beta) == (GENERIC.mu_alpha, GENERIC.mu_beta)
    nothing = maximise(_seen([], [], [], np.array([], int), 1), GENERIC)
    assert nothing == GENERIC


def test_fixed_theta_is_one_round():
    graph, solver = factor_graph(random_tree(7, 5)), EM(e_step=(BottomUp(),), learn=False)
    state, _ = solver.step(graph, Prior(), solver.init(graph, Prior(), KEY), KEY)
    assert solver.terminate(graph, Prior(), state) and state.theta == GENERIC


def test_theta_moves_from_the_prior_to_the_drawing():
    graph, solver = factor_graph(random_tree(8, 12)), EM(e_step=(BottomUp(),))
    state, info = solver.step(graph, Prior(), solver.init(graph, Prior(), KEY), KEY)
    assert state.theta == maximise(rotations_of(graph, state.reading), GENERIC) != GENERIC
    assert np.isfinite(info.log_posterior)


def test_the_rounds_are_limited():
    graph, solver = factor_graph(random_tree(9, 6)), EM(e_step=(BottomUp(),), rounds=3)
    state = solver.init(graph, Prior(), KEY)
    rounds = 0
    while not solver.terminate(graph, Prior(), state):
        state, _ = solver.step(graph, Prior(), state, KEY)
        rounds += 1
    assert rounds <= 3


def test_a_lone_stroke_stays_on_the_page():
    graph, solver = factor_graph(lone_stroke()), EM(e_step=(BottomUp(),))
    state, _ = solver.step(graph, Prior(), solver.init(graph, Prior(), KEY), KEY)
    assert (state.reading.depth == 0).all()
