"""Where may a chain go next?

Langevin: along the gradient, with noise, each row at its own pace (preconditioned; Roberts & Stramer 2002):

    y = ψ + ½ ε² P ∇E/T + ε √P ξ,    ξ ~ N(0, 1)

Mirror moves, which no gradient finds because it never crosses ψ = 0: negate one limb, or a segment with all that
grows on it, or shift a whole limb by N(0, .35).

Exchanges: two chains swap what grows from one segment on, as it is or mirrored (as in evolutionary Monte Carlo; Liang & Wong
2001). What one chain has found for a limb reaches the others without a climb; the two are taken together or not at all,
at exp((ΔE + ΔE')/T).

Mirror moves and exchanges are symmetric, so only the Langevin step has a ratio of proposal densities.
"""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int, Key

from sketchtree.axes import NULL
from sketchtree.keys import numpy_generator
from sketchtree.mrf.assignment import Page
from sketchtree.mrf.conjugate import GENERIC_BELIEF
from sketchtree.mrf.factor_graph import FactorGraph
from sketchtree.mrf.factors import stem
from sketchtree.traverse import sum_to_root

SHIFT_SD = 0.35  # radians
LIMB_ALONE, LIMB_WHOLE, FROM_SEGMENT = 0.2, 0.45, 0.7  # below the first: a limb alone; the second: with all it carries; the third:
# a segment with all it carries; else a shift


class Moves(eqx.Module):
    """What the proposals need to know of a drawing; padded."""

    lateral: Int[Array, " limb"]  # limbs that may leave the page
    first: Int[Array, " limb"]  # their first rows
    lateral_count: Int[Array, ""]
    segment: Int[Array, " segment"]  # rows that may be turned with all that grows on them
    segment_count: Int[Array, ""]
    pace: Float[Array, " segment"]  # √P; 0 at bases and padding


class Draws(NamedTuple):
    """The random numbers of one step of one chain; of a block with the axes (step, chain) in front."""

    noise: Float[Array, " segment"]
    limb: Float[Array, ""]  # [0, 1): which limb
    kind: Float[Array, ""]  # [0, 1): which move
    partner: Int[Array, ""]  # the chain to exchange with
    shift: Float[Array, ""]  # radians
    accept: Float[Array, ""]  # [0, 1)


def moves(
    graph: FactorGraph, segments: int, limbs: int, *, held: Bool[np.ndarray, " segment"] | None = None, dtype=np.float32
) -> Moves:
    """The moves of a drawing padded to `segments` and `limbs`. Rows that are `held` stay where they are, and so do
    limbs that carry one."""
    held = np.zeros(len(graph), bool) if held is None else held
    lateral = np.setdiff1d(np.flatnonzero(graph.limb_spreads), graph.limb[held])
    fill = np.zeros(limbs - len(lateral), int)
    fixed = sum_to_root(graph.parent, held.astype(float)) > 0
    segment = np.flatnonzero(~graph.is_base & ~fixed)
    pace = np.zeros(segments)
    pace[: len(graph)] = np.where(graph.is_base | held, 0.0, 1 / np.sqrt(stiffness(graph)))
    return Moves(
        lateral=np.asarray(np.r_[lateral, fill], np.int32),
        first=np.asarray(np.r_[graph.limb_first[lateral], fill], np.int32),
        lateral_count=np.asarray(len(lateral), np.int32),
        segment=np.asarray(np.r_[segment, np.zeros(segments - len(segment), int)], np.int32),
        segment_count=np.asarray(len(segment), np.int32),
        pace=np.asarray(pace, dtype),
    )


def stiffness(graph: FactorGraph) -> Float[np.ndarray, " segment"]:
    """About how sharply the posterior bends in each ψ, 1/rad²: P = 1/stiffness."""
    bend = 1 / np.array(GENERIC_BELIEF["bend"][1])
    sharp = np.full(len(graph), 3.0)
    row = np.flatnonzero(graph.is_apical)
    step = bend[np.minimum(graph.order[row], 2)]
    sharp += np.bincount(row, step, minlength=len(graph))
    sharp += np.bincount(graph.parent[row], step, minlength=len(graph))
    lateral = graph.limb_first[graph.limb_parent != NULL]
    sharp[lateral] += 1 / GENERIC_BELIEF["divergence"][3][0] / 2
    sharp += np.bincount(graph.parent[lateral], minlength=len(graph)) * 0.25 / GENERIC_BELIEF["divergence"][3][0]
    stems = graph.limb_first[graph.limb_parent == NULL]
    sharp[stems] += np.where(graph.limb_spreads[graph.limb[stems]], stem.SHRUB_SD, stem.SD) ** -2
    return sharp


