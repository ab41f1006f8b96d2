"""A factor of the user's own: any object with `log_potential(assignment, theta)`, written in jax.

    class Wall:                                      # nothing grows nearer to the viewer than z = .2 H
        def log_potential(self, assignment, theta):
            return -0.5 * (jnp.maximum(assignment.tip.z - 0.2, 0) / 0.02) ** 2

    infer(graph, prior, Elevation(factors={"wall": Wall()}), key=key)

It returns one number a factor, nats, in one axis. Rows of `assignment` are those of the graph and then padding
(`is_segment` is False there); H = 1, the first base at 0, angles in radians. `theta` is Θ at its posterior mean given these
depths. A class that needs the drawing is given as it is, `{"wall": Wall}`, and called with the `FactorGraph`.

An `equinox.Module` may hold arrays: other values in them need no new compilation. Anything else is part of the program.
"""

import pickle
from functools import lru_cache
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from sketchtree.errors import InferenceError
from sketchtree.mrf.factor_graph import FactorGraph

TRIALS = (0.0, 0.3, -0.6)  # ψ of every limb at which a factor is tried before the run


class Own(eqx.Module):
    """The user's object as a kind of factor: its arrays are columns, all else belongs to the program."""

    name: str = eqx.field(static=True)
    columns: Any
    rest: Any = eqx.field(static=True)

    def log_potential(self, assignment, theta) -> Float[Array, " factor"]:
        """What the user's object says."""
        given = self.rest.value if isinstance(self.rest, _Held) else eqx.combine(self.columns, self.rest)
        return given.log_potential(assignment, theta)


class _Held:
    """An object that jax need not look into; the same only as itself, and as long as its attributes are what they were."""

    def __init__(self, value):
        self.value = value
        try:
            self.attributes = pickle.dumps(vars(value))
        except Exception:  # they can't be told: a program of its own each time
            self.attributes = object()

    def __eq__(self, other):
        return isinstance(other, _Held) and other.value is self.value and other.attributes == self.attributes

    def __hash__(self):
        return hash(id(self.value))


def own_factor(name: str, given: Any, posterior, graph: FactorGraph) -> Own:
    """`given`, an object or what makes one from the graph, tried and wrapped.

    Raises `InferenceError` naming the factor, and the segment where there is one, for an object without
    `log_potential`, one that fails, returns another shape, or a number that is no potential (NaN or +∞).
    """
    if isinstance(given, type) or not hasattr(given, "log_potential"):
        if not callable(given):
            raise _error(name, "has no `log_potential(assignment, theta)`", "Give an object that has, or a class that makes one from the factor graph.")
        given = _made(given, graph)
        if not hasattr(given, "log_potential"):
            raise _error(name, "made an object without `log_potential(assignment, theta)`", "Return an object that has one.")
    own = _wrapped(name, given)
    if not is_ours(given):
        _try(own, posterior, graph)
    return own


def is_ours(given: Any) -> bool:
    """A factor of the program itself: tests try it, and its source is among those by which kept programs are told apart (`mrf.compilation`)."""
    return type(given).__module__.startswith("sketchtree.mrf.")


@lru_cache(maxsize=8)
def _made(make, graph: FactorGraph) -> Any:
    """What `make` makes of a drawing, once: a run asks twice, to compile and to begin."""
    return make(graph)


def _wrapped(name, given) -> Own:
    if isinstance(given, eqx.Module):
        columns, rest = eqx.partition(given, eqx.is_array)
        try:
            hash(rest)
        except TypeError:
            return Own(name, None, _Held(given))
        return Own(name, columns, rest)
    return Own(name, None, _Held(given))


def _try(own: Own, posterior, graph: FactorGraph) -> None:
    rows = np.arange(len(posterior.page.length))
    told = []
    for psi in TRIALS:
        start = np.where(np.asarray(posterior.page.is_segment), psi * (1 + 0.3 * np.sin(rows)), 0.0)
        elevation = jnp.asarray(start, posterior.page.length.dtype)
        assignment = posterior.page.assign(elevation)
        theta = posterior.belief.updated(posterior.data(assignment)).mean()
        try:
            jax.eval_shape(own.log_potential, assignment, theta)  # as it will be compiled
            value = own.log_potential(assignment, theta)
        except InferenceError:
            raise
        except Exception as fault:
            raise _error(own.name, f"failed: {type(fault).__name__}: {fault}", "Write `log_potential` with jax.numpy, for arrays of any length.") from fault
        _check(own.name, value, graph)
        told.append(float(jnp.sum(value)))
    if not np.isfinite(told).any():
        raise _error(own.name, "rules out every depth that was tried (−∞)", "Let it fall off smoothly, so that the search can find its way in.")


def _check(name, value, graph: FactorGraph) -> None:
    if not isinstance(value, jax.Array | np.ndarray) or value.ndim != 1 or not jnp.issubdtype(value.dtype, jnp.floating):
        shape = getattr(value, "shape", None)
        what = type(value).__name__ if shape is None else f"an array of shape {tuple(shape)} and type {value.dtype}"
        raise _error(name, f"returned {what}", "Return one real number a factor, in an array with one axis.")
    bad = np.flatnonzero(np.isnan(np.asarray(value)) | np.isposinf(np.asarray(value)))
    if len(bad):
        at = int(bad[0])
        where = f"factor {at}" if at >= len(graph) else f"factor {at} (segment {at}, stroke {graph.limb_name[graph.limb[at]]})"
        raise _error(name, f"returned {float(value[at])} for {where}", "Guard divisions, logarithms and roots: padded rows have length 0.")


def _error(name, what, remedy) -> InferenceError:
    return InferenceError(f"The factor `{name}` {what}.", remedy=remedy)
