"""Which part of the bark lies where?

On thick wood one tile of bark covers `tile` × `tile` metres. Young bark is finer: a limb that is four times thinner than
`_THICK` at its foot has tiles half as large, and so on, in steps of two (a limb's grain g = 1, 2, 4, …). Around a limb of
circumference c (of its polygon) the tile repeats k times, a power of two (so that it closes without a seam where k ≥ 1), and along it

    u = k θ / 2π + u₀        dv/ds = −g ρ^½ / tile        ρ = k tile / (g c)

    ρ    density of the bark around the limb, 1 = as on the limb's own tile
    θ    angle from the seam, which starts at the back of the tree

The largest stretch of a texel is max(ρ^½, ρ^−½). k starts at the power of two nearest to g c / tile, so ρ starts within
½√2 … √2; where thinning makes ρ pass 2√2, k falls by 4, to ρ = ½√2. So stretch stays ≤ 1.7, and density within a limb
varies by 2.9 at most.
"""

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.rings import Rings

_THICK = 0.12  # metres, radius from which on bark is full grown


def grain(ring: Rings) -> Float[np.ndarray, " ring"]:
    """g of every ring's limb: 1 on thick limbs, 2 on those four times thinner, …"""
    foot = ring.radius[ring.start[:-1]]
    return 2.0 ** np.round(0.5 * np.log2(np.maximum(_THICK / foot, 1.0)))[ring.limb]


def circumference(ring: Rings, side: Int[np.ndarray, " ring"]) -> Float[np.ndarray, " ring"]:
    """c of every ring, metres: a polygon of so many sides is shorter than its circle."""
    return 2.0 * side * np.sin(np.pi / side) * ring.radius


def repeats(ring: Rings, around: Float[np.ndarray, " ring"], tile: float) -> Float[np.ndarray, " ring"]:
    """k of every ring of circumference `around`: it never rises towards the tip."""
    around = around * grain(ring) / tile
    foot = around[ring.start[:-1]]
    level = np.round(np.log2(foot))[ring.limb]
    falls = np.maximum(np.floor((level - np.log2(around) + 0.5) / 2.0), 0.0)
    stride = float(falls.max(initial=0.0)) + 1.0
    falls = np.maximum.accumulate(falls + ring.limb * stride) - ring.limb * stride
    return 2.0 ** (level - 2.0 * falls)


def pace(
    ring: Rings, around: Float[np.ndarray, " ring"], repeat: Float[np.ndarray, " ring"], tile: float
) -> Float[np.ndarray, " ring"]:
    """−dv/ds at every ring, tiles a metre."""
    fineness = grain(ring)
    density = repeat * tile / (around * fineness)
    return fineness * np.sqrt(np.clip(density, 0.5, 4.0)) / tile


def lengthwise(
    ring: Rings, around: Float[np.ndarray, " ring"], repeat: Float[np.ndarray, " ring"], tile: float
) -> Float[np.ndarray, " ring"]:
    """−v at every ring, 0 at each limb's foot: the pace summed over the length. Where k changes, the wood
    below the ring still has the k from below."""
    leaving = pace(ring, around, repeat, tile)
    arriving = pace(ring, around, np.r_[repeat[:1], repeat[:-1]], tile)
    step = np.r_[0.0, 0.5 * (arriving[1:] + leaving[:-1]) * np.diff(ring.s)]
    step[ring.start[:-1]] = 0.0
    total = np.cumsum(step)
    return total - np.repeat(total[ring.start[:-1]], np.diff(ring.start))
