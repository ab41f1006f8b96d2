"""Does the sampler give back what the model put in? Simulation-based calibration of the generative core.

Talts, Betancourt, Simpson, Vehtari & Gelman 2018, "Validating Bayesian inference algorithms with simulation-based
calibration": draw a truth from the model, draw its data, sample the posterior given the data. The rank of the truth among n
independent samples is even over 0 … n, whatever the model; a fault in a factor, its gradient, the conjugate update or the chains
bends it.

    χ²        of the ranks' histogram, 20 bins; the smallest p after Holm's correction
    cover     share of the truths inside the central 50 and 90 % of the samples

Scalars: |dz|/|v| of three segments (first, middle and last row), the means and the log standard deviations of Θ that the variant
learns, and E. Per replicate 10 chains from random limbs; after burn-in each gives ten samples, 80 chain steps apart, and the first is left
out: 99. Chains exchange limbs, so what tells whether samples are independent is the autocorrelation of the mean over the chains: at
80 steps it is .0-.1 for half of the scalars, .1-.45 for a drawing's slowest. Replicates run side by side in one program.
"""

import dataclasses
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

import equinox as eqx
import jax
import numpy as np
from jaxtyping import Float, Int
from scipy import stats

from benchmarks.calibration.core_model import LENGTHS, World, core_factors, draw_topology, draw_world
from sketchtree.keys import root_key, stage_key
from sketchtree.mrf.answer.posterior import Posterior
from sketchtree.mrf.compilation import compiled
from sketchtree.mrf.conjugate import theta_names
from sketchtree.mrf.factor_graph import FactorGraph, factor_graph
from sketchtree.mrf.factors.own import Own
from sketchtree.mrf.log_posterior import LogPosterior, log_posterior
from sketchtree.mrf.padding import bucket
from sketchtree.mrf.prior import Prior
from sketchtree.mrf.sampling import chains
from sketchtree.mrf.sampling.proposals import draw, moves
from sketchtree.mrf.sampling.start import starts
from sketchtree.mrf.sampling.teams import BLOCK, KINDS

HOT = (3.0, 1.7)  # temperature of each block before T = 1
TOGETHER = 16  # replicates in one call of the program
THREADS = 2
BINS = 20
MIDDLES = {50: 0.5, 90: 0.9}


class Sampling(NamedTuple):
    """How a replicate is sampled."""

    chain_count: int = 10
    warm: int = 6  # blocks at T = 1 before the first sample
    draws: int = 10  # of every chain
    apart: int = 2  # blocks between them

    @property
    def kept(self) -> int:
        """Samples that are ranked; one is left out so that ranks fall into even bins."""
        return self.chain_count * self.draws - 1


class Verdict(NamedTuple):
    """What the ranks of one scalar say."""

    p: float  # of χ²
    cover: dict[int, float]  # level, % → share of the truths inside
    mean: float  # rank over n, ½ if all is well


