"""How unlike are patches and what other photos show of their planes? The cost m of `cost`, for many pixels and all photos at once.

It is the same number, but for rounding: what a plane does to a whole patch is reckoned in double precision there, in single here.
"""

from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int

from sketchtree.multiview.cost import EVEN, GREY, SIDE, UNSEEN

HALF = SIDE // 2
OFFSETS = np.array([(i, j) for j in range(-HALF, HALF + 1) for i in range(-HALF, HALF + 1)], np.int32)  # of a patch's samples, columns and rows


class Others(NamedTuple):
    """The other photos of a view, each in the upper left of its part of the block."""

    transfers: Float[Array, "source 3 4"]
    grey: Float[Array, " texel"]  # of all photos, row by row, one photo after the other
    sizes: Int[Array, "source 2"]  # width and height of each
    block: tuple[int, int]  # rows and columns of a part


class Patches(NamedTuple):
    """The samples around pixels."""

    middle: Float[Array, " pixel"]  # brightness of the pixels themselves
    weight: Float[Array, "sample pixel"]
    value: Float[Array, "sample pixel"]  # brightness over that of the middle
    total: Float[Array, " pixel"]  # of the weights
    mean: Float[Array, " pixel"]
    variance: Float[Array, " pixel"]


def patches_of(grey: Float[Array, " texel"], shape: tuple[int, int], x: Int[Array, " pixel"], y: Int[Array, " pixel"], step: int) -> Patches:
    """The patches of 5 × 5 samples, `step` pixels apart, around pixels of a picture of so many rows and columns."""
    height, width = shape
    middle = grey[y * width + x]
    columns, rows = x + step * OFFSETS[:, :1], y + step * OFFSETS[:, 1:]
    inside = (columns >= 0) & (rows >= 0) & (columns < width) & (rows < height)
    value = jnp.where(inside, grey[jnp.clip(rows, 0, height - 1) * width + jnp.clip(columns, 0, width - 1)] - middle, 0.0)
    far = np.asarray((OFFSETS**2).sum(axis=1) / (2.0 * HALF * HALF), grey.dtype)[:, None]
    weight = jnp.where(inside, jnp.exp(-(value**2) / (2 * GREY * GREY) - far), 0.0)
    total = weight.sum(axis=0)
    mean = (weight * value).sum(axis=0) / total
    return Patches(middle, weight, value, total, mean, (weight * value**2).sum(axis=0) / total - mean**2)


def source_costs(
    x: Int[Array, " pixel"], y: Int[Array, " pixel"], rho: Float[Array, " pixel"], across: Float[Array, " pixel"], down: Float[Array, " pixel"],
    others: Others, patches: Patches, step: int,
) -> Float[Array, "source pixel"]:
    """m of every other photo for the planes (rho, across, down) at pixels (x, y)."""
    t = [[others.transfers[:, i, j, None] for j in range(4)] for i in range(3)]
    px, py = x + 0.5, y + 0.5
    q0, q1, q2 = (row[0] * px + row[1] * py + row[2] + row[3] * rho for row in t)
    a0, a1, a2 = (row[0] + row[3] * across for row in t)
    d0, d1, d2 = (row[1] + row[3] * down for row in t)
    u0, v0 = q0 / q2, q1 / q2

    def add(sums, sample):
        unseen, s, ss, rs = sums
        offset, weight, value = sample
        dx, dy = (step * offset).astype(rho.dtype)
        nearer = dx * a2 + dy * d2
        z = q2 + nearer
        u, v = u0 + (dx * a0 + dy * d0 - u0 * nearer) / z - 0.5, v0 + (dx * a1 + dy * d1 - v0 * nearer) / z - 0.5
        there, shown = _sampled(others, u, v)
        there = there - patches.middle
        weighted = weight * there
        return (unseen | ~(shown & (z > 1e-9)), s + weighted, ss + weighted * there, rs + weighted * value), None

    none = jnp.zeros_like(q0)
    (unseen, s, ss, rs), _ = jax.lax.scan(add, (jnp.zeros_like(q0, bool), none, none, none), (OFFSETS, patches.weight, patches.value))
    s = s / patches.total
    spread = ss / patches.total - s * s
    even = (spread < EVEN) | (patches.variance < EVEN)
    m = 1.0 - (rs / patches.total - s * patches.mean) / jnp.sqrt(jnp.where(even, 1.0, spread * patches.variance))
    return jnp.where(unseen, UNSEEN, jnp.where(even, 1.0, m))



def _sampled(others: Others, u: Float[Array, "source pixel"], v: Float[Array, "source pixel"]) -> tuple[Float[Array, "source pixel"], Bool[Array, "source pixel"]]:
    """(brightness between four texels, whether the photo shows that place)."""
    rows, columns = others.block
    width, height = others.sizes[:, :1], others.sizes[:, 1:]
    shown = (u >= 0) & (v >= 0) & (u < width - 1) & (v < height - 1)
    u, v = jnp.where(shown, u, 0.0), jnp.where(shown, v, 0.0)
    iu, iv = u.astype(jnp.int32), v.astype(jnp.int32)
    fu, fv = u - iu, v - iv
    at = (jnp.arange(len(width), dtype=jnp.int32)[:, None] * rows + iv) * columns + iu
    one, two, three, four = (others.grey[at + beside] for beside in (0, 1, columns, columns + 1))
    top, low = one + fu * (two - one), three + fu * (four - three)
    return top + fv * (low - top), shown


def mean_of_best(costs: Float[Array, "source pixel"], best: int) -> Float[Array, " pixel"]:
    """The mean of the lowest few of every pixel."""
    lowest = []
    for cost in costs:
        for k, held in enumerate(lowest):
            lowest[k], cost = jnp.minimum(held, cost), jnp.maximum(held, cost)
        lowest = [*lowest, cost][:best]
    return sum(lowest) / len(lowest)
