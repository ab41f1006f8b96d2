"""How are the planes of half a chessboard's pixels made better at once? `patchmatch.sweep` by jax.

A colour's pixels read only the other colour's planes, so the order in which they are worked on does not matter, and they see the same hypotheses in the same
order, with the same numbers drawn by chance, as in `patchmatch`. What differs is rounding: a pixel to which two planes fit about equally well may take the other.

Pixels go over in pieces of `PIECE`, one after the other, so that memory grows with the picture only as the picture does: a view of 1000 × 1000 pixels with five
partners takes 39 MB for pictures and planes and 49 MB to work in, as XLA counts them on the CPU.
"""

from functools import partial

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from sketchtree.multiview.accelerated.chance_jax import Word, chance
from sketchtree.multiview.accelerated.cost_jax import Others, Patches, mean_of_best, patches_of, source_costs
from sketchtree.multiview.patchmatch import IMPOSSIBLE, NEIGHBOURS, PRIOR, REACH, STEEPEST
from sketchtree.multiview.workplace import Level, Partners

PIECE = 65_536  # pixels worked on at once
LEAST = 1_024  # a smaller piece is filled up to a power of two, no less than this


class Sweeps:
    """The sweeps over one view: what does not change from one to the next stays on the device."""

    def __init__(self, level: Level, near: Partners, step: int, best: int):
        """`step` and `best` as in `Quality`."""
        self.level, self.step, self.best = level, step, best
        self.grey, self.used = jnp.asarray(level.grey.ravel()), jnp.asarray(level.used.ravel())
        self.others = (jnp.asarray(near.transfers), jnp.asarray(near.others.ravel()), jnp.asarray(near.sizes.astype(np.int32)))
        self.block = near.others.shape[1:]
        self.sought = jnp.asarray(np.array([level.sources.low, level.sources.high, level.camera.matrix[0, 0]], np.float32))
        rows, columns = (at.astype(np.int32) for at in np.nonzero(level.used))
        self.pixels = [(rows[own], columns[own]) for own in ((rows + columns) % 2 == colour for colour in (0, 1))]

    def __call__(self, colour: int, prior: Float[np.ndarray, "row column 3"], spread: float, fresh: int, seed: int) -> None:
        """Improve the level's planes of one colour, in place."""
        level, (rows, columns) = self.level, self.pixels[colour]
        plane, words = np.array(level.plane.reshape(-1, 3).T, np.float32, order="C"), np.array([int(seed) >> 32, int(seed) & 0xFFFFFFFF], np.uint32)
        plane = jnp.asarray(plane)
        for first in range(0, len(rows), PIECE):
            own = [at[first : first + PIECE] for at in (rows, columns)]
            y, x = (np.pad(at, (0, _filled(len(at)) - len(at)), mode="edge") for at in own)
            better, energy = _improved(
                x, y, plane, np.ascontiguousarray(prior[y, x].T, np.float32), self.grey, self.used, *self.others, self.sought, np.float32(spread), np.int32(fresh), words,
                shape=level.shape, block=self.block, step=self.step, best=self.best,
            )
            level.plane[*own], level.energy[*own] = np.asarray(better).T[: len(own[0])], np.asarray(energy)[: len(own[0])]


def _filled(count: int) -> int:
    return min(PIECE, max(LEAST, 1 << (count - 1).bit_length()))


@partial(jax.jit, static_argnames=("shape", "block", "step", "best"))
def _improved(x, y, plane, prior, grey, used, transfers, other_grey, sizes, sought, spread, fresh, seed, *, shape, block, step, best):
    """(planes of the pixels, their energies) after all hypotheses."""
    others, patches = Others(transfers, other_grey, sizes, block), patches_of(grey, shape, x, y, step)
    seed = (seed[0], seed[1])

    def energy(planes):
        return energy_of(x, y, planes, prior[0], sought, others, patches, step, best)

    def attempt(k, now):
        planes, least = now
        tried, possible = hypothesis(k, x, y, planes, plane, prior, used, shape, sought, spread, seed)
        cost = jnp.where(possible, energy(tried), jnp.inf)
        better = cost < least
        return jnp.where(better, tried, planes), jnp.where(better, cost, least)

    start = plane[:, y * shape[1] + x]
    return jax.lax.fori_loop(jnp.int32(0), len(NEIGHBOURS) + 3 + fresh, attempt, (start, energy(start)))


def energy_of(
    x: Int[Array, " pixel"], y: Int[Array, " pixel"], planes: Float[Array, "3 pixel"], prior: Float[Array, " pixel"], sought: Float[Array, " 3"], others: Others,
    patches: Patches, step: int, best: int,
) -> Float[Array, " pixel"]:
    """The integrand of Eq. 2 for a plane at every pixel. `sought`: least and greatest inverse depth, focal length."""
    (rho, across, down), (low, high, focal) = planes, sought
    limit = STEEPEST * rho / focal
    outside = (rho < low) | (rho > high) | (across**2 + down**2 > limit**2)
    found = mean_of_best(source_costs(x, y, rho, across, down, others, patches, step), best)
    found = found + jnp.where(prior > 0, PRIOR * jnp.minimum(jnp.abs(prior - rho) / (REACH * (high - low)), 1.0), 0.0)
    return jnp.where(outside, IMPOSSIBLE, found)


def hypothesis(
    k: Int[Array, ""], x: Int[Array, " pixel"], y: Int[Array, " pixel"], planes: Float[Array, "3 pixel"], plane: Float[Array, "3 texel"],
    prior: Float[Array, "3 pixel"], used: Bool[Array, " texel"], shape: tuple[int, int], sought: Float[Array, " 3"], spread: Float[Array, ""], seed: Word,
) -> tuple[Float[Array, "3 pixel"], Bool[Array, " pixel"]]:
    """(the k-th plane that every pixel tries, whether there is one): eight neighbours', its segment's, two near its own, and new ones."""
    count = len(NEIGHBOURS)

    def neighbour(_):
        dx, dy = jnp.asarray(NEIGHBOURS, jnp.int32)[k]
        there = (x + dx >= 0) & (y + dy >= 0) & (x + dx < shape[1]) & (y + dy < shape[0])
        at = jnp.where(there, (y + dy) * shape[1] + x + dx, 0)
        rho, across, down = plane[:, at]
        return jnp.stack([rho - across * dx - down * dy, across, down]), there & used[at]

    def segment(_):
        return prior, prior[0] > 0

    def drawn(_):
        one, two, three = (chance(seed, x, y, 3 * k + draw) for draw in range(3))
        (rho, across, down), (low, high, focal) = planes, sought
        tilt, wide = 2.0 * rho / focal, high - low
        near = jnp.stack([rho + spread * (2 * one - 1) * wide, across, down])
        turned = jnp.stack([rho + 0.1 * spread * (2 * one - 1) * wide, across + 0.5 * tilt * (two - 0.5), down + 0.5 * tilt * (three - 0.5)])
        new = jnp.stack([low + one * wide, tilt * (two - 0.5), tilt * (three - 0.5)])
        return jnp.where(k == count + 1, near, jnp.where(k == count + 2, turned, new)), jnp.ones(x.shape, bool)

    return jax.lax.switch(jnp.clip(k - count + 1, 0, 2), (neighbour, segment, drawn), None)
