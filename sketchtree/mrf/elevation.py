"""The default method: elevations, sampled with mirror moves, Θ learnt on the way.

Many chains start from random limbs, cool to T = 1 (burn-in), are kept for a while at T = 1 (samples), and are cooled to the best
tree. The model is `log_posterior`, a step `chains`, what is shown `typical`; Θ is integrated out in `conjugate`.

One step of this solver is a block of 40 chain steps at one temperature, so that a bucket needs one small program. From a
`start`, as while somebody draws, most of the burn-in is left out, and its signs are kept unless others are much likelier.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import equinox as eqx
import jax
import numpy as np
from jaxtyping import Array, Bool, Float, Key

from sketchtree.errors import InferenceError
from sketchtree.mrf.answer.interpenetration import moved_apart
from sketchtree.mrf.answer.posterior import Posterior
from sketchtree.mrf.answer.readings import Reading, distinct_readings
from sketchtree.mrf.answer.typical import most_typical, typical_readings
from sketchtree.mrf.depths import depth_of, elevation_of
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.factors.own import is_ours
from sketchtree.mrf.log_posterior import LogPosterior, log_posterior, own_energy
from sketchtree.mrf.okabe import Okabe
from sketchtree.mrf.padding import bucket
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.sampling import chains
from sketchtree.mrf.sampling.chains import Chains
from sketchtree.mrf.sampling.locks import held_depths
from sketchtree.mrf.sampling.proposals import Draws, Moves, moves
from sketchtree.mrf.sampling.start import starts
from sketchtree.mrf.sampling.teams import BLOCK, TEAMS, BlockOfSteps, block_of, in_teams
from sketchtree.mrf.solver import AbstractSolver

LARGE = ((4096, 2), (16384, 4))  # above so many rows only every second, every fourth block is run
LEADING = 4  # one in so many of the cooled chains, the likeliest, proposes its signs
THIN = 10  # chain steps between kept samples
BROKEN = 2.0  # nats that typical steepness may cost in the user's own factors before the tree itself is shown
ALIKE = 0.005  # share of the depth of all limbs: two trees that are about as loyal to a `start`
LOYAL = 8.0  # nats that another tree must be likelier before the signs of a `start` are given up


class State(NamedTuple):
    """The chains, what was kept of them, and where in the schedule they are."""

    posterior: LogPosterior | None  # None: nothing to infer
    moves: Moves | None
    chains: Chains | None
    samples: tuple[Float[np.ndarray, "draw chain segment"], ...]  # ψ
    values: tuple[Float[np.ndarray, "draw chain"], ...]  # E
    block: int
    best: Float[np.ndarray, " segment"]  # ψ of the best tree so far
    best_value: float  # its E; −inf before the first block
    held: Bool[np.ndarray, " segment"]
    start: Float[np.ndarray, " segment"] | None  # ψ to begin with, NaN where it is not known


class Block(NamedTuple):
    """Chain steps that belong together."""

    temperature: float
    kept: bool  # their states are samples


class Info(NamedTuple):
    """What a block did."""

    log_posterior: float  # of the best chain, nats
    median_log_posterior: float
    temperature: float
    step_length: float  # ε, median over the chains
    moved: float  # Σ|ψ(t+1) − ψ(t)| over a chain, mean over the chains


class Elevation(AbstractSolver):
    """The model of repaired factors over elevations ψ; the default."""

    theta_mode: str = "fit"  # "fit": Θ is learnt; "fixed": it stays the prior's
    planar: bool = False  # the tree grew flat
    factors: Mapping[str, Any] = eqx.field(default_factory=dict)  # the user's, by name; see `log_posterior`
    start: Any = None  # z of every row to begin with, sketch units, NaN where it is not known
    locked: Mapping[int, float] = eqx.field(default_factory=dict)  # row → z of its tip, sketch units
    typical: bool = True  # show `answer.typical`; False: the best tree itself
    chain_count: int = 24  # fewer on drawings above 256 rows
    burn: tuple[float, ...] = (1.7, 1.0, 1.0)  # temperature of each block
    keep: int = 7  # blocks at temperature 1 whose states are samples
    cool: tuple[float, ...] = (0.3, 0.05, 1e-4)
    polish: Any = None  # an `optimistix.AbstractMinimiser` to run after cooling; costs a second program

    @property
    def name(self) -> str:
        return "elevation"

    @property
    def default_steps(self) -> int:
        return len(self.burn) + self.keep + len(self.cool)

    def with_samples(self, count: int, graph: FactorGraph) -> "Elevation":
        """The same solver, keeping at least `count` samples of this drawing (and no fewer than it would anyway)."""
        a_block = (self._chain_count(bucket(graph)[0]) - self._resting) * (BLOCK // THIN)
        every = max([1, *(thin for rows, thin in LARGE if len(graph) > rows)])
        return eqx.tree_at(lambda solver: solver.keep, self, max(self.keep, every * -(-count // a_block)))

    def schedule(self, graph: FactorGraph) -> list[Block]:
        """What the blocks do; drawings of thousands of segments have fewer, and so has a run from a `start`."""
        every = max([1, *(thin for rows, thin in LARGE if len(graph) > rows)])
        hot = self.burn if self.start is None else self.burn[-1:]
        burn, cool = ([Block(t, False) for t in heat[::-1][::every][::-1]] for heat in (hot, self.cool))
        return [*burn, *[Block(1.0, True)] * -(-self.keep // every), *cool]

    def compile(self, graph: FactorGraph, prior: Prior) -> None:
        if graph.limb_spreads.any() or self.locked:
            self._run(graph, self.init(graph, prior, jax.random.key(0)), jax.random.key(0), 1.0, compile_only=True)

    def init(self, graph: FactorGraph, prior: Prior, key: Key[Array, ""]) -> State:
        nothing, free = np.zeros(len(graph)), np.zeros(len(graph), bool)
        if not graph.limb_spreads.any() and not self.locked:
            return State(None, None, None, (), (), 0, nothing, 0.0, free, None)
        learns = self.theta_mode == "fit"
        posterior = log_posterior(graph, prior, learns=learns, planar=self.planar, factors=self.factors)
        known, held = self._known(graph)
        segments, limbs = len(posterior.page.length), posterior.page.limb_count
        start = starts(graph, key, self._chain_count(segments), segments, known=known, held=held)
        best = nothing if known is None else np.nan_to_num(known)
        return State(posterior, moves(graph, segments, limbs, held=held), chains.start(start), (), (), 0, best, -np.inf, held, known)

    def _known(self, graph: FactorGraph):
        """(ψ to begin with or None, which rows are held)."""
        depth = None
        if self.start is not None:
            depth = np.asarray(self.start, float) / graph.scale
            if depth.shape != (len(graph),) or np.isinf(depth).any():
                raise InferenceError(
                    f"`start` has the shape {depth.shape}, or a depth that is infinite.", remedy=f"Give {len(graph)} depths, NaN where none is known."
                )
            depth = np.where(graph.is_base, 0.0, depth)
        held = np.zeros(len(graph), bool)
        if self.locked:
            locks = {row: z / graph.scale for row, z in self.locked.items()}
            told = np.where(graph.is_base, 0.0, np.nan) if depth is None else depth
            depth, held = held_depths(graph, locks, _level(graph, told))
            depth = np.where(held | np.isfinite(told), depth, np.nan)
        if depth is None:
            return None, held
        return elevation_of(graph, depth), held

    def step(self, graph: FactorGraph, prior: Prior, state: State, key: Key[Array, ""]) -> tuple[State, Info]:
        schedule = self.schedule(graph)
        block = schedule[state.block]
        after, path, values = self._run(graph, state, key, block.temperature)
        return self.taken(graph, state, block, after, path, values)

    def taken(self, graph: FactorGraph, state: State, block: Block, after: Chains, path, values) -> tuple[State, Info]:
        """The state after a block that led to `after`."""
        after = after if block.kept else _revived(after)
        samples, kept_values = state.samples, state.values
        if block.kept:
            first = self._resting
            samples = (*samples, path[THIN - 1 :: THIN, first:, : len(graph)])
            kept_values = (*kept_values, values[THIN - 1 :: THIN, first:])
        best, best_value = state.best, state.best_value
        at = np.unravel_index(np.argmax(values), values.shape)  # climbs may pass a peak
        if values[at] >= best_value:
            best, best_value = self._kept(state, path[*at, : len(graph)]), float(values[at])
        moved = float(np.abs(after.elevation - state.chains.elevation).sum(axis=1).mean())
        state = state._replace(chains=after, samples=samples, values=kept_values, block=state.block + 1, best=best, best_value=best_value)
        if state.block == len(self.schedule(graph)) and self.polish is not None:
            state = self._polished(graph, state)
        pace = float(np.exp(np.median(after.log_step)))
        return state, Info(state.best_value, float(np.median(after.value)), block.temperature, pace, moved)

    def terminate(self, graph: FactorGraph, prior: Prior, state: State) -> bool:
        return state.posterior is None or state.block >= len(self.schedule(graph))

    def depth(self, graph: FactorGraph, state: State) -> Float[np.ndarray, " segment"]:
        if state.posterior is not None and state.block == 0 and state.start is None:
            return Okabe().answer(graph)
        return self._shown(graph, state)[0]

    def _shown(self, graph: FactorGraph, state: State):
        """(the depths shown, depths of every tree that might be, their E, which of them is shown)."""
        if not (self.typical and state.samples):
            z = moved_apart(graph, depth_of(graph, state.best), held=state.held)
            return z, z[:, None], np.array([state.best_value]), 0
        order = np.argsort(-state.chains.value, kind="stable")
        cooled = state.chains.elevation[order, : len(graph)].astype(np.float64)
        trees = np.vstack([state.best, cooled])
        value = np.r_[state.best_value, np.asarray(state.chains.value, float)[order]]
        samples = _together(state.samples)
        psi, some = typical_readings(graph, samples, trees, planar=self.planar, start=state.start)
        psi = np.where(state.held[:, None], state.best[:, None], psi)
        if state.posterior.own:
            broken = own_energy(state.posterior, trees) - own_energy(state.posterior, psi.T) > BROKEN
            psi = np.where(broken, trees.T, psi)
        leading = -(-len(order) // LEADING) + 1
        chosen = most_typical(graph, psi[:, :leading], some)
        z = depth_of(graph, psi)
        if self.start is not None:
            chosen = self._loyal(graph, state, z, value, chosen)
        return moved_apart(graph, z[:, chosen], held=state.held), z, value, chosen

    def _loyal(self, graph, state, z, value, chosen):
        """The tree whose limbs lie on the sides of the start, a limb that goes far there, to and fro, counting more, unless another is much
        likelier; of those that are about as loyal the likeliest."""
        tip, at = graph.limb_tip, graph.parent[graph.limb_first]
        own = depth_of(graph, np.nan_to_num(state.start))
        side = np.where(np.isfinite(state.start[tip]) & graph.limb_spreads, np.sign(own[tip] - own[at]), 0.0)
        if not side.any():
            return chosen
        rise = np.abs(own - own[np.maximum(graph.parent, 0)])
        weight = np.abs(side) * np.bincount(graph.limb, rise, minlength=len(side))
        turned = weight @ (side[:, None] * (z[tip] - z[at]) < 0) / weight.sum()
        turned = np.where(value >= value.max() - LOYAL, turned, np.inf)
        return int(np.argmax(np.where(turned <= turned.min() + ALIKE, value, -np.inf)))

    def depth_sd(self, graph: FactorGraph, state: State) -> Float[np.ndarray, " segment"]:
        """Standard deviation of |z| over the samples: the mirror image left out."""
        if not state.samples:
            return np.full(len(graph), np.nan)
        return np.std(np.abs(depth_of(graph, _together(state.samples).T)), axis=1)

    def log_posterior(self, graph: FactorGraph, prior: Prior, state: State) -> float | None:
        return None if state.posterior is None or state.block == 0 else state.best_value

    def posterior(self, graph: FactorGraph, state: State, depth: Float[np.ndarray, " segment"], key: Key[Array, ""]) -> Posterior | None:
        if not state.samples:
            return None
        return Posterior(graph, np.concatenate(state.samples), np.concatenate(state.values), depth, state.posterior, key)

    def readings(self, graph: FactorGraph, state: State, count: int, *, mirrors: bool = False) -> list[Reading]:
        if state.posterior is None or not state.samples:
            return []
        _, trees, value, chosen = self._shown(graph, state)
        samples = depth_of(graph, _together(state.samples).T)
        found = distinct_readings(graph, trees, value, chosen, samples, count, mirrors=mirrors)
        return [reading._replace(depth=moved_apart(graph, reading.depth, held=state.held)) for reading in found]

    @property
    def _resting(self) -> int:
        """How many of the first chains are no samples."""
        return 0 if self.start is None else 1

    def _chain_count(self, segments: int) -> int:
        return TEAMS * max(1, min(self.chain_count, self.chain_count * 256 // segments) // TEAMS)

    def _run(self, graph: FactorGraph, state: State, key, temperature: float, *, compile_only: bool = False):
        """(the chains after one block, ψ and E after every step)."""
        block = block_of(key, state.chains, len(graph), temperature)
        if self.start is not None:
            block = _with_loyal_chain(block, first=state.block == 0)
        return in_teams(state.posterior, state.moves, state.chains, block, keep=all(map(is_ours, self.factors.values())), compile_only=compile_only)

    def _polished(self, graph: FactorGraph, state: State) -> State:
        from sketchtree.mrf.sampling.ascend import ascend  # takes longer to import than most drawings to solve

        best, value = ascend(state.posterior, state.best, self.polish, held=state.held)
        return state._replace(best=self._kept(state, best), best_value=value) if value > state.best_value else state

    @staticmethod
    def _kept(state: State, psi) -> Float[np.ndarray, " segment"]:
        """ψ with the held rows exact, in double precision."""
        return np.where(state.held, 0.0 if state.start is None else state.start, psi.astype(np.float64))


def _with_loyal_chain(block: BlockOfSteps, *, first: bool) -> BlockOfSteps:
    """The first chain keeps the signs of the start: it rests there while the others are hot, then climbs, and never mirrors or
    exchanges a limb. Without it no chain may end on the start's side, and there would be nothing to be loyal to."""
    draws = Draws(*(np.array(x) for x in block.draws))
    climbs = (block.kind == chains.LANGEVIN) & (block.temperature < chains.COLD)
    draws.accept[~climbs, 0] = 2.0  # never taken
    if first:  # a shift by nothing: the start is evaluated
        draws.kind[0, 0], draws.shift[0, 0], draws.accept[0, 0] = 1.0, 0.0, 0.0
    return block._replace(draws=draws)


def _revived(state: Chains) -> Chains:
    """Chains that have found no possible tree yet (a user's factor may rule some out) begin again where others are."""
    lost = ~np.isfinite(state.value)
    if lost.all() or not lost.any():
        return state
    found = np.flatnonzero(~lost)
    source = np.arange(len(lost))
    source[lost] = found[np.arange(lost.sum()) % len(found)]
    return Chains(*(np.asarray(x)[source] for x in state))


def _level(graph: FactorGraph, depth: Float[np.ndarray, " segment"]) -> Float[np.ndarray, " segment"]:
    """Depths with those of the parents where they are not known."""
    depth = depth.copy()
    for row in np.flatnonzero(np.isnan(depth)):
        depth[row] = 0.0 if graph.is_base[row] else depth[graph.parent[row]]
    return depth


def _together(samples) -> Float[np.ndarray, "sample segment"]:
    """All samples in one axis."""
    return np.concatenate(samples).reshape(-1, samples[0].shape[-1])


