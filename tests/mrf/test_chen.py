"""The paper's method as a whole."""

import jax
import numpy as np
import pytest

from sketchtree.mrf.chen.move_apart import MoveApart
from sketchtree.mrf.chen.bottom_up import BottomUp
from sketchtree.mrf.chen.method import Chen
from sketchtree.mrf.chen.em import EM
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.chen.icm import ICM
from sketchtree.mrf.infer import infer
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.solver import RESULTS
from sketchtree.parameters import GENERIC
from tests.mrf.drawings import lone_stroke, random_tree, sketch

KEY = jax.random.key(0)
MODES = ("fit", "fixed")


@pytest.mark.parametrize("mode", MODES)
def test_it_converges_and_leaves_stems_at_the_root(small, mode):
    fit = infer(small, Prior(), Chen(mode), key=KEY)
    assert fit.result == RESULTS.converged and np.isfinite(fit.depth).all()
    assert fit.depth[0] == fit.depth[1] == 0 and np.abs(fit.depth).max() > 0
    assert fit.method == {"fit": "chen", "fixed": "chen-fixed"}[mode]


def test_fixed_theta_is_insisted_on(small):
    assert infer(small, Prior(), Chen("fixed"), key=KEY).theta == GENERIC
    assert infer(small, Prior(), Chen("fit"), key=KEY).theta != GENERIC


def test_the_same_key_gives_the_same_depths(small):
    first, again = (infer(small, Prior(), Chen(), key=KEY).depth for _ in range(2))
    np.testing.assert_array_equal(first, again)


@pytest.mark.parametrize("mode", MODES)
def test_a_lone_stroke_stays_on_the_page(mode):
    assert (infer(factor_graph(lone_stroke()), Prior(), Chen(mode), key=KEY).depth == 0).all()


def test_the_mirrored_drawing_gives_the_same_depths_before_theta_turns():
    graph = random_tree(3, 8)
    mirrored = graph.replace(xy=graph.xy * [-1, 1])
    solver = EM(e_step=(BottomUp(), MoveApart()), learn=False)
    here, there = (np.abs(infer(factor_graph(g), Prior(), solver, key=KEY).depth) for g in (graph, mirrored))
    np.testing.assert_allclose(here, there, atol=1e-4 * graph.height)


def test_parts_can_be_exchanged(small):
    solver = EM(e_step=(BottomUp(apical_from_stroke=True, jacobian=True), MoveApart(), ICM(tol=0.001)))
    assert np.isfinite(infer(small, Prior(), solver, key=KEY).depth).all()


def test_the_trace_says_how_theta_moved(small):
    trace = infer(small, Prior(), Chen(), key=KEY).trace
    assert set(trace) == {"log_posterior", "moved", "mu_s", "mu_alpha", "mu_beta", "mu_gamma"}


@pytest.mark.parametrize(
    "xy",
    [
        [[0, 0], [0, 50], [0, 50], [20, 80]],  # a doubled point
        [[0, 0], [0, 50], [0, 100], [0, 80]],  # a limb drawn over the trunk
        [[0, 0], [0, 1e6], [0, 2e6], [4e5, 1.6e6]],  # huge units
        [[0, 0], [0, -50], [0, -100], [30, -80]],  # upside down
    ],
)
def test_awkward_drawings_stay_finite(xy):
    graph = factor_graph(sketch([-1, 0, 1, 1], xy, [0, 0, 0, 1]))
    assert np.isfinite(infer(graph, Prior(), Chen(), key=KEY).depth).all()
