"""How deep is each segment? The one loop that runs every solver.

The loop owns the step limit, the check that depths are finite, the trace and the clock. What the
solver compiles first is not on the clock.
"""

import time
from dataclasses import dataclass, field

import jax
import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.errors import InferenceError
from sketchtree.keys import stage_key
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.measure import measured_theta
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.solver import RESULTS, AbstractSolver
from sketchtree.parameters import TreeParameters


@dataclass(frozen=True, eq=False)
class Fit:
    """One inferred set of depths, and how it came about."""

    depth: Float[np.ndarray, " segment"]  # z of every tip, sketch units, towards the viewer; 0 at a base
    depth_sd: Float[np.ndarray, " segment"]  # posterior standard deviation, sketch units; NaN unknown
    theta: TreeParameters  # Chen's Θ measured on the result, or as the solver learnt it
    theta_before: TreeParameters  # Θ of the prior
    result: RESULTS  # how the run ended; its sentence is RESULTS[result]
    log_posterior: float | None  # nats, up to a constant; None where the method has no posterior
    steps: int
    seconds_warm: float  # solving, compilation left out
    method: str
    trace: dict[str, Float[np.ndarray, " step"]] = field(default_factory=dict)  # one column a field of Info


def infer(
    graph: FactorGraph,
    prior: Prior,
    solver: AbstractSolver,
    *,
    key: Key[Array, ""],
    max_steps: int | None = None,
    throw: bool = True,
) -> Fit:
    """Run `solver` until it terminates, or for `max_steps` (None: the solver's own limit).

    With `throw`, a run that did not converge raises `InferenceError` with the result's sentence;
    without, the sentence's member is in `Fit.result` and non-finite depths are set to 0.
    """
    limit = solver.default_steps if max_steps is None else max_steps
    solver.compile(graph, prior)
    clock = time.perf_counter()
    state = solver.init(graph, prior, stage_key(key, "init"))
    step_key = stage_key(key, "step")
    rows, steps = [], 0
    while steps < limit and not solver.terminate(graph, prior, state):
        state, info = solver.step(graph, prior, state, jax.random.fold_in(step_key, steps))
        rows.append(info._asdict())
        steps += 1
    result = RESULTS.converged if solver.terminate(graph, prior, state) else RESULTS.out_of_steps
    depth = np.asarray(solver.depth(graph, state), np.float64)
    seconds = time.perf_counter() - clock
    finite = np.isfinite(depth)
    if not finite.all():
        result, depth = RESULTS.not_finite, np.where(finite, depth, 0.0)
    if throw and result != RESULTS.converged:
        raise _error(result, solver)
    return Fit(
        depth=depth * graph.scale,
        depth_sd=np.asarray(solver.depth_sd(graph, state), np.float64) * graph.scale,
        theta=solver.theta(graph, prior, state) or measured_theta(graph, depth, prior.theta),
        theta_before=prior.theta,
        result=result,
        log_posterior=solver.log_posterior(graph, prior, state),
        steps=steps,
        seconds_warm=seconds,
        method=solver.name,
        trace=_columns(rows),
    )


def _columns(rows: list[dict]) -> dict[str, np.ndarray]:
    return {name: np.array([float(row[name]) for row in rows]) for name in (rows[0] if rows else ())}


def _error(result: RESULTS, solver: AbstractSolver) -> InferenceError:
    cause, _, remedy = str(RESULTS[result]).partition(". ")
    return InferenceError(f"The method `{solver.name}` did not finish: {cause[0].lower()}{cause[1:]}.", remedy=remedy)
