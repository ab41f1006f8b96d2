"""How does a limb grow out of its parent without a crack, a disc or a pinch?

The generators of the limb's tube (one per vertex of a ring) are followed until they leave the parent's
wood, at F. Around that curve the tube is replaced by a collar, whose profile along each generator is the quadratic
Bezier curve with control points

    A   on the parent's surface, a collar's width away from F        tangent to the parent there
    F   where the generator leaves the parent's wood
    C   on the generator, a collar's width past F                    tangent to the limb there

The foot of the collar dips into the parent's wood, so that parent and limb meet at a grazing angle all round.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.detail import Detail
from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.rings import Rings

_WIDTH = 1.2  # of a collar, / radius of the limb
_SINK = 0.04  # depth of its edge below the parent's surface, / its width
_MARCH = 32  # places tried along a limb to find where it leaves its parent
_FAR = 12.0  # how far it may run inside its parent, / radius of the parent
_AT_ONCE = 128  # collars looked at together, which bounds the memory
_BEHIND, _AHEAD, _PIECES = 5.0, 10.0, 14  # stretch of the parent that is looked at, / its radius


@dataclass(frozen=True, eq=False)
class WoodNear:
    """The parent's wood near each collar: a chain of cones."""

    point: Float[np.ndarray, "collar piece+1 3"]
    radius: Float[np.ndarray, "collar piece+1"]

    def nearest(self, x: Float[np.ndarray, "collar place 3"]):
        """Distance to the wood (negative inside), the unit normal there, and the radius of the wood."""
        parts = [self._nearest_of(slice(k, k + _AT_ONCE), x[k : k + _AT_ONCE]) for k in range(0, len(x), _AT_ONCE)]
        return tuple(np.concatenate(column) for column in zip(*parts, strict=True))

    def _nearest_of(self, some: slice, x):
        point, thick = self.point[some], self.radius[some]
        a, d = point[:, None, :-1], np.diff(point, axis=1)[:, None]
        share = np.sum((x[:, :, None] - a) * d, axis=-1) / np.maximum(np.sum(d * d, axis=-1), 1e-18)
        share = np.clip(share, 0.0, 1.0)
        away = x[:, :, None] - a - share[..., None] * d
        radius = thick[:, None, :-1] + share * np.diff(thick, axis=1)[:, None]
        distance = np.linalg.norm(away, axis=-1)
        best = np.argmin(distance - radius, axis=-1)[..., None]
        away = np.take_along_axis(away, best[..., None], axis=2)[:, :, 0]
        distance = np.take_along_axis(distance, best, axis=-1)[..., 0]
        radius = np.take_along_axis(radius, best, axis=-1)[..., 0]
        return distance - radius, away / np.maximum(distance, 1e-12)[..., None], radius


def collar_tops(lines: CentreLines, detail: Detail, height: float) -> Float[np.ndarray, " limb"]:
    """How far up each limb its collar reaches, metres from its foot; 0 where it gets none.

    None for stems, for limbs thinner than `detail.collar_radius`, and for those that end before they are clear.
    """
    top = np.zeros(len(lines))
    limb = np.flatnonzero((lines.parent != NULL) & (lines.radius[lines.start[:-1]] >= detail.collar_radius * height))
    if len(limb) == 0:
        return top
    way = ways_out(lines, limb)
    reach = way.clear(_WIDTH + 0.4)
    top[limb] = np.where(way.leaves & (reach < 0.9 * lines.length[limb]), reach, 0.0)
    return top


@dataclass(frozen=True, eq=False)
class WaysOut:
    """Where the lines of some limbs leave their parents' wood."""

    place: Float[np.ndarray, " limb"]  # metres along the limb
    sine: Float[np.ndarray, " limb"]  # of the angle to the parent's surface, 0.25-1
    radius: Float[np.ndarray, " limb"]  # of the limb there, metres
    leaves: Bool[np.ndarray, " limb"]  # it does leave

    def clear(self, past: float | Float[np.ndarray, " limb"]) -> Float[np.ndarray, " limb"]:
        """Metres along the limb where its whole ring is `past` radii clear of the parent."""
        return self.place + self.radius * (1.1 * np.sqrt(1.0 - self.sine**2) / self.sine + past)