def draw(key: Key[Array, ""], steps: int, chain_count: int, rows: int, segments: int, teams: int = 1) -> Draws:
    """Everything random in a block of steps, with axes (step, chain) in front. Drawn on the host (Philox, seeded
    by the key's words) for the drawing's own rows, so that the numbers do not depend on the padding and the compiled
    program needs no generator. Partners are of the same team, and counted from its first chain."""
    generator = numpy_generator(key)
    noise = np.zeros((steps, chain_count, segments), np.float32)
    noise[:, :, :rows] = generator.standard_normal((steps, chain_count, rows), np.float32)
    limb, kind, accept = generator.random((3, steps, chain_count), np.float32)
    shift = SHIFT_SD * generator.standard_normal((steps, chain_count), np.float32)
    partner = np.concatenate([_pairs(generator, steps, len(team)) for team in np.array_split(np.arange(chain_count), teams)], axis=1)
    return Draws(noise, limb, kind, partner, shift.astype(np.float32), accept)


def _pairs(generator, steps: int, chain_count: int) -> Int[np.ndarray, "step chain"]:
    """Who exchanges with whom; the last of an odd count with itself."""
    order = np.argsort(generator.random((steps, chain_count)), axis=1)
    partner = np.array(order)
    even = chain_count - chain_count % 2
    partner[:, 0:even:2], partner[:, 1:even:2] = order[:, 1:even:2], order[:, 0:even:2]
    out = np.empty((steps, chain_count), np.int32)
    np.put_along_axis(out, order, partner.astype(np.int32), axis=1)
    return out


def langevin(moves: Moves, psi, gradient, step, temperature, draws: Draws):
    """y, and what `langevin_log_density` needs of it."""
    return psi + 0.5 * step**2 * moves.pace**2 * gradient / temperature + step * moves.pace * draws.noise


def langevin_log_density(moves: Moves, at, start, gradient, step, temperature):
    """log q(at | start), up to a constant."""
    drift = 0.5 * step**2 * moves.pace**2 * gradient / temperature
    away = jnp.where(moves.pace > 0, (at - start - drift) / jnp.where(moves.pace > 0, moves.pace, 1.0), 0.0)
    return -0.5 * jnp.sum(away**2) / step**2


def mirror(moves: Moves, page: Page, psi, draws: Draws):
    """One limb negated, a limb or a segment and all that grows on it negated, or a limb shifted."""
    limb = moves.lateral[_picked(draws.limb, moves.lateral_count)]
    some = moves.lateral_count > 0
    on_limb = (page.limb == limb) & page.is_segment & some
    first = jnp.where(draws.kind < LIMB_WHOLE, moves.first[_picked(draws.limb, moves.lateral_count)], _row(moves, draws.limb))
    from_row = _subtree(page, first) & jnp.where(draws.kind < LIMB_WHOLE, some, moves.segment_count > 0)
    flipped = jnp.where(draws.kind < LIMB_ALONE, on_limb, from_row)
    return jnp.where(draws.kind < FROM_SEGMENT, jnp.where(flipped, -psi, psi), psi + jnp.where(on_limb, draws.shift, 0.0))


def exchange(moves: Moves, page: Page, psi, other, draws: Draws):
    """What grows from one segment on, as `other` has it: as it is, or mirrored. Both of a pair must be given the same
    draws."""
    side = jnp.where(draws.kind < 0.5, 1.0, -1.0).astype(psi.dtype)
    swapped = _subtree(page, _row(moves, draws.limb)) & (moves.segment_count > 0)
    return jnp.where(swapped, side * other, psi)


def _picked(u, count):
    return jnp.clip((u * count).astype(jnp.int32), 0, jnp.maximum(count - 1, 0))


def _row(moves: Moves, u):
    return moves.segment[_picked(u, moves.segment_count)]


def _subtree(page: Page, row):
    """The row and all that grows on it."""
    rank = page.walk.rank - page.walk.rank[row]
    return (rank >= 0) & (rank < page.walk.extent[row]) & page.is_segment
