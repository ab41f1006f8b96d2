"""Answers that improve: the first at once, the last that of `infer`, and nothing runs on."""

import threading
from functools import cache

import jax
import numpy as np
import pytest

from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import factor_graph
from sketchtree.mrf.infer import infer, refine
from sketchtree.mrf.methods import METHODS, solver_named
from sketchtree.mrf.okabe import Okabe
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.solver import RESULTS
from tests.mrf.drawings import lone_stroke, small_tree

KEY = jax.random.key(0)


class _Counting(Elevation):
    """Tells a list of every step it takes."""

    told: list = None

    def step(self, graph, prior, state, key):
        self.told.append(state.block)
        return super().step(graph, prior, state, key)


def _answers(solver, sketch=small_tree):
    return refine(factor_graph(sketch()), Prior(), solver, key=KEY)


@cache
def _all():
    return list(_answers(Elevation()))


@cache
def _whole():
    return infer(factor_graph(small_tree()), Prior(), Elevation(), key=KEY)


def test_the_first_answer_comes_before_any_step():
    told = []
    first = next(_answers(_Counting(told=told)))
    assert told == [] and first.steps == 0
    assert np.ptp(first.depth) > 0.1 * small_tree().height
    np.testing.assert_array_equal(first.depth, infer(factor_graph(small_tree()), Prior(), Okabe(), key=KEY).depth)


def test_there_is_an_answer_after_every_step():
    assert [fit.steps for fit in _all()] == list(range(Elevation().default_steps + 1))


def test_the_log_posterior_never_falls():
    assert _all()[0].log_posterior is None
    assert (np.diff([fit.log_posterior for fit in _all()[1:]]) >= 0).all()


def test_every_answer_is_a_tree():
    for fit in _all():
        assert np.isfinite(fit.depth).all() and fit.depth[0] == 0
        assert np.abs(fit.depth).max() < 1.5 * small_tree().height


def test_only_the_last_answer_has_converged():
    assert [fit.result for fit in _all()] == [RESULTS.out_of_steps] * Elevation().default_steps + [RESULTS.converged]


def test_the_last_answer_is_infer_s_to_the_byte():
    last, whole = _all()[-1], _whole()
    assert last.depth.tobytes() == whole.depth.tobytes()
    assert last.depth_sd.tobytes() == whole.depth_sd.tobytes()
    assert (last.log_posterior, last.theta, last.result) == (whole.log_posterior, whole.theta, whole.result)
    for name, column in whole.trace.items():
        np.testing.assert_array_equal(last.trace[name], column)


def test_whoever_stops_leaves_nothing_running():
    told, threads = [], threading.active_count()
    answers = _answers(_Counting(told=told))
    for fit in answers:
        if fit.steps == 2:
            break
    answers.close()
    assert told == [0, 1]
    assert threading.active_count() == threads
    assert list(answers) == []


def test_a_limit_of_steps_holds_here_too():
    fits = list(refine(factor_graph(small_tree()), Prior(), Elevation(), key=KEY, max_steps=2))
    assert [fit.steps for fit in fits] == [0, 1, 2]
    assert fits[-1].result == RESULTS.out_of_steps
    assert fits[-1].depth.tobytes() == _all()[2].depth.tobytes()


def test_spread_and_samples_come_as_soon_as_some_are_kept():
    burn = len(Elevation().burn)
    assert all(fit.posterior is None and np.isnan(fit.depth_sd).all() for fit in _all()[: burn + 1])
    counts = [len(fit.posterior) for fit in _all()[burn + 1 :]]
    assert counts[0] > 0 and (np.diff(counts) >= 0).all()


@pytest.mark.parametrize("method", METHODS)
def test_every_method_refines_to_its_own_answer(method):
    solver = solver_named(method)
    last = list(_answers(solver))[-1]
    whole = infer(factor_graph(small_tree()), Prior(), solver, key=KEY)
    assert last.result == RESULTS.converged
    assert last.depth.tobytes() == whole.depth.tobytes()


def test_a_lone_stroke_is_answered_once():
    (only,) = _answers(Elevation(), lone_stroke)
    assert (only.depth == 0).all() and only.result == RESULTS.converged
