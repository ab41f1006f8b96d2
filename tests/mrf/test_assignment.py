"""What follows from the elevations."""

import jax
import numpy as np
import pytest

from sketchtree.mrf.assignment import page
from sketchtree.mrf.factor_graph import factor_graph
from tests.mrf.drawings import random_tree, small_tree
from tests.twins import limb_model as twin


@pytest.mark.parametrize("make", [small_tree, lambda: random_tree(1, 9)])
def test_directions_lengths_tips_and_limb_lengths_are_the_twin_s(make, double):
    graph = factor_graph(make())
    psi = np.where(graph.is_base, 0.0, np.random.default_rng(0).normal(0, 0.5, len(graph)))
    padded = np.zeros(32)
    padded[: len(graph)] = psi
    columns = page(graph, 32, 16, np.float64)
    assignment = jax.jit(lambda c, x: c.assign(x))(columns, padded)
    direction, length, tip, limb_length = twin.vectors(graph, psi)
    n = len(graph)
    np.testing.assert_allclose(np.stack(assignment.direction, -1)[:n], direction, atol=1e-9)
    np.testing.assert_allclose(assignment.length[:n], length, atol=1e-9)
    np.testing.assert_allclose(np.stack(assignment.tip, -1)[:n], tip, atol=1e-9)
    np.testing.assert_allclose(assignment.limb_length[: graph.limb_count], limb_length, atol=1e-9)


def test_directions_are_unit_and_project_onto_the_drawing(small):
    psi = np.where(small.is_base, 0.0, 0.7)
    direction, length, *_ = twin.vectors(small, psi)
    across = np.array(direction)[:, :2] * np.array(length)[:, None]
    drawn = small.xy - small.xy[np.maximum(small.parent, 0)]
    np.testing.assert_allclose(across[~small.is_base], drawn[~small.is_base], atol=1e-9)
