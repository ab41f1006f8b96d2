"""Many drawings, or one under many hypotheses, side by side.

Drawings that share a bucket share one compiled program, mapped over a drawing axis; a pack holds up to `PACK` of them, filled up with
the last one so that the program is always the same. Each drawing's random numbers come from its own key, not from what it is
packed with. A program over several drawings rounds otherwise than one over one, and a proposal that is taken or not by the last bit makes another
chain: the answers are as good as those of `infer`, not the same bytes.
"""

from collections.abc import Sequence

import jax
import numpy as np
from jaxtyping import Array, Key

from sketchtree.errors import OptionError
from sketchtree.mrf.compilation import compiled
from sketchtree.mrf.elevation import Elevation
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.infer import Fit, Run
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.sampling import chains
from sketchtree.mrf.sampling.teams import block_of

PACK = 4


def infer_many(
    graphs: Sequence[FactorGraph],
    priors: Sequence[Prior] | Prior,
    solver: Elevation,
    *,
    keys: Sequence[Key[Array, ""]],
    alternatives: int = 0,
) -> list[Fit]:
    """A fit for every graph, in their order; same keys, same graphs, same bytes.

    `priors` is one for all or one each, `keys` one each. A solver with factors, a start, locks or a polish of its own works on
    one drawing: its runs are one by one.
    """
    priors = [priors] * len(graphs) if isinstance(priors, Prior) else list(priors)
    if not len(priors) == len(keys) == len(graphs):
        raise OptionError(f"There are {len(graphs)} graphs, {len(priors)} priors and {len(keys)} keys.", remedy="Give as many of each.")
    runs = [Run(graph, prior, solver, key, compile_first=False) for graph, prior, key in zip(graphs, priors, keys, strict=True)]
    alone = bool(solver.factors or solver.locked) or solver.start is not None or solver.polish is not None
    packs: dict[tuple, list[Run]] = {}
    for run in runs:
        if run.over or alone:
            for _ in run:
                pass
            continue
        shapes = tuple((leaf.shape, str(leaf.dtype)) for leaf in jax.tree.leaves((run.state.posterior, run.state.moves, run.state.chains)))
        packs.setdefault((shapes, len(solver.schedule(run.graph))), []).append(run)
    for same in packs.values():
        for first in range(0, len(same), PACK):
            _together(same[first : first + PACK], solver)
    return [run.fit(alternatives, throw=False) for run in runs]


def _together(runs: list[Run], solver: Elevation) -> None:
    """All blocks of one pack."""
    full = runs + [runs[-1]] * (PACK - len(runs))
    while not runs[0].over:
        block = solver.schedule(runs[0].graph)[runs[0].state.block]
        parts = [(r.state.posterior, r.state.moves, r.state.chains, block_of(r.step_key(), r.state.chains, len(r.graph), block.temperature, teams=1)) for r in full]
        stacked = jax.tree.map(lambda *x: np.stack(x), *((p, m, c, b.draws) for p, m, c, b in parts))
        arguments = (*stacked, *parts[0][3][1:])
        after, path, values = jax.tree.map(np.asarray, compiled(_mapped, *arguments, name="pack")(*arguments))
        for k, run in enumerate(runs):
            state, info = solver.taken(run.graph, run.state, block, jax.tree.map(lambda x, k=k: x[k], after), path[k], values[k])
            run.take(state, info)


def _mapped(posterior, moves, state, draws, temperature, kind):
    return jax.vmap(chains.run, in_axes=(0, 0, 0, 0, None, None))(posterior, moves, state, draws, temperature, kind)


