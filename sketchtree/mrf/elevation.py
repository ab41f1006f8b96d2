"""The default method: elevations, sampled with mirror moves, Θ learnt on the way.

Many chains start from random limbs, warm → T = 1 (burn-in), are kept for a while at T = 1 (samples), and are cooled to the best
tree. The model is `log_posterior`, a step `chains`, what is shown `typical`; Θ is integrated out in `conjugate`.

One step of this solver is a block of 40 chain steps at one temperature, so that a bucket needs one small program.
"""

from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import jax
import numpy as np
from jaxtyping import Array, Float, Key

from sketchtree.keys import normal
from sketchtree.mrf.sampling import chains
from sketchtree.mrf.sampling.chains import Chains
from sketchtree.mrf.compilation import compiled
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.answer.interpenetration import moved_apart
from sketchtree.mrf.log_posterior import LogPosterior, log_posterior
from sketchtree.mrf.padding import bucket
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.sampling.proposals import Draws, Moves, draw, moves
from sketchtree.mrf.solver import AbstractSolver
from sketchtree.mrf.answer.typical import depth_of, typical_elevation

BLOCK = 40  # chain steps a block
LARGE = ((4096, 2), (16384, 4))  # above so many rows only every second, every fourth block is run
TEAMS = 2  # the chains run in so many threads
LEADING = 4  # one in so many of the cooled chains, the likeliest, proposes its signs
THIN = 10  # chain steps between kept samples
START_SD = 0.5  # radians, of a lateral's first ψ


