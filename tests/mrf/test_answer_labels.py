"""Labels are drawn where the reader joined two strokes, and only there."""

import dataclasses

import numpy as np
import pytest

from sketchtree.mrf.answer.labels import apical_labels, questions
from sketchtree.mrf.conjugate import theta_names
from sketchtree.mrf.factor_graph import factor_graph
from tests.mrf.drawings import sketch, small_tree


def _fork(joined: bool):
    """A trunk that forks into one straight child, joined to it, and one at 60°."""
    xy = [[0, 0], [0, 50], [0, 100], [43, 75]]
    graph = factor_graph(sketch([-1, 0, 1, 1], xy, [0, 0, 0, 1]))
    return dataclasses.replace(graph, is_joined=np.array([False, False, joined, False]))


def _theta(count):
    values = {"bend_sd": 0.2, "divergence_mean": 1.0, "divergence_sd": 0.2}
    return {name: np.full(count, values.get(name.rsplit("_", 1)[0], 1.0)) for name in theta_names()}


def test_a_drawn_stroke_asks_no_question():
    assert questions(_fork(joined=False)) == []
    labels = apical_labels(_fork(joined=False), np.zeros((5, 4)), _theta(5), np.random.default_rng(0))
    assert (labels == [False, False, True, False]).all()


def test_a_joined_stroke_competes_with_what_grows_there():
    assert [rows.tolist() for rows in questions(_fork(joined=True))] == [[2, 3]]


def test_the_straight_child_is_apical_with_the_odds_of_the_formula():
    graph, count = _fork(joined=True), 4000
    psi = np.zeros((count, 4))
    psi[:, 2] = 0.62  # the straight one leans out of the page, so that both may be it
    labels = apical_labels(graph, psi, _theta(count), np.random.default_rng(1))
    assert (labels[:, 2] != labels[:, 3]).all()

    def score(a):
        continues = -0.5 * (a / 0.2) ** 2 - 2 * np.log(0.2)
        return continues + 0.5 * ((a - 1.0) / 0.2) ** 2 + np.log(0.2) + np.log(np.sin(a) + 0.02)

    straight, aside = score(0.62), score(np.arccos(25 / np.hypot(43, 25)))
    expected = 1 / (1 + np.exp(aside - straight))
    assert 0.01 < expected < 0.99 or expected > 0.9
    assert labels[:, 2].mean() == pytest.approx(expected, abs=0.02)


def test_bases_and_known_rows_keep_their_labels():
    graph = factor_graph(small_tree())
    labels = apical_labels(graph, np.zeros((3, len(graph))), _theta(3), np.random.default_rng(0))
    assert (labels == graph.is_apical).all()
