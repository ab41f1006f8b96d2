"""How do the generations settle with each other, and with the space around them? Iterated conditional modes.

Chen et al. 2008, §5.2.1, ICM refinement: each depth moves along the gradient while the others hold,

    z_i ← z_i + η_i ∂ log P_ICM / ∂z_i        P_ICM = Π_i P(s_i | Θ) P(φ_i | l_i, Θ) P_d(p_i)

until Σ_i |Δz_i| < ε.

    s_i, φ_i   scale |v_i|/|v_pi| and divergence ∠(v_i, v_pi), Gaussians of Θ; φ by label, apical or lateral
    P_d        competition: log P_d(p_i) = −w_d Σ_{k ∉ N(i)} exp(−λ |p_i − p_k| / R_c), λ = 5 (the paper's attenuation),
               w_d = 1, each pair counted once
    N(i)       i, its parent, its children, its siblings          R_c   half the drawn width
    ε          .01; lengths in drawn heights

The formula of P_d is lost in our copy of the paper; this one is ours. Two things keep the ascent sound: it climbs log P
rather than P, which underflows, and η_i is as large as the last sweeps allowed, so that no sweep lowers P. A pair
reaches over three generations at most, so nodes whose generations differ by a multiple of three move together.
"""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key
from scipy.spatial import cKDTree

from sketchtree.mrf.chen.estep import EStepPart, Reading
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.chen.labels import families
from sketchtree.parameters import TreeParameters
from sketchtree.traverse import generation

ATTENUATION = 5.0  # λ, the paper's default
NEAREST = 12  # competitors kept a node: the nearest on the page; the field of the others is below .003 each
_COLOURS = 3
_LONGEST, _SHORTEST, _FIRST = 0.05, 1e-5, 0.02  # step of a sweep, H
_SHARES = (1.0, 0.5, 0.125)  # of their steps that all nodes of a colour may take together


class Pairs(eqx.Module):
    """What P_ICM is made of, padded to a power of two; one program serves every drawing of that size."""

    xy: Float[Array, "segment 2"]
    start: Int[Array, " segment"]  # row at whose tip a segment starts
    above: Int[Array, " segment"]  # row of the segment it diverges from
    present: Float[Array, " segment"]  # 1 where there is one
    is_apical: Bool[Array, " segment"]  # label 1
    colour: Int[Array, " segment"]  # generation modulo 3; 3 where the depth is fixed
    first: Int[Array, " competition_pair"]
    second: Int[Array, " competition_pair"]
    weight: Float[Array, " competition_pair"]  # w_d, 0 at padding
    crown_radius: Float[Array, ""]  # R_c

    def log_pair(self, z, theta) -> Float[Array, " segment"]:
        """log P_sa of every segment and the one it diverges from; 0 where there is none."""
        tip = jnp.column_stack([self.xy, z])
        v = tip - tip[self.start]
        u = v[self.above]
        length, parent_length = _norm(v), _norm(u)
        angle = jnp.arctan2(_norm(jnp.cross(v, u)), jnp.sum(v * u, axis=-1))
        mean = jnp.where(self.is_apical, theta["mu_alpha"], theta["mu_beta"])
        sd = jnp.where(self.is_apical, theta["sigma_alpha"], theta["sigma_beta"])
        scale = ((length / parent_length - theta["mu_s"]) / theta["sigma_s"]) ** 2
        constant = jnp.log(sd) + jnp.log(theta["sigma_s"])
        return -self.present * (0.5 * scale + 0.5 * ((angle - mean) / sd) ** 2 + constant)

    def log_field(self, z_first, z_second) -> Float[Array, " competition_pair"]:
        """The field between the two nodes of each pair."""
        apart = self.xy[self.first] - self.xy[self.second]
        distance = jnp.sqrt(jnp.sum(apart**2, axis=-1) + (z_first - z_second) ** 2 + 1e-8)
        return -self.weight * jnp.exp(-ATTENUATION * distance / self.crown_radius)

    def log_p(self, z, theta) -> Float[Array, ""]:
        """log P_ICM."""
        return jnp.sum(self.log_pair(z, theta)) + jnp.sum(self.log_field(z[self.first], z[self.second]))