class State(NamedTuple):
    """The chains, what was kept of them, and where in the schedule they are."""

    posterior: LogPosterior | None  # None: nothing to infer
    moves: Moves | None
    chains: Chains | None
    samples: tuple[Float[np.ndarray, "sample segment"], ...]
    block: int
    best: Float[np.ndarray, " segment"]  # ψ of the best tree so far
    best_value: float  # its E


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
    typical: bool = True  # show median steepness and stretch; False: the best tree itself
    chain_count: int = 24  # fewer on drawings above 256 rows
    burn: tuple[float, ...] = (3.0, 1.7, 1.0)  # temperature of each block
    keep: int = 5  # blocks at temperature 1 whose states are samples
    cool: tuple[float, ...] = (0.4, 0.1, 0.02, 1e-4)
    polish: Any = None  # an `optimistix.AbstractMinimiser` to run after cooling; costs a second program

    @property
    def name(self) -> str:
        return "elevation"

    @property
    def default_steps(self) -> int:
        return len(self.burn) + self.keep + len(self.cool)

    def schedule(self, graph: FactorGraph) -> list[Block]:
        """What the blocks do; drawings of thousands of segments have fewer."""
        every = max([1, *(thin for rows, thin in LARGE if len(graph) > rows)])
        burn, cool = ([Block(t, False) for t in heat[every - 1 :: every]] for heat in (self.burn, self.cool))
        return [*burn, *[Block(1.0, True)] * -(-self.keep // every), *cool]

    def compile(self, graph: FactorGraph, prior: Prior) -> None:
        if graph.limb_spreads.any():
            state = self.init(graph, prior, jax.random.key(0))
            compiled(chains.run, *self._parts(graph, state, jax.random.key(0), 1.0)[0], name="chains")

    def init(self, graph: FactorGraph, prior: Prior, key: Key[Array, ""]) -> State:
        nothing = np.zeros(len(graph))
        if not graph.limb_spreads.any():
            return State(None, None, None, (), 0, nothing, 0.0)
        segments, limbs = bucket(graph)
        posterior = log_posterior(graph, prior, learns=self.theta_mode == "fit", planar=self.planar)
        start = _random_limbs(graph, key, self._chain_count(segments), segments)
        return State(posterior, moves(graph, segments, limbs), chains.start(start), (), 0, nothing, -np.inf)

    def step(self, graph: FactorGraph, prior: Prior, state: State, key: Key[Array, ""]) -> tuple[State, Info]:
        schedule = self.schedule(graph)
        block = schedule[state.block]
        after, path = self._run(graph, state, key, block.temperature)
        value = after.value
        leader = int(np.argmax(value))
        samples = state.samples
        if block.kept:
            samples = (*samples, path[THIN - 1 :: THIN, :, : len(graph)].reshape(-1, len(graph)))
        best, best_value = state.best, state.best_value
        if value[leader] >= best_value:
            best, best_value = after.elevation[leader, : len(graph)].astype(np.float64), float(value[leader])
        moved = float(np.abs(after.elevation - state.chains.elevation).sum(axis=1).mean())
        state = State(state.posterior, state.moves, after, samples, state.block + 1, best, best_value)
        if state.block == len(schedule) and self.polish is not None:
            state = self._polished(graph, state)
        pace = float(np.exp(np.median(after.log_step)))
        return state, Info(state.best_value, float(np.median(value)), block.temperature, pace, moved)

    def terminate(self, graph: FactorGraph, prior: Prior, state: State) -> bool:
        return state.posterior is None or state.block >= len(self.schedule(graph))

    def depth(self, graph: FactorGraph, state: State) -> Float[np.ndarray, " segment"]:
        psi = state.best
        if self.typical and state.samples:
            leading = np.argsort(-state.chains.value, kind="stable")[: -(-len(state.chains.value) // LEADING)]
            trees = np.vstack([state.best, state.chains.elevation[leading, : len(graph)].astype(np.float64)])
            psi = typical_elevation(graph, np.concatenate(state.samples), trees)
        return moved_apart(graph, depth_of(graph, psi))

    def depth_sd(self, graph: FactorGraph, state: State) -> Float[np.ndarray, " segment"]:
        """Standard deviation of |z| over the samples: the mirror image left out."""
        if not state.samples:
            return np.full(len(graph), np.nan)
        return np.std(np.abs(depth_of(graph, np.concatenate(state.samples).T)), axis=1)

    def log_posterior(self, graph: FactorGraph, prior: Prior, state: State) -> float | None:
        return None if state.posterior is None else state.best_value

    def _chain_count(self, segments: int) -> int:
        return TEAMS * max(1, min(self.chain_count, self.chain_count * 256 // segments) // TEAMS)

    def _run(self, graph: FactorGraph, state: State, key, temperature: float):
        """The chains after one block, and ψ after every step. Teams of chains run side by side, and the numbers
        are the same on any count of cores."""
        parts = self._parts(graph, state, key, temperature)
        program = compiled(chains.run, *parts[0], name="chains")
        with ThreadPoolExecutor(TEAMS) as pool:
            done = list(pool.map(lambda part: jax.tree.map(np.asarray, program(*part)), parts))
        after = Chains(*map(np.concatenate, zip(*(chains for chains, _ in done), strict=True)))
        return after, np.concatenate([path for _, path in done], axis=1)

    def _parts(self, graph: FactorGraph, state: State, key, temperature: float) -> list[tuple]:
        """What the program takes, for every team."""
        hot = np.full(BLOCK, temperature, np.float32)
        langevin = (np.arange(BLOCK) % 2).astype(np.float32)
        chain_count, segments = state.chains.elevation.shape
        draws = draw(key, BLOCK, chain_count, len(graph), segments)
        teams = np.array_split(np.arange(chain_count), TEAMS)
        each = [(Chains(*(x[team] for x in state.chains)), Draws(*(x[:, team] for x in draws))) for team in teams]
        return [(state.posterior, state.moves, chains, draws, hot, langevin) for chains, draws in each]

    def _polished(self, graph: FactorGraph, state: State) -> State:
        from sketchtree.mrf.sampling.ascend import ascend  # takes longer to import than most drawings to solve

        best, value = ascend(state.posterior, state.best, self.polish)
        return state._replace(best=best, best_value=value) if value > state.best_value else state


def _random_limbs(graph: FactorGraph, key, chain_count: int, segments: int) -> Float[np.ndarray, "chain segment"]:
    """One ψ a limb, N(0, .5); 0 on stems."""
    start = np.zeros((chain_count, segments), np.float32)
    limb = np.arange(graph.limb_count)
    for chain in range(chain_count):
        psi = np.clip(START_SD * normal(key, limb, chain), -1.2, 1.2) * graph.limb_spreads
        start[chain, : len(graph)] = np.where(graph.is_base, 0.0, psi[graph.limb])
    return start
