"""How do depths follow when one thing was changed by hand?

What is settled stays where it is (`locked`), what was touched is sampled again beside it, from where it was if it was anywhere; what is held is held. With nothing
settled and nothing held this is plain inference.
"""

import dataclasses
from dataclasses import dataclass

import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.editing.edits import Edits, Held
from sketchtree.editing.limbs import LimbLine, LimbLines
from sketchtree.editing.part import part_of, reachable
from sketchtree.editing.settled import Settled
from sketchtree.editing.touched import carried, touched
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.infer import Fit, Run, infer
from sketchtree.mrf.measure import measured_theta
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.sampling.locks import STEEPEST
from sketchtree.mrf.solver import RESULTS
from sketchtree.sketch.graph import SketchGraph

_NEAR = 0.04  # share of a limb: the node so near a held place is held
QUICK = {"burn": (), "keep": 1, "cool": (0.05,), "chain_count": 8}  # the shortest run of `elevation` that still finds a side


@dataclass(frozen=True, eq=False)
class Settling:
    """Depths after a change."""

    fit: Fit
    touched: frozenset[int]  # ids of the limbs that were solved
    warnings: tuple[str, ...] = ()


def settle(
    graph: SketchGraph, factors: FactorGraph, prior: Prior, solver, *, edits: Edits, settled: Settled, key: Key[Array, ""], quick: bool = False, alternatives: int = 0,
    open_all: bool = False,
) -> Settling:
    """Depths of the rows of `graph` (above the ground), sketch units. `solver` is what would solve the whole drawing; only `elevation` can hold depths.

    `quick` takes the shortest run that still finds a side for what was touched; with `open_all` everything counts as touched, and starts where it was. Raises
    InferenceError."""
    lines = LimbLines.of(graph)
    every = frozenset(line.limb for line in lines.lines)
    moving = every if open_all or alternatives or not len(settled) else touched(lines, settled, edits)
    if (not len(settled) and not edits.held) or solver.name != "elevation":
        return Settling(infer(factors, prior, solver, key=key, alternatives=alternatives, throw=False), moving)
    start = carried(lines, settled)
    locked, start, warnings = _locks(lines, edits, moving, start, factors.scale)
    if all(line.limb not in moving or set(line.rows) <= locked.keys() for line in lines.lines):
        depth = np.array([locked.get(row, start[row]) for row in range(len(graph))])
        return Settling(_as_fit(factors, prior, depth, lines, settled, solver), moving, warnings)
    free = np.isin(graph.limb_id, list(moving))
    whole = bool(free.all())
    part, rows = (factors, np.arange(len(graph))) if whole else part_of(factors, free)
    place = {int(row): k for k, row in enumerate(rows)}
    near = reachable(factors, start / factors.scale) * factors.scale
    begin = near[rows] if np.isfinite(start[~graph.is_base]).any() else None
    options = {"start": begin, "locked": {place[row]: float(near[row]) for row in locked if row in place}}
    if quick:
        fit = _hurried(part, prior, dataclasses.replace(solver, **options, **QUICK), key)
    else:
        fit = infer(part, prior, dataclasses.replace(solver, **options), key=key, alternatives=alternatives, throw=False)
    return Settling(_merged(fit, factors, prior, rows, locked, start, lines, settled, moving, whole, quick), moving, warnings)


def _hurried(part: FactorGraph, prior: Prior, solver, key: Key[Array, ""]) -> Fit:
    """As `infer`, without what only a person who looks closely asks for: other readings, samples, Θ."""
    run = Run(part, prior, solver, key, compile_first=False)
    for _ in run:
        pass
    depth = np.asarray(solver.depth(part, run.state), np.float64)
    finite = np.isfinite(depth)
    result = RESULTS.converged if finite.all() else RESULTS.not_finite
    sd = np.asarray(solver.depth_sd(part, run.state), np.float64) * part.scale
    return Fit(np.where(finite, depth, 0.0) * part.scale, sd, prior.theta, prior.theta, result, None, len(run.rows), 0.0, solver.name)