class State(NamedTuple):
    """Only what the next sweep needs."""

    depth: Float[Array, " segment"]
    reach: Float[Array, " segment"]  # longest step of each node
    slope: Float[Array, " segment"]  # the last gradient
    moved: Float[Array, ""]  # Σ|Δz| of the last sweep


class Info(NamedTuple):
    """What a person would plot."""

    log_posterior: Float[Array, ""]  # log P_ICM
    moved: Float[Array, ""]


class ICM(EStepPart):
    """Gradient steps on P_sa · P_d, one node at a time."""

    tol: float = 0.01  # ε, drawn heights, > 0
    max_sweeps: int = 150
    competition: float = 1.0  # w_d, 0 or more

    def __call__(self, graph: FactorGraph, theta: TreeParameters, reading: Reading, key: Key[Array, ""]) -> Reading:
        pairs = self.pairs(graph, reading)
        values = {name: jnp.asarray(value) for name, value in theta.as_dict().items()}
        limits = jnp.asarray(self.tol), jnp.asarray(self.max_sweeps)
        state = climb(pairs, values, self.init(pairs, reading), *limits)
        return reading._replace(depth=np.asarray(state.depth, np.float64)[: len(graph)])

    def compile(self, graph: FactorGraph, theta: TreeParameters) -> None:
        """Makes the program for drawings of this size ready."""
        flat = Reading(np.zeros(len(graph)), np.zeros(len(graph), np.int64))
        ICM(self.tol, 0, self.competition)(graph, theta, flat, jax.random.key(0))

    def init(self, pairs: Pairs, reading: Reading) -> State:
        """Every node ready for a first step."""
        depth = _padded(reading.depth, len(pairs.xy), 0.0)
        return State(jnp.asarray(depth), jnp.full(len(depth), _FIRST), jnp.zeros(len(depth)), jnp.asarray(jnp.inf))

    def step(self, pairs: Pairs, theta: dict[str, Array], state: State) -> tuple[State, Info]:
        """One sweep over all nodes."""
        return sweep(pairs, theta, state)

    def terminate(self, state: State) -> Bool[Array, ""]:
        """The depths hardly moved."""
        return state.moved < self.tol

    def pairs(self, graph: FactorGraph, reading: Reading) -> Pairs:
        """The columns of P_ICM under these labels."""
        size = _bucket(len(graph) + 2)
        table = families(graph)
        free = table.above >= 0
        row = np.arange(len(graph))
        colour = np.where(free, generation(graph.parent) % _COLOURS, _COLOURS)
        nothing = len(graph)  # a padding row, at rest
        first, second = competing(graph)
        extra = NEAREST * size
        xy = np.concatenate([graph.xy, _stump(size - len(graph))])
        return Pairs(
            xy=jnp.asarray(xy),
            start=jnp.asarray(_padded(np.where(graph.is_base, row, graph.parent), size, nothing)),
            above=jnp.asarray(_padded(np.where(free, table.above, nothing + 1), size, nothing + 1)),
            present=jnp.asarray(_padded(free.astype(float), size, 0.0)),
            is_apical=jnp.asarray(_padded(reading.label == 1, size, False)),
            colour=jnp.asarray(_padded(colour, size, _COLOURS)),
            first=jnp.asarray(_padded(first, extra, nothing)),
            second=jnp.asarray(_padded(second, extra, nothing)),
            weight=jnp.asarray(_padded(np.full(len(first), self.competition), extra, 0.0)),
            crown_radius=jnp.asarray(graph.crown_radius),
        )


def competing(graph: FactorGraph) -> tuple[Int[np.ndarray, " pair"], Int[np.ndarray, " pair"]]:
    """Pairs of nodes that keep apart: not parent and child, not siblings; each pair once."""
    rows = np.flatnonzero(~graph.is_base)
    if len(rows) < 2:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    count = min(len(rows), NEAREST + 1)
    near = cKDTree(graph.xy[rows]).query(graph.xy[rows], k=count)[1]
    pair = np.sort(np.stack([np.repeat(rows, count), rows[near.ravel()]], axis=1), axis=1)
    first, second = np.unique(pair, axis=0).T
    parent = graph.parent
    apart = (first != second) & (parent[first] != parent[second]) & (parent[second] != first) & (parent[first] != second)
    return first[apart], second[apart]


