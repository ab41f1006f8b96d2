"""Which triangles join the rings of a tube?

Between two rings of n sides each there are n quadrangles, each cut in two. Where the ring above has half as many
sides, three triangles stand on each of its sides:

    d ─────── c          d ───────── c
    │       ╱ │          │ ╲     ╱   │
    │   ╱     │          │   ╲ ╱     │
    a ─────── b          a ── m ──── b

A fan closes the foot, another the tip. The vertices of the seam stand twice (u = 0 and u = k), as do rings where the bark's
repeat changes; both copies share position and normal, so the tube is closed when they are welded.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.geometry.rings import Rings


@dataclass(frozen=True, eq=False)
class Surface:
    """Plain arrays of a triangle mesh; see `Mesh`."""

    position: Float[np.ndarray, "vertex 3"]
    normal: Float[np.ndarray, "vertex 3"]
    uv: Float[np.ndarray, "vertex 2"]
    triangle: Int[np.ndarray, "triangle 3"]
    limb: Int[np.ndarray, " vertex"] | None = None  # of the centre lines, for tubes


@dataclass(frozen=True, eq=False)
class StoredRings:
    """The rings as they are stored: twice where the bark's repeat changes, and only the vertices that carry on."""

    source: Int[np.ndarray, " stored"]  # ring of each stored ring
    upper: Int[np.ndarray, " ring"]  # stored ring that carries the wood above
    lower: Int[np.ndarray, " ring"]  # … and below
    side: Int[np.ndarray, " stored"]  # sides of each
    first: Int[np.ndarray, " stored+1"]  # its first vertex; it has one more than sides
    column: Int[np.ndarray, " vertex"]  # generator of each vertex, n₀ at the seam's second copy


def stitch(
    vertex: Float[np.ndarray, "ring side 3"],
    normal: Float[np.ndarray, "ring side 3"],
    v: Float[np.ndarray, "ring side"],
    repeat: Float[np.ndarray, " ring"],
    level: Int[np.ndarray, " ring"],
    start: Int[np.ndarray, " limb+1"],
    offset: Float[np.ndarray, "limb 2"],
    rings: Rings,
    limbs: Int[np.ndarray, " limb"],
    tile: float,
) -> Surface:
    """The closed tubes of limbs whose rings have n₀ sides, of which every 2^level-th vertex is used.

    `v` grows towards the tips, as `lengthwise` gives it; `limbs` are the rows of `rings` that `start` cuts.
    """
    n = vertex.shape[1]
    limb = np.repeat(np.arange(len(limbs)), np.diff(start))
    stored = stored_rings(np.r_[False, (np.diff(repeat) != 0) & (np.diff(limb) == 0)], level, n)
    used = repeat[stored.source].copy()
    twice = np.flatnonzero(stored.upper != stored.lower)
    used[stored.lower[twice]] = repeat[twice - 1]
    ring = np.repeat(stored.source, stored.side + 1)
    around = stored.column % n
    u = offset[limb[ring], 0] + np.repeat(used, stored.side + 1) * stored.column / n
    uv = np.stack([u, offset[limb[ring], 1] - v[ring, around]], axis=-1)
    foot = stored.first[-1] + np.arange(len(limbs))
    tip = foot + len(limbs)
    low, high = stored.lower[start[:-1]], stored.upper[start[1:] - 1]
    ends, end_normal = _ends(rings, limbs, vertex, start)
    return Surface(
        np.concatenate([vertex[ring, around], ends]),
        np.concatenate([normal[ring, around], end_normal]),
        np.concatenate([uv, _end_uv(uv, stored, low, high, rings, limbs, tile)]),
        np.concatenate([sides(stored, start), fan(stored, low, foot)[:, [1, 0, 2]], fan(stored, high, tip)]),
        np.concatenate([limbs[limb[ring]], limbs, limbs]),
    )


def stored_rings(
    changed: Bool[np.ndarray, " ring"], level: Int[np.ndarray, " ring"], n: int | Int[np.ndarray, " ring"]
) -> StoredRings:
    """The rings as they are stored, of n columns at their limb's foot; `changed` where another repeat of the bark starts."""
    source = np.repeat(np.arange(len(level)), 1 + changed)
    upper = np.cumsum(1 + changed) - 1
    side = (n >> level)[source]
    first = np.r_[0, np.cumsum(side + 1)]
    within = np.arange(first[-1]) - np.repeat(first[:-1], side + 1)
    return StoredRings(source, upper, upper - changed, side, first, within << np.repeat(level[source], side + 1))


def sides(stored: StoredRings, start: Int[np.ndarray, " limb+1"], covered: Bool[np.ndarray, " cell"] | None = None):
    """The triangles between successive rings of a limb, without the cells `covered` (numbered by the sides of their lower
    ring, ring by ring; only between rings of as many sides)."""
    below = np.setdiff1d(np.arange(start[-1] - 1), start[1:-1] - 1, assume_unique=True)
    under, over = stored.upper[below], stored.lower[below + 1]
    alike = stored.side[under] == stored.side[over]
    a, d = _pairs(stored, under[alike], over[alike], 1)
    quads = np.stack([a, a + 1, d + 1, a, d + 1, d], axis=-1)
    if covered is not None:
        first = np.r_[0, np.cumsum(stored.side[stored.upper])]
        quads = quads[~covered[first[below[alike]].repeat(stored.side[over[alike]]) + a - stored.first[under[alike]].repeat(stored.side[over[alike]])]]
    a, d = _pairs(stored, under[~alike], over[~alike], 2)
    fans = np.stack([a, a + 1, d, a + 1, d + 1, d, a + 1, a + 2, d + 1], axis=-1)
    return np.concatenate([quads.reshape(-1, 3), fans.reshape(-1, 3)])


def _pairs(stored: StoredRings, under, over, ratio: int):
    """For each side of the upper rings, its first vertex and the one below it."""
    side = stored.side[over]
    within = np.arange(side.sum()) - np.repeat(np.cumsum(side) - side, side)
    return np.repeat(stored.first[under], side) + ratio * within, np.repeat(stored.first[over], side) + within


def fan(stored: StoredRings, ring: Int[np.ndarray, " end"], centre: Int[np.ndarray, " end"]) -> Int[np.ndarray, "triangle 3"]:
    """Triangles from the sides of these rings to a centre, counter-clockwise seen from the tip."""
    side = stored.side[ring]
    a, _ = _pairs(stored, ring, ring, 1)
    return np.stack([a, a + 1, np.repeat(centre, side)], axis=-1)


def _ends(ring: Rings, limbs, vertex, start):
    """Centres of the lids and apexes of the tips, with their normals."""
    first, last = ring.start[limbs], ring.start[limbs + 1] - 1
    lid = vertex[start[:-1]].mean(axis=1)
    apex = ring.point[last] + 0.5 * ring.radius[last][:, None] * ring.tangent[last]
    return np.concatenate([lid, apex]), np.concatenate([-ring.tangent[first], ring.tangent[last]])


def _end_uv(uv, stored: StoredRings, low, high, ring: Rings, limbs, tile: float):
    """Lids and tips take the bark one radius further on."""
    place = np.concatenate([0.5 * (uv[stored.first[end]] + uv[stored.first[end + 1] - 1]) for end in (low, high)])
    place[: len(limbs), 1] += ring.radius[ring.start[limbs]] / tile
    place[len(limbs) :, 1] -= ring.radius[ring.start[limbs + 1] - 1] / tile
    return place