def _locks(lines: LimbLines, edits: Edits, moving, start, scale: float):
    """(row → z of all that stays, where the rest starts, what could not be held as asked)."""
    locked, told = {}, []
    depth = np.array(start)
    for line in lines.lines:  # parents first
        held = edits.held.get(line.limb)
        if line.limb not in moving:
            locked.update(zip(line.rows.tolist(), depth[line.rows].tolist(), strict=True))
            if held is None or not held.whole:
                continue
        if held is not None:
            rows, wanted = _held_rows(line, held)
            kept = _within_reach(line, rows, wanted, depth[line.foot], lines.graph)
            if np.abs(kept - wanted).max(initial=0.0) > 1e-6 * scale:
                told.append(f"Stroke {_name(lines.graph, line)} is held farther from the page than its line can reach; it goes as far as it can.")
            depth[rows] = kept
            locked.update(zip(rows.tolist(), kept.tolist(), strict=True))
    return locked, depth, tuple(told)


def _held_rows(line: LimbLine, held: Held):
    """(rows of a limb that are held, z of each)."""
    if held.whole:
        return line.rows, np.interp(line.share, held.share, held.depth)
    found: dict[int, float] = {}
    for share, depth in zip(held.share, held.depth, strict=True):
        nearest = int(np.argmin(np.abs(line.share - share)))
        found[int(line.rows[nearest])] = float(depth)
    rows = np.array(sorted(found), np.int64)
    return rows, np.array([found[int(row)] for row in rows])


def _within_reach(line: LimbLine, rows, wanted, foot: float, graph: SketchGraph):
    """The depths wanted, each brought to where the line can go at its steepest from the one before."""
    reach = 0.98 * np.tan(STEEPEST)
    foot = 0.0 if np.isnan(foot) else foot
    straight = np.linalg.norm(graph.xy[line.rows] - graph.start[line.rows], axis=1)
    along = np.cumsum(np.maximum(straight, 1e-3 * graph.height))
    kept, last, at = [], foot, 0.0
    for row, z in zip(rows, wanted, strict=True):
        here = along[np.searchsorted(line.rows, row)]
        most = (here - at) * reach
        kept.append(float(np.clip(z, last - most, last + most)))
        last, at = kept[-1], here
    return np.array(kept)


def _name(graph: SketchGraph, line: LimbLine) -> str:
    return graph.stroke_ids[graph.stroke[line.rows[0]]]


def _as_fit(factors: FactorGraph, prior: Prior, depth, lines: LimbLines, settled: Settled, solver) -> Fit:
    """The answer where nothing was left to find."""
    theta = measured_theta(factors, depth / factors.scale, prior.theta)
    return Fit(depth, _sd(lines, settled), theta, prior.theta, RESULTS.converged, None, 0, 0.0, solver.name)


def _merged(fit: Fit, factors, prior, rows, locked, start, lines, settled, moving, whole, hurried) -> Fit:
    """The fit of a part as one of the whole drawing: what is locked is where it is to be, to the last bit, and what is free rises from there."""
    free = np.isin(lines.graph.limb_id[lines.graph.limb], list(moving))
    depth, sd = np.where(np.isfinite(start), start, 0.0), _sd(lines, settled)
    found = np.zeros(len(depth))
    found[rows] = fit.depth
    for row in rows.tolist():  # parents first
        above = factors.parent[row]
        if row in locked or above < 0:
            depth[row] = locked.get(row, depth[row])
        else:
            depth[row] = depth[above] + found[row] - found[above]
    sd[rows] = np.where(free[rows], fit.depth_sd, sd[rows])
    theta = prior.theta if hurried else measured_theta(factors, depth / factors.scale, prior.theta)
    others = tuple(reading._replace(depth=_with_locks(reading.depth, rows, locked)) for reading in fit.alternatives)
    return dataclasses.replace(
        fit, depth=depth, depth_sd=sd, theta=theta, posterior=fit.posterior if whole else None, overlaps=rows[fit.overlaps], alternatives=others
    )


def _with_locks(depth, rows, locked: dict[int, float]):
    """Another reading's depths, with what is held to the last bit."""
    return np.array([locked.get(int(row), float(z)) for row, z in zip(rows, depth, strict=True)])


def _sd(lines: LimbLines, settled: Settled) -> Float[np.ndarray, " segment"]:
    """Standard deviations that are known from before, sketch units."""
    sd = np.where(lines.graph.is_base, 0.0, np.nan)
    for line in lines.lines:
        known = settled.limbs.get(line.limb)
        if known is not None:
            sd[line.rows] = np.interp(line.share, known.share, known.sd)
    return sd