@eqx.filter_jit
def climb(pairs: Pairs, theta, state: State, tol: Float[Array, ""], limit: Int[Array, ""]) -> State:
    """Sweeps until the depths rest, `limit` at most."""

    def more(carry):
        state, count = carry
        return (state.moved >= tol) & (count < limit)

    def once(carry):
        state, count = carry
        return sweep(pairs, theta, state)[0], count + 1

    return jax.lax.while_loop(more, once, (state, jnp.zeros_like(limit)))[0]


@eqx.filter_jit
def sweep(pairs: Pairs, theta, state: State) -> tuple[State, Info]:
    """One step of every node, one colour after the other."""
    start = state.depth
    state = jax.lax.fori_loop(0, _COLOURS, lambda k, state: _move(pairs, theta, state, pairs.colour == k), state)
    moved = jnp.sum(jnp.abs(state.depth - start))
    return state._replace(moved=moved), Info(pairs.log_p(state.depth, theta), moved)


def _move(pairs: Pairs, theta, state: State, chosen) -> State:
    """Each chosen node steps uphill where that alone raises P; all together go as far as P still rises."""
    slope = jax.grad(pairs.log_p)(state.depth, theta)
    turned = slope * state.slope < 0
    reach = jnp.clip(state.reach * jnp.where(turned, 0.5, 1.5), _SHORTEST, _LONGEST)
    step = jnp.where(chosen, reach * jnp.sign(slope), 0.0)
    rises = _gain(pairs, theta, state.depth, step) > 0
    step = jnp.where(rises, step, 0.0)
    shares = jnp.asarray(_SHARES, step.dtype)
    total = jax.vmap(lambda share: _total_gain(pairs, theta, state.depth, share * step))(shares)
    share = jnp.where(jnp.max(total) >= 0, shares[jnp.argmax(total)], 0.0)
    return State(
        depth=state.depth + share * step,
        reach=jnp.where(chosen, jnp.where(rises, reach, jnp.maximum(0.4 * reach, _SHORTEST)), state.reach),
        slope=jnp.where(chosen, slope, state.slope),
        moved=state.moved,
    )


def _gain(pairs: Pairs, theta, z, step):
    """What each node's own step adds to log P while every other node holds."""
    new, a, b = z + step, pairs.first, pairs.second
    pair = pairs.log_pair(new, theta) - pairs.log_pair(z, theta)
    before = pairs.log_field(z[a], z[b])
    mover = jnp.stack([jnp.arange(len(z)), pairs.start, pairs.start[pairs.above]])  # at most one of them steps
    node = jnp.concatenate([mover.ravel(), a, b])
    gain = [jnp.tile(pair, 3), pairs.log_field(new[a], z[b]) - before, pairs.log_field(z[a], new[b]) - before]
    return jnp.zeros_like(z).at[node].add(jnp.concatenate(gain))


def _total_gain(pairs: Pairs, theta, z, step):
    """What all steps together add to log P, term by term so that small gains are not lost."""
    new, a, b = z + step, pairs.first, pairs.second
    pair = pairs.log_pair(new, theta) - pairs.log_pair(z, theta)
    return jnp.sum(pair) + jnp.sum(pairs.log_field(new[a], new[b]) - pairs.log_field(z[a], z[b]))


def _norm(v):
    return jnp.sqrt(jnp.sum(v**2, axis=-1) + 1e-12)


def _bucket(size: int) -> int:
    """The next of 32, 64, 128, …"""
    return max(32, 1 << (size - 1).bit_length())


def _padded(column, size: int, fill):
    return np.concatenate([column, np.full(size - len(column), fill, np.asarray(column).dtype)])


def _stump(count):
    """Padding nodes: apart from each other, so that no length is zero."""
    return np.c_[np.zeros(count), np.arange(count) + 2.0]
