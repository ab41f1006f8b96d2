"""The contract of solvers, the loop that runs them, and how a run can end."""

from typing import NamedTuple

import jax
import numpy as np
import pytest

from sketchtree.errors import InferenceError, OptionError
from sketchtree.mrf.infer import infer
from sketchtree.mrf.methods import METHODS, solver_named
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.solver import RESULTS, AbstractSolver, Info
from sketchtree.parameters import GENERIC

KEY = jax.random.key(0)


class _State(NamedTuple):
    depth: np.ndarray
    steps: int


class _Countdown(AbstractSolver):
    """Ends after `needed` steps; every tip's depth is then `end`."""

    needed: int = 3
    end: float = 0.25

    @property
    def name(self):
        return "countdown"

    @property
    def default_steps(self):
        return 10

    def init(self, graph, prior, key):
        return _State(np.zeros(len(graph)), 0)

    def step(self, graph, prior, state, key):
        depth = np.where(graph.is_base, 0.0, self.end)
        return _State(depth, state.steps + 1), Info(float(state.steps), 0.5)

    def terminate(self, graph, prior, state):
        return state.steps >= self.needed

    def depth(self, graph, state):
        return state.depth


def test_the_loop_runs_until_the_solver_terminates(small):
    fit = infer(small, Prior(), _Countdown(), key=KEY)
    assert (fit.steps, fit.result, fit.method) == (3, RESULTS.converged, "countdown")
    assert fit.trace["log_posterior"].tolist() == [0.0, 1.0, 2.0]


def test_depths_are_in_sketch_units_and_zero_at_the_base(small):
    fit = infer(small, Prior(), _Countdown(), key=KEY)
    np.testing.assert_allclose(fit.depth, np.where(small.is_base, 0, 0.25 * small.scale))


def test_theta_before_is_the_prior_s_and_after_is_measured(small):
    fit = infer(small, Prior(), _Countdown(), key=KEY)
    assert fit.theta_before == GENERIC
    assert fit.theta != GENERIC
    assert fit.seconds_warm >= 0


def test_the_step_limit_is_the_loop_s(small):
    fit = infer(small, Prior(), _Countdown(needed=99), key=KEY, max_steps=4, throw=False)
    assert (fit.steps, fit.result) == (4, RESULTS.out_of_steps)


def test_no_step_at_all_is_allowed(small):
    fit = infer(small, Prior(), _Countdown(), key=KEY, max_steps=0, throw=False)
    assert (fit.steps, fit.trace) == (0, {})


def test_running_out_of_steps_raises_its_sentence(small):
    with pytest.raises(InferenceError) as raised:
        infer(small, Prior(), _Countdown(needed=99), key=KEY)
    assert str(raised.value) == (
        "The method `countdown` did not finish: depths were still moving after the last step. "
        "Raise `max_steps`, or look for strokes that overlap on the page."
    )


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_depth_that_is_not_finite_is_caught(small, bad):
    fit = infer(small, Prior(), _Countdown(end=bad), key=KEY, throw=False)
    assert fit.result == RESULTS.not_finite
    assert (fit.depth == 0).all()
    with pytest.raises(InferenceError, match="a depth is not a finite number"):
        infer(small, Prior(), _Countdown(end=bad), key=KEY)


def test_every_result_has_its_sentence():
    assert RESULTS[RESULTS.converged] == ""
    assert RESULTS[RESULTS.out_of_steps].startswith("Depths were still moving after the last step.")
    assert RESULTS[RESULTS.not_finite].startswith("A depth is not a finite number.")


def test_methods_are_those_of_the_command_line():
    assert METHODS == ("elevation", "chen", "chen-fixed", "okabe", "random-sign", "flat")
    assert [solver_named(name).name for name in METHODS] == list(METHODS)


def test_options_reach_the_solver():
    solver = solver_named("elevation", theta="fixed", planar=True)
    assert (solver.theta_mode, solver.planar) == ("fixed", True)


@pytest.mark.parametrize(
    "arguments, message",
    [
        (("guess",), "There is no method `guess`. Use one of elevation, chen, chen-fixed, okabe, random-sign, flat."),
        (("chen", "learn"), "`theta=learn` is neither `fit` nor `fixed`. Use one of the two."),
    ],
)
def test_unknown_names_are_refused(arguments, message):
    with pytest.raises(OptionError) as raised:
        solver_named(arguments[0], **({"theta": arguments[1]} if len(arguments) > 1 else {}))
    assert str(raised.value) == message


def test_planar_belongs_to_elevation():
    with pytest.raises(OptionError, match="The method `okabe` has no `planar`."):
        solver_named("okabe", planar=True)
