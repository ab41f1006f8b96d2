"""How deep is each segment? The one loop that runs every solver.

The loop owns the step limit, the check that depths are finite, the trace and the clock. What the
solver compiles first is not on the clock. `infer` returns the last answer, `refine` every answer on the way.
"""

import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import jax
import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree.errors import InferenceError, OptionError
from sketchtree.keys import stage_key
from sketchtree.mrf.answer.readings import Reading
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.measure import measured_theta
from sketchtree.mrf.overlaps import overlapping
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
    alternatives: tuple[Reading, ...] = ()  # distinct readings, sketch units, this one first; empty if none were asked for
    posterior: Any = None  # the samples (`answer.posterior.Posterior`); None where the method has none
    overlaps: Int[np.ndarray, "pair 2"] = field(default_factory=lambda: np.zeros((0, 2), np.int64))  # rows that still pass through each other
    wanted: int = 0  # how many readings were asked for

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a person should know: limbs that still touch, readings that there are not."""
        said = []
        if len(self.overlaps):
            said.append(f"{len(self.overlaps)} pairs of drawn segments pass through each other at any depth that was tried.")
        if self.wanted > max(len(self.alternatives), 1):
            found = len(self.alternatives)
            said.append(f"{self.wanted} readings were asked for; " + (f"{found} are distinct." if found else f"the method `{self.method}` knows of one."))
        return tuple(said)


def infer(
    graph: FactorGraph,
    prior: Prior,
    solver: AbstractSolver,
    *,
    key: Key[Array, ""],
    max_steps: int | None = None,
    alternatives: int = 0,
    mirrors: bool = False,
    throw: bool = True,
) -> Fit:
    """Run `solver` until it terminates, or for `max_steps` (None: the solver's own limit).

    `alternatives`: how many distinct readings are wanted, this one included; there may be fewer. With `mirrors`, mirror images
    count as distinct. With `throw`, a run that did not converge raises `InferenceError` with the result's sentence;
    without, the sentence's member is in `Fit.result` and non-finite depths are set to 0.
    """
    if alternatives < 0:
        raise OptionError(f"`alternatives={alternatives}` is negative.", remedy="Give how many readings are wanted, 0 for none but the answer.")
    run = Run(graph, prior, solver, key, max_steps)
    for _ in run:
        pass
    return run.fit(alternatives, mirrors, throw=throw)


def refine(
    graph: FactorGraph, prior: Prior, solver: AbstractSolver, *, key: Key[Array, ""], max_steps: int | None = None
) -> Iterator[Fit]:
    """Answers that improve: the first at once, one after every step, the last that of `infer`. Whoever iterates may stop at
    any of them; nothing runs on. A run that is not over yet has the result `out_of_steps`.
    """
    run = Run(graph, prior, solver, key, max_steps)
    yield run.fit(throw=False)
    for _ in run:
        yield run.fit(throw=False)


class Run:
    """One run of a solver: iterating takes a step."""

    def __init__(self, graph, prior, solver, key, max_steps: int | None = None, *, compile_first: bool = True):
        self.graph, self.prior, self.solver, self.key = graph, prior, solver, key
        self.limit = solver.default_steps if max_steps is None else max_steps
        if compile_first:
            solver.compile(graph, prior)
        self.clock = time.perf_counter()
        self.state = solver.init(graph, prior, stage_key(key, "init"))
        self.rows: list[dict] = []

    @property
    def over(self) -> bool:
        """Whether no further step is to be taken."""
        return len(self.rows) >= self.limit or self.solver.terminate(self.graph, self.prior, self.state)

    def step_key(self) -> Key[Array, ""]:
        """The key of the next step."""
        return jax.random.fold_in(stage_key(self.key, "step"), len(self.rows))

    def take(self, state: Any, info: Any) -> None:
        """Take a step that somebody else has worked out."""
        self.state = state
        self.rows.append(info._asdict())

    def __iter__(self):
        while not self.over:
            self.take(*self.solver.step(self.graph, self.prior, self.state, self.step_key()))
            yield

    def fit(self, alternatives: int = 0, mirrors: bool = False, *, throw: bool) -> Fit:
        """The answer as it stands."""
        graph, solver, state = self.graph, self.solver, self.state
        result = RESULTS.converged if solver.terminate(graph, self.prior, state) else RESULTS.out_of_steps
        depth = np.asarray(solver.depth(graph, state), np.float64)
        seconds = time.perf_counter() - self.clock
        finite = np.isfinite(depth)
        if not finite.all():
            result, depth = RESULTS.not_finite, np.where(finite, depth, 0.0)
        if throw and result != RESULTS.converged:
            raise _error(result, solver)
        readings = solver.readings(graph, state, alternatives, mirrors=mirrors) if alternatives else []
        return Fit(
            depth=depth * graph.scale,
            depth_sd=np.asarray(solver.depth_sd(graph, state), np.float64) * graph.scale,
            theta=solver.theta(graph, self.prior, state) or measured_theta(graph, depth, self.prior.theta),
            theta_before=self.prior.theta,
            result=result,
            log_posterior=solver.log_posterior(graph, self.prior, state),
            steps=len(self.rows),
            seconds_warm=seconds,
            method=solver.name,
            trace=_columns(self.rows),
            alternatives=tuple(reading._replace(depth=reading.depth * graph.scale) for reading in readings),
            posterior=solver.posterior(graph, state, depth, stage_key(self.key, "theta")),
            overlaps=overlapping(graph, depth),
            wanted=alternatives,
        )


def _columns(rows: list[dict]) -> dict[str, np.ndarray]:
    return {name: np.array([float(row[name]) for row in rows]) for name in (rows[0] if rows else ())}


def _error(result: RESULTS, solver: AbstractSolver) -> InferenceError:
    cause, _, remedy = str(RESULTS[result]).partition(". ")
    return InferenceError(f"The method `{solver.name}` did not finish: {cause[0].lower()}{cause[1:]}.", remedy=remedy)
