"""Which solver stands behind a method's name on the command line?"""

import importlib

from sketchtree.errors import OptionError
from sketchtree.mrf.solver import AbstractSolver

_SOLVER = {  # method → module and class
    "elevation": ("elevation", "Elevation"),
    "chen": ("chen.method", "Chen"),
    "chen-fixed": ("chen.method", "Chen"),
    "okabe": ("okabe", "Okabe"),
    "random-sign": ("baselines", "RandomSign"),
    "flat": ("baselines", "Flat"),
}
METHODS = tuple(_SOLVER)
_LEARNS_THETA = {"elevation", "chen"}


def solver_named(name: str, *, theta: str = "fit", planar: bool = False) -> AbstractSolver:
    """The solver of that name (one of `METHODS`).

    `theta`: "fit" learns Θ from the sketch, "fixed" insists on the prior's; methods without a Θ take
    either. `planar`: the drawing shows a tree grown flat (an espalier); only `elevation` has it.
    Raises `OptionError` for an unknown name or an option that the method can't follow.
    """
    if name not in _SOLVER:
        raise OptionError(f"There is no method `{name}`.", remedy=f"Use one of {', '.join(METHODS)}.")
    if theta not in ("fit", "fixed"):
        raise OptionError(f"`theta={theta}` is neither `fit` nor `fixed`.", remedy="Use one of the two.")
    if planar and name != "elevation":
        raise OptionError(f"The method `{name}` has no `planar`.", remedy="Use the method `elevation`, or leave `planar` out.")
    module, solver = _SOLVER[name]
    options = {}
    if name in _LEARNS_THETA or name == "chen-fixed":
        options["theta_mode"] = "fixed" if name == "chen-fixed" else theta
    if name == "elevation":
        options["planar"] = planar
    return getattr(importlib.import_module(f"sketchtree.mrf.{module}"), solver)(**options)