def ways_out(lines: CentreLines, limb: Int[np.ndarray, " limb"]) -> WaysOut:
    """Where these limbs leave the wood of their parents, by marching along their lines."""
    surface = wood_near(lines, limb)
    thick = surface.radius[:, _PIECES // 3]
    s = np.minimum(_FAR * thick, lines.length[limb])[:, None] * np.linspace(0.0, 1.0, _MARCH)
    point, radius = lines.at(np.repeat(limb, _MARCH).reshape(s.shape), s)
    gap, _, _ = surface.nearest(point)
    out, leaves = crossing(s, gap)
    here = np.clip(np.argmax(s >= out[:, None], axis=1), 1, _MARCH - 1)
    row = np.arange(len(limb))
    sine = (gap[row, here] - gap[row, here - 1]) / np.maximum(s[row, here] - s[row, here - 1], 1e-12)
    return WaysOut(out, np.clip(sine, 0.25, 1.0), radius[row, here], leaves)


def raise_collars(
    vertex: Float[np.ndarray, "ring side 3"],
    s: Float[np.ndarray, "ring side"],
    first: Int[np.ndarray, " collar"],
    limb: Int[np.ndarray, " collar"],
    size: int,
    rings: Rings,
    lines: CentreLines,
    tolerance: float,
) -> Float[np.ndarray, "collar 2 side 3"]:
    """Shape the collars in place. `first` is each collar's first ring in `vertex`, of `size`; `s` becomes the length
    along each generator. Collars need at least 6 rings: one inside the parent, 3 or more on the bow, the rest up to the tube.

    Returns the parent's normals at the two lowest rings of each collar, so that the light does not break where they part.
    """
    if len(first) == 0:
        return np.zeros((0, 2, vertex.shape[1], 3))
    ring = first[:, None] + np.arange(size)
    tube, length = vertex[ring], s[ring[:, -1], 0]
    r = rings.radius[rings.start[limb] + size - 1]
    surface = wood_near(lines, limb)
    foot = feet(surface, tube, length)
    width = _WIDTH * r[:, None]
    shoulder = np.minimum(foot + width, 0.97 * length[:, None])
    at_foot, at_shoulder = along(tube, foot, length), along(tube, shoulder, length)
    centre = rings.point[rings.start[limb] + size - 1]
    low, deep, normal = skirt_of(surface, at_foot, at_shoulder, centre, width, tolerance)
    above = 1 + size // 9  # rings between the bow and the top
    t = np.linspace(0.0, 1.0, size - 2 - above)[:, None, None]
    bow = (1 - t) ** 2 * low[:, None] + 2 * (1 - t) * t * at_foot[:, None] + t**2 * at_shoulder[:, None]
    share = np.arange(1, above + 1)[:, None] / (above + 1)
    rise = (length[:, None] - shoulder)[:, None] * share + shoulder[:, None]
    upper = np.stack([along(tube, rise[:, k], length) for k in range(above)], axis=1)
    vertex[ring] = np.concatenate([deep[:, None], bow, upper, tube[:, -1:]], axis=1)
    skirt = foot - 0.9 * width
    curve = (1 - t[..., 0]) * skirt[:, None] + t[..., 0] * shoulder[:, None]
    top = np.broadcast_to(length[:, None, None], rise[:, :1].shape)
    s[ring] = np.concatenate([(skirt - 0.5 * width)[:, None], curve, rise, top], axis=1)
    return np.stack([normal, normal], axis=1)


def skirt_of(surface: WoodNear, foot, shoulder, centre, width, tolerance: float):
    """The lowest visible points of the collar, on the parent's surface, and the ring below them, inside the wood."""
    _, normal, thick = surface.nearest(foot)
    ahead = unit(shoulder - foot)
    outward = unit(_flat(shoulder - centre[:, None], ahead))
    aside = unit(_flat(outward, normal) - 0.35 * _flat(ahead, normal))
    width = np.minimum(width, 0.8 * thick)
    gap, normal, thick = surface.nearest(foot + width[..., None] * aside)
    low = foot + width[..., None] * aside - (gap + 1.5 * tolerance + _SINK * width)[..., None] * normal
    return low, low - (0.25 * thick)[..., None] * normal, normal


def feet(surface: WoodNear, tube, length):
    """Where each generator leaves the parent's wood, metres along the limb."""
    collar, ring, side = tube.shape[:3]
    gap = surface.nearest(tube.reshape(collar, -1, 3))[0].reshape(collar, ring, side)
    s = length[:, None] * np.linspace(0.0, 1.0, ring)
    out, leaves = crossing(np.repeat(s[:, None], side, axis=1), np.moveaxis(gap, 1, 2))
    return np.where(leaves, np.minimum(out, 0.85 * length[:, None]), np.where(gap[:, -1] > 0, 0.0, 0.85 * length[:, None]))


def crossing(s, gap):
    """The place past which `gap` stays above 0 for the first time (last axis), and whether there is one."""
    passes = (gap[..., :-1] <= 0) & (gap[..., 1:] > 0)
    left = np.argmax(passes, axis=-1)[..., None]
    g0, g1 = np.take_along_axis(gap, left, -1)[..., 0], np.take_along_axis(gap, left + 1, -1)[..., 0]
    s0, s1 = np.take_along_axis(s, left, -1)[..., 0], np.take_along_axis(s, left + 1, -1)[..., 0]
    found = passes.any(axis=-1)
    share = np.where(found, g0 / np.where(found, g0 - g1, 1.0), 0.0)
    return s0 + share * (s1 - s0), found


def along(tube, s, length):
    """Points `s` (collar side) metres along the generators."""
    last = tube.shape[1] - 1
    place = np.clip(s / length[:, None], 0.0, 1.0) * last
    left = np.minimum(place.astype(np.int64), last - 1)
    share = (place - left)[..., None]
    collar, side = np.ogrid[: tube.shape[0], : tube.shape[2]]
    return (1 - share) * tube[collar, left, side] + share * tube[collar, left + 1, side]


def wood_near(lines: CentreLines, limb: Int[np.ndarray, " collar"]) -> WoodNear:
    """The parents' wood near the feet of these limbs."""
    parent, place = lines.parent[limb], lines.parent_s[limb]
    _, thick = lines.at(parent, place)
    offset = np.linspace(-_BEHIND, _AHEAD, _PIECES + 1)
    around = np.repeat(parent, _PIECES + 1).reshape(len(limb), -1)
    point, radius = lines.at(around, place[:, None] + thick[:, None] * offset)
    return WoodNear(point, radius)


def _flat(vector, normal):
    return vector - np.sum(vector * normal, axis=-1, keepdims=True) * normal


def unit(vector):
    return vector / np.maximum(np.linalg.norm(vector, axis=-1, keepdims=True), 1e-12)
