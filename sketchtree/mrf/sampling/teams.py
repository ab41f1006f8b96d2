"""One block of chain steps, run by teams of chains side by side.

The numbers are the same on any count of cores: which team a chain belongs to never depends on them.
"""

from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import jax
import numpy as np
from jaxtyping import Array, Float, Int, Key

from sketchtree.mrf.compilation import compiled
from sketchtree.mrf.log_posterior import LogPosterior
from sketchtree.mrf.sampling import chains
from sketchtree.mrf.sampling.chains import Chains
from sketchtree.mrf.sampling.proposals import Draws, Moves, draw

BLOCK = 40  # chain steps a block
TEAMS = 2  # the chains run in so many threads
KINDS = (chains.EXCHANGE, chains.LANGEVIN, chains.EXCHANGE, chains.LANGEVIN, chains.MIRROR, chains.LANGEVIN)  # over and over; cold chains only climb


class BlockOfSteps(NamedTuple):
    """What a block needs besides the chains."""

    draws: Draws
    temperature: Float[np.ndarray, " step"]
    kind: Int[np.ndarray, " step"]  # which kind of move; see `chains`


def block_of(key: Key[Array, ""], state: Chains, rows: int, temperature: float, teams: int = TEAMS) -> BlockOfSteps:
    """The random numbers and temperatures of one block for a drawing of `rows` rows."""
    chain_count, segments = state.elevation.shape
    hot = np.full(BLOCK, temperature, np.float32)
    kinds = np.resize(np.array(KINDS if temperature >= chains.COLD else (chains.LANGEVIN,), np.int32), BLOCK)
    return BlockOfSteps(draw(key, BLOCK, chain_count, rows, segments, teams), hot, kinds)


def in_teams(
    posterior: LogPosterior, moves: Moves, state: Chains, block: BlockOfSteps, *, keep: bool = True, compile_only: bool = False
) -> tuple[Chains, Float[np.ndarray, "step chain segment"], Float[np.ndarray, "step chain"]] | None:
    """(the chains after the block, ψ and E after every step). `keep`: the program may be kept on disk."""
    teams = np.array_split(np.arange(state.elevation.shape[0]), TEAMS)
    parts = [
        (posterior, moves, Chains(*(x[team] for x in state)), Draws(*(x[:, team] for x in block.draws)), *block[1:])
        for team in teams
    ]
    program = compiled(chains.run, *parts[0], name="chains", keep=keep)
    if compile_only:
        return None
    with ThreadPoolExecutor(TEAMS) as pool:
        done = list(pool.map(lambda part: jax.tree.map(np.asarray, program(*part)), parts))
    after = Chains(*map(np.concatenate, zip(*(team for team, *_ in done), strict=True)))
    return after, *(np.concatenate([team[k] for team in done], axis=1) for k in (1, 2))
