"""Chen's Θ measured on a tree that was made with known rotations."""

import numpy as np
import pytest

from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.measure import measured_theta, rotations
from sketchtree.parameters import GENERIC
from tests.mrf.drawings import lone_stroke, sketch


def _turn(ry, rx):
    a, b, c, d = np.cos(ry), np.sin(ry), np.cos(rx), np.sin(rx)
    return np.array([[a, 0, b], [0, 1, 0], [-b, 0, a]]) @ np.array([[1, 0, 0], [0, c, -d], [0, d, c]])


def _grown(seed=0):
    """(parent, vectors, s, φ, ϕ): v_c = s R_p R_y(ϕ) R_x(φ) ŷ |v_p| from a trunk along y (§4)."""
    rng = np.random.default_rng(seed)
    parent = [-1, 0, 1, 1, 2, 2, 4, 5, 7]
    frame, length, vector = {1: np.eye(3)}, {1: 1.0}, {0: np.zeros(3), 1: np.array([0.0, 1, 0])}
    s, phi, turn = {}, {}, {}
    for row in range(2, len(parent)):
        s[row], phi[row], turn[row] = rng.uniform(0.5, 1.2), rng.uniform(0.1, 1.2), rng.uniform(-np.pi, np.pi)
        frame[row] = frame[parent[row]] @ _turn(turn[row], phi[row])
        length[row] = s[row] * length[parent[row]]
        vector[row] = frame[row] @ [0, length[row], 0]
    return np.array(parent), np.array([vector[k] for k in range(len(parent))]), s, phi, turn


def test_rotations_undo_section_4():
    parent, vector, s, phi, turn = _grown()
    scale, tilt, orientation, rows = rotations(parent, parent < 0, vector)
    assert rows.tolist() == list(range(2, 9))
    np.testing.assert_allclose(scale, [s[r] for r in rows], atol=1e-12)
    np.testing.assert_allclose(tilt, [phi[r] for r in rows], atol=1e-9)
    np.testing.assert_allclose(np.exp(1j * orientation), np.exp(1j * np.array([turn[r] for r in rows])), atol=1e-9)


def test_theta_is_mean_and_sd_of_the_rotations():
    parent, vector, s, phi, _ = _grown()
    tip = np.zeros((9, 3))
    for row in range(1, 9):
        tip[row] = tip[parent[row]] + vector[row]
    limb = np.array([0, 0, 0, 1, 0, 2, 0, 2, 2])
    graph = factor_graph(sketch(parent, tip[:, :2] * 100, limb))
    theta = measured_theta(graph, tip[:, 2] * 100 / graph.scale)
    apical = [2, 4, 6, 7, 8]
    assert theta.mu_s == pytest.approx(np.mean(list(s.values())), abs=1e-4)
    assert theta.mu_alpha == pytest.approx(np.mean([phi[r] for r in apical]), abs=1e-4)
    assert theta.sigma_alpha == pytest.approx(np.std([phi[r] for r in apical]), abs=1e-4)
    assert theta.mu_beta == pytest.approx(np.mean([phi[3], phi[5]]), abs=1e-4)


def test_what_a_drawing_cannot_say_stays_as_before():
    theta = measured_theta(factor_graph(lone_stroke()), np.zeros(5))
    assert (theta.mu_beta, theta.sigma_beta) == (GENERIC.mu_beta, GENERIC.sigma_beta)
    assert theta.mu_s != GENERIC.mu_s
