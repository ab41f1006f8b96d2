"""What surface do the rings span?

Every limb is one closed tube: rings of n vertices joined side by side, a rounded tip, and a lid at the foot, which
lies underground or inside the parent's wood.

Limbs with the same n are swept together. The vertices of the seam stand twice (u = 0 and u = k), as do rings
where the bark's repeat changes; both copies share position and normal, so the tube is closed when they are welded.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.collars import raise_collars
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.resolution import collar_rings
from sketchtree.geometry.rings import Rings
from sketchtree.geometry.rootflare import flare
from sketchtree.geometry.unwrap import lengthwise, pace, repeats


@dataclass(frozen=True, eq=False)
class Surface:
    """Plain arrays of a triangle mesh; see `Mesh`."""

    position: Float[np.ndarray, "vertex 3"]
    normal: Float[np.ndarray, "vertex 3"]
    uv: Float[np.ndarray, "vertex 2"]
    triangle: Int[np.ndarray, "triangle 3"]


def sweep(
    lines: CentreLines,
    ring: Rings,
    side_count: Int[np.ndarray, " limb"],
    collar_top: Float[np.ndarray, " limb"],
    offset: Float[np.ndarray, "limb 2"],
    detail: Detail,
    tolerance: float,
) -> Surface:
    """The tubes of all limbs. `offset` shifts the bark of each limb (tiles); `tolerance` is in metres."""
    repeat = repeats(ring, detail.tile)
    paces = pace(ring, repeat, detail.tile)
    bark = (repeat, paces, lengthwise(ring, repeat, detail.tile))
    parts, total = [], 0
    for n in np.unique(side_count):
        part = _sweep_alike(lines, ring, np.flatnonzero(side_count == n), int(n), collar_top, offset, bark, detail, tolerance)
        parts.append(Surface(part.position, part.normal, part.uv, part.triangle + total))
        total += len(part.position)
    if not parts:
        return Surface(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 2)), np.zeros((0, 3), np.int64))
    return Surface(*(np.concatenate([getattr(part, name) for part in parts]) for name in Surface.__dataclass_fields__))


def _sweep_alike(lines, ring: Rings, limbs, n: int, collar_top, offset, bark, detail, tolerance) -> Surface:
    """The tubes of limbs whose rings all have n sides."""
    per_limb = np.diff(ring.start)[limbs]
    start = np.r_[0, np.cumsum(per_limb)]
    rows = np.repeat(ring.start[limbs] - start[:-1], per_limb) + np.arange(start[-1])
    theta = 2.0 * np.pi * np.arange(n) / n
    vertex = _circles(ring, rows, theta, flare(lines, ring, rows, theta, detail.flare))
    s = np.repeat(ring.s[rows, None], n, axis=1)
    collared = np.flatnonzero(collar_top[limbs] > 0)
    size = int(collar_rings(n))
    skirt = raise_collars(vertex, s, start[collared], limbs[collared], size, ring, lines, tolerance)
    normal = _normals(vertex, start)
    _light_skirts(normal, start[collared], skirt)
    repeat, paces, along = (column[rows] for column in bark)
    v = along[:, None] + paces[:, None] * (s - ring.s[rows, None])
    collar = start[collared, None] + np.arange(size)
    v[collar.ravel()] = _collar_v(s, paces, along, collar)
    return _assemble(vertex, normal, v, repeat, start, offset[limbs], ring, limbs, detail.tile)


def _collar_v(s, paces, along, rows):
    """Within a collar v follows each generator, counted back from the collar's top at the pace there."""
    top = rows[:, -1]
    v = along[top][:, None, None] - paces[top][:, None, None] * (s[top][:, None, :] - s[rows])
    return v.reshape(-1, s.shape[1])


def _circles(ring: Rings, rows, theta, bulge):
    """Points of the rings, counter-clockwise seen from the tip."""
    across = np.cross(ring.tangent[rows], ring.reference[rows])
    out = np.cos(theta)[:, None] * ring.reference[rows][:, None] + np.sin(theta)[:, None] * across[:, None]
    return ring.point[rows][:, None] + (ring.radius[rows][:, None] * bulge)[..., None] * out


def _normals(vertex, start):
    """Unit normals of the swept grid: the cross product of the differences round and along."""
    around = np.roll(vertex, -1, axis=1) - np.roll(vertex, 1, axis=1)
    ahead, behind = np.arange(1, len(vertex) + 1), np.arange(-1, len(vertex) - 1)
    ahead[start[1:] - 1] -= 1
    behind[start[:-1]] += 1
    normal = np.cross(around, vertex[ahead] - vertex[behind])
    return normal / np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-300)


