"""Chen §4, cases 1-3, and the K! hypotheses of §5.2.1."""

import numpy as np
import pytest

from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.chen.labels import best_labels, families, label_parameters, log_joint
from sketchtree.parameters import GENERIC, TreeParameters
from tests.mrf.drawings import lone_stroke, sketch
from tests.twins.chen_model import best_permutation, log_eq2

THETA = TreeParameters(1.1, 0.4, 0.2, 0.1, 0.8, 0.25, 0.3, 0.7)


def test_case_1_an_only_child_is_apical():
    assert [column.tolist() for column in label_parameters(THETA, 1)] == [[0.2], [0.1], [0.3], [0.7]]


def test_case_2_the_lateral_stands_opposite():
    np.testing.assert_allclose(label_parameters(THETA, 2).mu_orientation, [0.3, 0.3 + np.pi])


@pytest.mark.parametrize("k", [3, 4, 7])
def test_case_3_laterals_stand_evenly_about_the_parent(k):
    label = label_parameters(THETA, k)
    np.testing.assert_allclose(label.mu_orientation[1:], 0.3 + 2 * np.pi * np.arange(1, k) / (k - 1))
    np.testing.assert_allclose(label.mu_divergence, [0.2] + [0.8] * (k - 1))
    np.testing.assert_allclose(label.sigma_divergence, [0.1] + [0.25] * (k - 1))


@pytest.mark.parametrize("k", [1, 2, 3, 5])
def test_eq2_agrees_with_the_slow_twin(k):
    rng = np.random.default_rng(k)
    s, tilt, turn = rng.uniform(0.2, 3, k), rng.uniform(0, 3, k), rng.uniform(-3.1, 3.1, k)
    fast = log_joint(s[:, None], tilt[:, None], turn[:, None], label_parameters(THETA, k), THETA)
    slow = [[log_eq2(s[c], tilt[c], turn[c], label + 1, k, THETA) for label in range(k)] for c in range(k)]
    np.testing.assert_allclose(fast, slow)


@pytest.mark.parametrize("k", [1, 2, 3, 4, 5])
def test_the_assignment_is_the_best_of_all_permutations(k):
    for seed in range(20):
        score = np.random.default_rng(seed).normal(size=(k, k))
        chosen = best_labels(score)
        total, order = best_permutation(score.tolist())
        assert chosen.tolist() == list(order)
        assert score[np.arange(k), chosen].sum() == pytest.approx(total)


def test_sixty_siblings_get_sixty_labels():
    chosen = best_labels(np.random.default_rng(0).normal(size=(60, 60)))
    assert sorted(chosen.tolist()) == list(range(60))


def test_families_are_the_children_of_one_segment(small):
    table = families(small)
    assert [sorted(f.child.tolist()) for g in table.generations for f in g] == [[2, 5], [3, 6, 7], [9, 10], [4, 8]]
    assert table.child_count.tolist() == [0, 0, 2, 3, 2, 2, 3, 3, 2, 2, 2]
    assert table.above[1] == -1


def test_a_limb_that_leaves_the_stem_at_the_ground_is_no_apical_child():
    graph = factor_graph(sketch([-1, 0, 0, 1], [[0, 0], [0, 50], [30, 30], [0, 100]], [0, 0, 1, 0]))
    (ground, *_), *_ = families(graph).generations
    assert (ground.above, ground.child.tolist(), ground.first_label, ground.label_count) == (1, [2], 2, 2)


def test_a_lone_stroke_is_a_chain_of_only_children():
    counts = families(factor_graph(lone_stroke())).child_count
    assert counts.tolist() == [0, 0, 1, 1, 1]


def test_generic_theta_has_every_label_case():
    assert len(label_parameters(GENERIC, 12).mu_orientation) == 12
