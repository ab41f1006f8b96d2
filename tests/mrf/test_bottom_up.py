"""Chen §5.2.1: ancestral search generation by generation."""

import jax
import numpy as np
import pytest

from sketchtree.mrf.chen.bottom_up import BottomUp
from sketchtree.mrf.chen.em import log_probability, rotations_of
from sketchtree.mrf.chen.estep import Reading
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.frames import child_vector, least_rotation
from sketchtree.parameters import TreeParameters
from tests.mrf.drawings import random_tree, sketch, small_tree

KEY = jax.random.key(0)
THETA = TreeParameters(1.0, 0.3, 0.15, 0.1, 0.9, 0.2, 0.2, 0.6)


def _solve(graph, theta=THETA, **options):
    return BottomUp(**options)(graph, theta, Reading(np.zeros(len(graph)), np.zeros(len(graph), int)), KEY)


def test_labels_of_siblings_differ_and_cover_their_cases(small):
    label = _solve(small).label
    assert sorted(label[[2, 5]]) == [1, 2] and sorted(label[[3, 6, 7]]) == [1, 2, 3]
    assert label[0] == label[1] == 0


def test_bases_and_the_first_segment_of_a_stem_stay_on_the_page(small):
    depth = _solve(small).depth
    assert depth[0] == depth[1] == 0 and np.abs(depth[2:]).max() > 0


def test_one_child_is_at_its_best_elevation():
    graph = factor_graph(sketch([-1, 0, 1], [[0, 0], [0, 60], [25, 100]], [0, 0, 0]))
    reading = _solve(graph)
    best = log_probability(graph, reading, THETA)
    for dz in np.linspace(-2, 2, 201):
        assert log_probability(graph, reading._replace(depth=np.array([0, 0, dz])), THETA) <= best + 1e-6


def test_two_children_are_at_the_best_of_both_hypotheses():
    graph = factor_graph(sketch([-1, 0, 1, 1], [[0, 0], [0, 60], [25, 100], [-30, 90]], [0, 0, 0, 1]))
    reading = _solve(graph)
    best = log_probability(graph, reading, THETA)
    values = np.linspace(-2, 2, 61)
    for label in ([0, 0, 1, 2], [0, 0, 2, 1]):
        for k in (2, 3):
            for dz in values:
                depth = reading.depth.copy()
                depth[k] = dz
                swapped = Reading(depth, np.array(label))
                if label == reading.label.tolist():
                    assert log_probability(graph, swapped, THETA) <= best + 1e-6
    total = {}
    for label in ([0, 0, 1, 2], [0, 0, 2, 1]):
        flat = Reading(np.zeros(4), np.array(label))
        lifted = [[flat._replace(depth=np.where(np.arange(4) == k, dz, 0.0)) for dz in values] for k in (2, 3)]
        best_of = [max(log_probability(graph, reading, THETA) for reading in readings) for readings in lifted]
        total[tuple(label)] = sum(best_of) - log_probability(graph, flat, THETA)
    assert max(total, key=total.get) == tuple(reading.label.tolist())
    assert max(total.values()) <= best + 1e-6


def test_a_tree_made_of_theta_is_found_again():
    """Exactly the mean angles and scale: every child can reach its best, so it does."""
    sharp = TreeParameters(0.8, 0.05, 0.3, 0.05, 0.9, 0.05, 0.6, 0.1)
    frame = least_rotation(np.array([0.0, 1.0, 0.0]))
    tips = [np.zeros(3), np.array([0.0, 1.0, 0.0])]
    for label in (1, 2, 3):
        tilt, _, turn, _ = sharp.child(label, 3)
        tips.append(tips[1] + child_vector(frame, np.array(1.0), np.array(0.8), np.array(tilt), np.array(turn)))
    tips = np.array(tips)
    graph = factor_graph(sketch([-1, 0, 1, 1, 1], tips[:, :2], [0, 0, 0, 1, 2]))
    reading = _solve(graph, sharp)
    np.testing.assert_allclose(reading.depth * graph.scale, tips[:, 2], atol=2e-3)
    assert reading.label.tolist() == [0, 0, 1, 2, 3]


def test_apical_from_stroke_gives_label_1_to_the_stroke_that_goes_on():
    graph = factor_graph(random_tree(1, 9))
    label = _solve(graph, apical_from_stroke=True).label
    assert (label[graph.is_apical & (label > 0)] == 1).all()


def test_the_jacobian_makes_depths_shallower():
    graph = factor_graph(small_tree())
    assert np.abs(_solve(graph, jacobian=True).depth).sum() < np.abs(_solve(graph).depth).sum()


@pytest.mark.parametrize("limbs", [0, 1, 40])
def test_every_size_is_finite_and_no_steeper_than_asked(limbs):
    graph = factor_graph(random_tree(2, limbs))
    depth = _solve(graph).depth
    rise = np.abs(depth - depth[np.maximum(graph.parent, 0)])[~graph.is_base]
    assert (rise <= graph.length[~graph.is_base] * np.tan(np.radians(80)) + 1e-9).all()


def test_sixty_siblings_at_one_node():
    fan = np.linspace(-1.3, 1.3, 60)
    xy = [[0, 0], [0, 50], *np.c_[40 * np.sin(fan), 50 + 40 * np.cos(fan)]]
    graph = factor_graph(sketch([-1, 0] + [1] * 60, xy, [0, 0, 0, *range(1, 60)]))
    reading = _solve(graph)
    assert sorted(reading.label[2:]) == list(range(1, 61)) and np.isfinite(reading.depth).all()


def test_rotations_see_the_labels(small):
    seen = rotations_of(small, _solve(small))
    assert seen.row.tolist() == [2, 3, 4, 5, 6, 7, 8, 9, 10] and seen.child_count.tolist() == [2, 3, 2, 2, 3, 3, 2, 2, 2]
