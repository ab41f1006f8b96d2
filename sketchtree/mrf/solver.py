"""What is a solver, and how can a run end?

A solver is three small functions that `infer` calls in one loop, and one that reads the depths off:

    init(graph, prior, key) → State          step(graph, prior, state, key) → (State, Info)
    terminate(graph, prior, state) → bool    depth(graph, state) → depths, H = 1

`State` is only what the next step needs; `Info` is what a person would plot, and no solver reads it.
A solver that improves another holds it as a field. Classes are abstract or final.
"""

import abc
from typing import Any, NamedTuple

import equinox as eqx
import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.errors import OptionError
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.prior import Prior
from sketchtree.parameters import TreeParameters


class RESULTS(eqx.Enumeration):
    """How a run ended, each with its sentence: `RESULTS[result]`."""

    converged = ""
    out_of_steps = (
        "Depths were still moving after the last step. Raise `max_steps`, or look for strokes that "
        "overlap on the page."
    )
    not_finite = (
        "A depth is not a finite number. Look for strokes of zero length or far outside the drawing, "
        "or use the method `okabe`, which needs no optimisation."
    )


class Info(NamedTuple):
    """What one step reports; a solver may report any record of numbers."""

    log_posterior: float  # nats, up to a constant; NaN where the solver has no posterior
    moved: float  # Σ|z(t+1) − z(t)|, H = 1


class AbstractSolver(eqx.Module):
    """Finds the depth of every segment. H, the drawn height, is 1 inside; z towards the viewer.

    Invariants that every solver keeps: a base has depth 0; a lone stroke has depth 0 everywhere;
    the same graph, prior and key give the same depths.
    """

    @property
    @abc.abstractmethod
    def name(self) -> str:
        """The method's name on the command line."""

    @property
    @abc.abstractmethod
    def default_steps(self) -> int:
        """The step limit where the caller gives none."""

    @abc.abstractmethod
    def init(self, graph: FactorGraph, prior: Prior, key: Key[Array, ""]) -> Any:
        """The first state."""

    @abc.abstractmethod
    def step(self, graph: FactorGraph, prior: Prior, state: Any, key: Key[Array, ""]) -> tuple[Any, Any]:
        """One step: the next state, and what a person would plot (a NamedTuple of numbers)."""

    @abc.abstractmethod
    def terminate(self, graph: FactorGraph, prior: Prior, state: Any) -> bool:
        """True when the state needs no further step."""

    @abc.abstractmethod
    def depth(self, graph: FactorGraph, state: Any) -> Float[np.ndarray, " segment"]:
        """Depth of every tip, H = 1; 0 at a base."""

    def compile(self, graph: FactorGraph, prior: Prior) -> None:
        """Make ready whatever `init` and `step` need that does not depend on the drawing; `infer`
        leaves it out of `seconds_warm`."""
        return None

    def with_samples(self, count: int, graph: FactorGraph) -> "AbstractSolver":
        """The same solver, keeping at least `count` samples. Raises `OptionError` where the method has none."""
        raise OptionError(f"The method `{self.name}` has no posterior to sample.", remedy="Use the method `elevation`, or leave the samples out.")

    def depth_sd(self, graph: FactorGraph, state: Any) -> Float[np.ndarray, " segment"]:
        """Posterior standard deviation of every depth, H = 1; NaN where the solver has none."""
        return np.full(len(graph), np.nan)

    def log_posterior(self, graph: FactorGraph, prior: Prior, state: Any) -> float | None:
        """Log posterior of the result in nats, up to a constant; None where there is none."""
        return None

    def theta(self, graph: FactorGraph, prior: Prior, state: Any) -> TreeParameters | None:
        """Θ as the solver learnt it; None: it is measured on the result."""
        return None

    def posterior(self, graph: FactorGraph, state: Any, depth: Float[np.ndarray, " segment"], key: Key[Array, ""]) -> Any:
        """The samples that led to `depth` (H = 1), an `answer.posterior.Posterior`; None where the solver has none."""
        return None

    def readings(self, graph: FactorGraph, state: Any, count: int, *, mirrors: bool = False) -> list:
        """Up to `count` distinct readings (`answer.readings.Reading`, H = 1), the answer first; empty where the solver
        knows of one only."""
        return []