def ranks(variant: str, replicates: int, *, seed: int, sampling: Sampling = Sampling()) -> dict[str, Int[np.ndarray, " replicate"]]:
    """Scalar → rank of every replicate's truth among its samples, 0 … `sampling.kept`."""
    found: dict[str, list[int]] = {}
    with ThreadPoolExecutor(THREADS) as pool:
        some = range(-(-replicates // TOGETHER))
        for rows in pool.map(lambda k: list(_ranked_together(variant, seed, k, sampling)), some):
            for row in rows:
                for name, rank in row.items():
                    found.setdefault(name, []).append(rank)
    return {name: np.array(column[:replicates]) for name, column in found.items()}


def verdict(rank: Int[np.ndarray, " replicate"], kept: int, bins: int = BINS) -> Verdict:
    """Whether ranks 0 … `kept` are even. `bins` divides kept + 1."""
    count = np.bincount(rank * bins // (kept + 1), minlength=bins)
    outside = {level: round((1 - share) / 2 * (kept + 1)) for level, share in MIDDLES.items()}
    cover = {level: float(np.mean((rank >= cut) & (rank <= kept - cut))) for level, cut in outside.items()}
    return Verdict(float(stats.chisquare(count).pvalue), cover, float(rank.mean() / kept))


def holm(p: Float[np.ndarray, " test"]) -> float:
    """The smallest of several p, corrected (Holm 1979)."""
    return float(min(1.0, len(p) * np.min(p)))


def _ranked_together(variant, seed, batch, sampling) -> Iterator[dict[str, int]]:
    """Ranks of `TOGETHER` replicates."""
    key = jax.random.fold_in(stage_key(root_key(seed), variant), batch)
    rng = np.random.default_rng([seed, sorted(LENGTHS).index(variant), batch])
    worlds = [draw_world(draw_topology(rng), variant, rng) for _ in range(TOGETHER)]
    graphs = [factor_graph(world.graph) for world in worlds]
    models = [core(graph, variant) for graph in graphs]
    elevation, value, true_value = sampled(models, graphs, worlds, key, sampling)
    for k, (world, graph, model) in enumerate(zip(worlds, graphs, models, strict=True)):
        own = Posterior(graph, elevation[:, k, :, : len(graph)], value[:, k], np.zeros(len(graph)), model, jax.random.fold_in(key, k))
        yield {name: int(np.sum(draws[1:] < truth)) for name, (truth, draws) in scalars(variant, world, own, true_value[k]).items()}


def core(graph: FactorGraph, variant: str) -> LogPosterior:
    """The core model of a drawing; every drawing of a bucket shares one program."""
    factors = core_factors(variant)
    shares = factors.pop("shares")(graph)
    model = log_posterior(graph, Prior(), factors=factors)
    return dataclasses.replace(model, own=(Own("shares", *eqx.partition(shares, eqx.is_array)),))


def sampled(models, graphs, worlds: list[World], key, sampling: Sampling):
    """(ψ with axes draw, replicate, chain, segment; E with draw, replicate, chain; E of every truth)."""
    segments, limbs = bucket(graphs[0])
    model, move = (_stacked(x) for x in (models, [moves(graph, segments, limbs) for graph in graphs]))
    state = _stacked([_start(graph, jax.random.fold_in(key, k), sampling.chain_count, segments) for k, graph in enumerate(graphs)])
    truth = np.stack([np.pad(world.elevation, (0, segments - len(world.elevation))) for world in worlds]).astype(np.float32)
    true_value = compiled(jax.vmap(_value), model, truth, name="core truth", keep=False)(model, truth)
    kinds = np.resize(np.array(KINDS, np.int32), BLOCK)
    run = jax.vmap(_last, in_axes=(0, 0, 0, 1, None, None))
    elevation, value = [], []
    for block in range(len(HOT) + sampling.warm + sampling.draws * sampling.apart):
        hot = np.full(BLOCK, HOT[block] if block < len(HOT) else 1.0, np.float32)
        noise = _noise(jax.random.fold_in(key, TOGETHER + block), len(graphs), sampling.chain_count, segments)
        arguments = (model, move, state, noise, hot, kinds)
        state = jax.tree.map(np.asarray, compiled(run, *arguments, name="core chains", keep=False)(*arguments))
        after = block + 1 - len(HOT) - sampling.warm
        if after > 0 and after % sampling.apart == 0:
            elevation.append(state.elevation)
            value.append(state.value)
    return np.stack(elevation), np.stack(value), np.asarray(true_value)


def scalars(variant: str, world: World, own: Posterior, true_value: float) -> dict[str, tuple[float, Float[np.ndarray, " sample"]]]:
    """Scalar → (truth, samples)."""
    n = len(world.elevation)
    steepness = own.steepness.reshape(len(own), -1)
    rows = {"first": 1, "middle": n // 2, "last": n - 1}
    found = {f"steepness {name}": (abs(np.sin(world.elevation[row])), steepness[:, row]) for name, row in rows.items()}
    learnt = ("divergence", LENGTHS[variant].removeprefix("limb_").removesuffix("_length"), "bend")
    for name, truth, draws in zip(theta_names(), np.concatenate(world.theta), own.theta.T, strict=True):
        if name.startswith(learnt):
            is_sd = "_sd_" in name
            found[f"log {name}" if is_sd else name] = (np.log(truth), np.log(draws)) if is_sd else (truth, draws)
    return found | {"E": (float(true_value), own.log_posterior)}


def _value(model, elevation):
    return model(elevation)


def _last(*arguments):
    return chains.run(*arguments)[0]


def _start(graph, key, chain_count, segments):
    return chains.start(starts(graph, key, chain_count, segments, known=None, held=np.zeros(len(graph), bool)))


def _noise(key, replicates, chain_count, segments):
    noise = draw(key, BLOCK, replicates * chain_count, segments, segments, teams=replicates)
    return jax.tree.map(lambda x: x.reshape(BLOCK, replicates, chain_count, *x.shape[2:]), noise)


def _stacked(columns):
    return jax.tree.map(lambda *x: np.stack(x), *columns)