def _light_skirts(normal, first, skirt) -> None:
    """The parent's normals at the foot of each collar, most of them one ring further up."""
    normal[first[:, None] + np.arange(2)] = skirt
    bent = normal[first + 2] + 3.0 * skirt[:, 1]
    normal[first + 2] = bent / np.maximum(np.linalg.norm(bent, axis=-1, keepdims=True), 1e-12)


def _assemble(vertex, normal, v, repeat, start, offset, ring: Rings, limbs, tile: float) -> Surface:
    """Vertices with their copies at seams and changes of repeat, lids, tips and all triangles."""
    n = vertex.shape[1]
    limb = np.repeat(np.arange(len(limbs)), np.diff(start))
    changed = np.r_[False, (np.diff(repeat) != 0) & (np.diff(limb) == 0)]
    source = np.repeat(np.arange(len(vertex)), 1 + changed)  # ring of each stored ring
    upper = np.cumsum(1 + changed) - 1  # stored ring that carries the wood above
    lower = upper - changed  # … and below
    used = repeat[source].copy()
    used[lower[changed]] = repeat[np.flatnonzero(changed) - 1]
    column = np.r_[np.arange(n), 0]
    u = offset[limb[source], 0][:, None] + used[:, None] * np.arange(n + 1) / n
    uv = np.stack([u, offset[limb[source], 1][:, None] - v[source][:, column]], axis=-1)
    side = _sides(upper, lower, start, n)
    stored = len(source) * (n + 1)
    foot, tip = stored + np.arange(len(limbs)), stored + len(limbs) + np.arange(len(limbs))
    caps = _caps(lower[start[:-1]], upper[start[1:] - 1], foot, tip, n)
    ends, end_normal = _ends(ring, limbs, vertex, start)
    end_uv = _end_uv(uv, lower[start[:-1]], upper[start[1:] - 1], ring, limbs, tile)
    return Surface(
        np.concatenate([vertex[source][:, column].reshape(-1, 3), ends]),
        np.concatenate([normal[source][:, column].reshape(-1, 3), end_normal]),
        np.concatenate([uv.reshape(-1, 2), end_uv]),
        np.concatenate([side, caps]),
    )


def _sides(upper, lower, start, n: int):
    """Two triangles for each side between successive rings of a limb; the diagonal alternates."""
    below = np.arange(start[-1] - 1) if start[-1] else np.zeros(0, np.int64)
    below = np.setdiff1d(below, start[1:-1] - 1, assume_unique=True)
    j = np.arange(n)
    a, b = upper[below][:, None] * (n + 1) + j, upper[below][:, None] * (n + 1) + j + 1
    d, c = lower[below + 1][:, None] * (n + 1) + j, lower[below + 1][:, None] * (n + 1) + j + 1
    return np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)


def _caps(first, last, foot, tip, n: int):
    """Fans over the first and the last ring of every limb."""
    j = np.arange(n)
    low, high = first[:, None] * (n + 1) + j, last[:, None] * (n + 1) + j
    lids = np.stack([low + 1, low, np.broadcast_to(foot[:, None], low.shape)], axis=-1)
    ends = np.stack([high, high + 1, np.broadcast_to(tip[:, None], high.shape)], axis=-1)
    return np.concatenate([lids.reshape(-1, 3), ends.reshape(-1, 3)])


def _ends(ring: Rings, limbs, vertex, start):
    """Centres of the lids and apexes of the tips, with their normals."""
    first, last = ring.start[limbs], ring.start[limbs + 1] - 1
    lid = vertex[start[:-1]].mean(axis=1)
    apex = ring.point[last] + 0.5 * ring.radius[last][:, None] * ring.tangent[last]
    return np.concatenate([lid, apex]), np.concatenate([-ring.tangent[first], ring.tangent[last]])


def _end_uv(uv, first, last, ring: Rings, limbs, tile: float):
    """Lids and tips take the bark one radius further on."""
    n = uv.shape[1] - 1
    low, high = uv[first].mean(axis=1), uv[last].mean(axis=1)
    low[:, 1] += ring.radius[ring.start[limbs]] / tile
    high[:, 1] -= ring.radius[ring.start[limbs + 1] - 1] / tile
    assert n >= 3
    return np.concatenate([low, high])
