"""The default method from end to end. One small bucket is compiled for all of it."""

import itertools
from functools import cache

import jax
import numpy as np
import optimistix
import pytest

from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer
from sketchtree.mrf.log_posterior import log_posterior
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.solver import RESULTS
from tests.mrf.drawings import lone_stroke, random_tree, shrub, sketch, small_tree

SOLVER = Elevation()


def _fit(graph, seed=0, solver=SOLVER, prior=Prior()):
    return infer(factor_graph(graph), prior, solver, key=jax.random.key(seed))


@cache
def _small_fit():
    return _fit(small_tree())


def test_the_run_converges_and_tells_its_trace():
    fit = _small_fit()
    assert fit.result == RESULTS.converged
    assert fit.steps == SOLVER.default_steps
    assert (np.diff(fit.trace["log_posterior"]) >= 0).all()
    assert set(fit.trace) == {"log_posterior", "median_log_posterior", "temperature", "step_length", "moved"}
    assert fit.log_posterior == fit.trace["log_posterior"][-1]


def test_root_depth_stays_zero_and_laterals_leave_the_page():
    fit = _small_fit()
    assert fit.depth[0] == 0
    assert (np.abs(fit.depth[5:]) > 1).all()
    assert np.abs(fit.depth[:5]).max() < np.abs(fit.depth[5:]).max()


def test_depths_have_a_spread():
    fit = _small_fit()
    assert fit.depth_sd[0] == 0
    assert (fit.depth_sd[5:] > 0).all()


def test_same_key_same_bytes():
    assert _fit(small_tree()).depth.tobytes() == _small_fit().depth.tobytes()


def test_another_key_is_another_run():
    assert _fit(small_tree(), seed=1).depth.tobytes() != _small_fit().depth.tobytes()


@pytest.mark.parametrize("scale, shift", [(1e6, 0.0), (1e-3, 0.0), (2.5, 1234.5)])
def test_units_and_place_do_not_matter(scale, shift):
    moved = _fit(small_tree().replace(xy=small_tree().xy * scale + shift))
    np.testing.assert_allclose(moved.depth / scale, _small_fit().depth, rtol=1e-9, atol=1e-9)


def test_a_mirrored_drawing_has_the_same_depths():
    mirrored = _fit(small_tree().replace(xy=small_tree().xy * [-1, 1]))
    np.testing.assert_array_equal(np.abs(mirrored.depth), np.abs(_small_fit().depth))


def test_a_lone_stroke_lies_flat():
    fit = _fit(lone_stroke())
    assert (fit.depth == 0).all()
    assert (fit.result, fit.steps, fit.log_posterior) == (RESULTS.converged, 0, None)


def test_a_single_segment_lies_flat():
    assert (_fit(sketch([-1, 0], [[0, 0], [0, 9]], [0, 0])).depth == 0).all()


def test_a_planar_tree_is_flatter():
    flat = _fit(small_tree(), solver=Elevation(planar=True))
    assert np.ptp(flat.depth) < 0.5 * np.ptp(_small_fit().depth)


def test_a_fixed_theta_may_give_other_depths_and_never_fails():
    fixed = _fit(small_tree(), solver=Elevation(theta_mode="fixed"))
    assert np.isfinite(fixed.depth).all()
    assert fixed.depth.tobytes() != _small_fit().depth.tobytes()


def _degenerate():
    plain = small_tree()
    tiny = plain.xy.copy()
    tiny[9] = tiny[5] + 1e-9
    n = 14
    fan = [[0, 0], [0, 50], *[[np.cos(k) * 40, 60 + abs(np.sin(k)) * 40] for k in range(n)]]
    return {
        "one-sided": plain.replace(xy=np.abs(plain.xy)),
        "collinear": plain.replace(xy=np.array([[0, 10.0 * k] for k in range(11)])),
        "tiny segment": plain.replace(xy=tiny),
        "same points": plain.replace(xy=np.where(np.arange(11)[:, None] == 6, plain.xy[2], plain.xy)),
        "many siblings at one node": sketch([-1, 0] + [1] * n, fan, [0, 0, *range(1, n + 1)]),
        "downward": plain.replace(xy=plain.xy * [1, -1]),
        "lying": plain.replace(xy=plain.xy[:, ::-1].copy()),
        "a limb at the base": plain.replace(parent=np.where(np.arange(11) == 5, 0, plain.parent)),
    }


@pytest.mark.parametrize("world", list(_degenerate()))
def test_degenerate_drawings_stay_finite_and_bounded(world):
    graph = _degenerate()[world]
    fit = _fit(graph)
    assert np.isfinite(fit.depth).all()
    assert np.abs(fit.depth).max() < 3 * graph.height


def test_a_shrub_is_no_fan():
    fit = _fit(shrub())
    assert (fit.depth[:4] == 0).all()
    assert np.ptp(fit.depth) > 30
    assert np.median(np.abs(fit.depth[4:])) > 5


def test_two_trees_are_each_rooted_at_depth_zero():
    one = small_tree()
    parent = np.r_[one.parent, np.where(one.parent < 0, -1, one.parent + 11)]
    grove = sketch(parent, np.r_[one.xy, one.xy + [300, 0]], np.r_[one.limb, one.limb + 6], tree=np.repeat([0, 1], 11))
    fit = _fit(grove)
    assert fit.depth[0] == fit.depth[11] == 0
    assert np.abs(fit.depth[11:]).max() > 1


def test_the_best_of_a_grid_of_trees_is_found():
    """Three segments beside the trunk's, on 13 elevations each: no point of the grid is above the result."""
    graph = factor_graph(sketch([-1, 0, 1, 1, 1], [[0, 0], [0, 50], [30, 80], [-25, 85], [8, 95]], [0, 0, 1, 2, 0]))
    solver = Elevation(typical=False, polish=optimistix.LBFGS(rtol=1e-5, atol=1e-5))
    fit = infer(graph, Prior(), solver, key=jax.random.key(0))
    posterior = log_posterior(graph, Prior())
    values = np.radians(np.linspace(-72, 72, 13))
    grid = np.zeros((13**3, 32), np.float32)
    grid[:, 2:5] = list(itertools.product(values, values, values * 0.3))
    best = float(np.max(jax.jit(lambda p, x: jax.vmap(lambda at: p(at))(x))(posterior, grid)))
    assert fit.log_posterior >= best


def test_polishing_never_loses():
    polished = _fit(small_tree(), solver=Elevation(polish=optimistix.LBFGS(rtol=1e-5, atol=1e-5)))
    assert polished.log_posterior >= _small_fit().log_posterior
    assert polished.log_posterior - _small_fit().log_posterior < 1.5


def test_a_drawing_of_many_limbs_takes_a_larger_bucket():
    fit = _fit(random_tree(0, 12))
    assert np.isfinite(fit.depth).all()


def test_very_large_drawings_have_fewer_blocks():
    small = factor_graph(small_tree())
    large = factor_graph(random_tree(0, 2200))
    whole, thinned = SOLVER.schedule(small), SOLVER.schedule(large)
    assert len(whole) == SOLVER.default_steps
    assert len(thinned) == 2 + 4 + 2
    assert [block.temperature for block in thinned if block.kept] == [1.0] * 4
