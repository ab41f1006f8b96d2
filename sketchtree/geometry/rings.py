"""Where do rings of vertices stand along each limb, and how are they turned?

Rings stand as far apart as the bend allows: a chord over a bend of curvature κ misses it by κ Δ² / 8, so

    Δ(s) = √(8 ε / κ(s)),    0.6 r ≤ Δ ≤ 40 r and Δ ≤ the longest allowed

    ε   twice the tolerance of `Detail`, metres     r   radius     κ   curvature

and each stretch between two pinned places (tips of drawn rows, both ends) is cut into equal parts of ∫ ds / Δ.
A ring is perpendicular to the chord over one radius of the line, so that the small tremor of a hand does not tilt
thick wood to and fro.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.detail import Detail
from sketchtree.geometry.frames import rotation_minimising
from sketchtree.geometry.limbs import CentreLines

_BEND = 2.0  # sagitta of a bend / sagitta of a ring's side
_BACK = np.array([0.0, 0.0, -1.0])  # where the seam is: away from the viewer


@dataclass(frozen=True, eq=False)
class Rings:
    """Rings of every limb, ragged: limb i owns `start[i]:start[i + 1]`, from foot to tip (dome included)."""

    start: Int[np.ndarray, " limb+1"]
    s: Float[np.ndarray, " ring"]  # metres along the limb
    point: Float[np.ndarray, "ring 3"]  # centre
    tangent: Float[np.ndarray, "ring 3"]  # unit, towards the tip
    reference: Float[np.ndarray, "ring 3"]  # unit, towards the first vertex; the seam
    radius: Float[np.ndarray, " ring"]  # metres

    @property
    def limb(self) -> Int[np.ndarray, " ring"]:
        """The limb of each ring."""
        return np.repeat(np.arange(len(self.start) - 1), np.diff(self.start))


def rings(
    lines: CentreLines,
    collar_top: Float[np.ndarray, " limb"],
    collar_size: Int[np.ndarray, " limb"],
    detail: Detail,
    height: float,
) -> Rings:
    """Rings of every limb. Where `collar_top` > 0 metres, `collar_size` rings are spaced evenly from the foot
    up to there, for the collar to take over."""
    limb, s = _places(lines, detail, height)
    limb, s = _with_collars(limb, s, collar_top, collar_size, 0.3 * np.maximum(lines.radius[lines.start[:-1]], 1e-6))
    start = np.r_[0, np.cumsum(np.bincount(limb, minlength=len(lines)))].astype(np.int64)
    point, radius = lines.at(limb, s)
    tangent = _tangents(lines, limb, s, radius)
    limb, s, point, tangent, radius, start = _domed(start, limb, s, point, tangent, radius)
    first = np.broadcast_to(_BACK, (len(lines), 3))
    return Rings(start, s, point, tangent, rotation_minimising(point, tangent, start, first), radius)


def _places(lines: CentreLines, detail: Detail, height: float):
    """Limb and place of every ring, before collars and domes."""
    limb = lines.of_point
    apart = np.sqrt(8.0 * _BEND * detail.tolerance * height / np.maximum(lines.curvature, 1e-9))
    nearest = 0.6 * lines.radius
    farthest = np.maximum(np.minimum(40.0 * lines.radius, detail.longest * height), nearest)
    apart = np.clip(apart, nearest, farthest)
    foot = lines.radius[lines.start[:-1]][limb]
    near_ground = lines.is_stem[limb] & (lines.s < lines.ground[limb] + 3.0 * foot)
    apart = np.where(near_ground, np.minimum(apart, 0.4 * foot), apart)
    pace = 1.0 / np.maximum(apart, 1e-7 * height)
    step = np.r_[0.0, 0.5 * (pace[1:] + pace[:-1]) * np.diff(lines.s)]
    step[lines.start[:-1]] = 1.0  # keeps limbs apart on one rising scale
    count = np.cumsum(step)
    pinned = np.flatnonzero(lines.pinned)
    span = np.flatnonzero(limb[pinned[1:]] == limb[pinned[:-1]])
    left, right = pinned[span], pinned[span + 1]
    parts = np.maximum(np.ceil(count[right] - count[left] - 1e-6), 1).astype(np.int64)
    within = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    ticks = np.repeat(count[left], parts) + within * np.repeat((count[right] - count[left]) / parts, parts)
    place = np.interp(ticks, count, lines.s)
    place[within == 0] = lines.s[left]
    last = lines.start[1:] - 1
    limb_of = np.r_[np.repeat(limb[left], parts), limb[last]]
    place = np.r_[place, lines.s[last]]
    order = np.lexsort((place, limb_of))
    return limb_of[order], place[order]


def _with_collars(limb, s, collar_top, collar_size, clearance):
    """Even rings up to the top of each collar in place of those that stood there."""
    collared = np.flatnonzero(collar_top > 0)
    keep = s > collar_top[limb] + np.where(collar_top > 0, clearance, -1.0)[limb]
    size = collar_size[collared]
    within = np.arange(size.sum()) - np.repeat(np.cumsum(size) - size, size)
    even = np.repeat(collar_top[collared] / np.maximum(size - 1, 1), size) * within
    limb = np.r_[limb[keep], np.repeat(collared, size)]
    s = np.r_[s[keep], even]
    order = np.lexsort((s, limb))
    return limb[order], s[order]


def _tangents(lines: CentreLines, limb, s, radius):
    ahead, _ = lines.at(limb, s + radius)
    behind, _ = lines.at(limb, s - radius)
    chord = ahead - behind
    return chord / np.maximum(np.linalg.norm(chord, axis=1, keepdims=True), 1e-300)


def _domed(start, limb, s, point, tangent, radius):
    """One more ring past every tip: the shoulder of the rounded end, whose top is the apex."""
    last = start[1:] - 1
    order = np.argsort(np.r_[limb, limb[last]], kind="stable")
    ahead = 0.55 * radius[last]
    columns = (
        np.r_[limb, limb[last]],
        np.r_[s, s[last] + ahead],
        np.concatenate([point, point[last] + ahead[:, None] * tangent[last]]),
        np.concatenate([tangent, tangent[last]]),
        np.r_[radius, 0.8 * radius[last]],
    )
    return *(column[order] for column in columns), start + np.arange(len(start))
