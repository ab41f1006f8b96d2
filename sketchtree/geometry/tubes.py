"""What surface do the rings span?

Every limb is one closed tube: rings of vertices joined side by side, a rounded tip, and a lid at the foot, which
lies underground or inside the parent's wood. Limbs with the same number of sides at their foot are swept together.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.geometry.collars import raise_collars
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.resolution import collar_rings
from sketchtree.geometry.rings import Rings
from sketchtree.geometry.rootflare import flare
from sketchtree.geometry.stitch import Surface, stitch
from sketchtree.geometry.unwrap import circumference, lengthwise, pace, repeats


def sweep(
    lines: CentreLines,
    ring: Rings,
    shape: tuple[Int[np.ndarray, " limb"], Int[np.ndarray, " ring"]],
    collar_top: Float[np.ndarray, " limb"],
    offset: Float[np.ndarray, "limb 2"],
    detail: Detail,
    tolerance: float,
    among: Bool[np.ndarray, " limb"],
) -> Surface:
    """The tubes of the limbs `among` all.

    `shape` is what `halvings` gives; `offset` shifts the bark of each limb (tiles); `tolerance` is in metres.
    """
    side, level = shape
    around = circumference(ring, side[ring.limb] >> level)
    repeat = repeats(ring, around, detail.tile)
    paces = pace(ring, around, repeat, detail.tile)
    bark = (repeat, paces, lengthwise(ring, around, repeat, detail.tile))
    parts, total = [], 0
    for n in np.unique(side[among]):
        part = _sweep_alike(lines, ring, np.flatnonzero((side == n) & among), int(n), level, collar_top, offset, bark, detail, tolerance)
        parts.append(Surface(part.position, part.normal, part.uv, part.triangle + total, part.limb))
        total += len(part.position)
    if not parts:
        return Surface(np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 2)), np.zeros((0, 3), np.int64), np.zeros(0, np.int64))
    return Surface(*(np.concatenate([getattr(part, name) for part in parts]) for name in Surface.__dataclass_fields__))


def _sweep_alike(lines, ring: Rings, limbs, n: int, level, collar_top, offset, bark, detail, tolerance) -> Surface:
    """The tubes of limbs that all have n sides at their foot."""
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
    return stitch(vertex, normal, v, repeat, level[rows], start, offset[limbs], ring, limbs, detail.tile)


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
