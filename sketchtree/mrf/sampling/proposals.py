"""Where may a chain go next?

Langevin: along the gradient, with noise, each row at its own pace (preconditioned; Roberts & Stramer 2002):

    y = ψ + ½ ε² P ∇E/T + ε √P ξ,    ξ ~ N(0, 1)

Mirror moves, which no gradient finds because it never crosses ψ = 0: negate one limb, or a limb with all that
grows on it, or shift a whole limb by N(0, .35). Mirror moves are symmetric, so only the Langevin step has a ratio of
proposal densities.
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

SHIFT_SD = 0.35  # radians
LIMB_ALONE, WITH_SUBTREE = 0.2, 0.6  # below the first: the limb alone; below the second: with its subtree; else a shift


class Moves(eqx.Module):
    """What the proposals need to know of a drawing; padded."""

    lateral: Int[Array, " limb"]  # limbs that may leave the page
    first: Int[Array, " limb"]  # their first rows
    lateral_count: Int[Array, ""]
    pace: Float[Array, " segment"]  # √P; 0 at bases and padding


class Draws(NamedTuple):
    """The random numbers of one step of one chain; of a block with the axes (step, chain) in front."""

    noise: Float[Array, " segment"]
    limb: Float[Array, ""]  # [0, 1): which limb
    kind: Float[Array, ""]  # [0, 1): which move
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
    pace = np.zeros(segments)
    pace[: len(graph)] = np.where(graph.is_base | held, 0.0, 1 / np.sqrt(stiffness(graph)))
    return Moves(
        lateral=np.asarray(np.r_[lateral, fill], np.int32),
        first=np.asarray(np.r_[graph.limb_first[lateral], fill], np.int32),
        lateral_count=np.asarray(len(lateral), np.int32),
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


def draw(key: Key[Array, ""], steps: int, chain_count: int, rows: int, segments: int) -> Draws:
    """Everything random in a block of steps, with axes (step, chain) in front. Drawn on the host (Philox, seeded
    by the key's words) for the drawing's own rows, so that the numbers do not depend on the padding and the compiled
    program needs no generator."""
    generator = numpy_generator(key)
    noise = np.zeros((steps, chain_count, segments), np.float32)
    noise[:, :, :rows] = generator.standard_normal((steps, chain_count, rows), np.float32)
    limb, kind, accept = generator.random((3, steps, chain_count), np.float32)
    shift = SHIFT_SD * generator.standard_normal((steps, chain_count), np.float32)
    return Draws(noise, limb, kind, shift.astype(np.float32), accept)


def langevin(moves: Moves, psi, gradient, step, temperature, draws: Draws):
    """y, and what `langevin_log_density` needs of it."""
    return psi + 0.5 * step**2 * moves.pace**2 * gradient / temperature + step * moves.pace * draws.noise


def langevin_log_density(moves: Moves, at, start, gradient, step, temperature):
    """log q(at | start), up to a constant."""
    drift = 0.5 * step**2 * moves.pace**2 * gradient / temperature
    away = jnp.where(moves.pace > 0, (at - start - drift) / jnp.where(moves.pace > 0, moves.pace, 1.0), 0.0)
    return -0.5 * jnp.sum(away**2) / step**2


def mirror(moves: Moves, page: Page, psi, draws: Draws):
    """One limb negated, a limb and its subtree negated, or a limb shifted."""
    j = jnp.clip((draws.limb * moves.lateral_count).astype(jnp.int32), 0, jnp.maximum(moves.lateral_count - 1, 0))
    some = page.is_segment & (moves.lateral_count > 0)
    on_limb = (page.limb == moves.lateral[j]) & some
    rank = page.walk.rank - page.walk.rank[moves.first[j]]
    in_subtree = (rank >= 0) & (rank < page.walk.extent[moves.first[j]]) & some
    flipped = jnp.where((draws.kind < LIMB_ALONE) & on_limb | (draws.kind >= LIMB_ALONE) & in_subtree, -psi, psi)
    return jnp.where(draws.kind < WITH_SUBTREE, flipped, psi + jnp.where(on_limb, draws.shift, 0.0))
