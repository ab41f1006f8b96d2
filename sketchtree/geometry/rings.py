"""Where do rings of vertices stand along each limb, and how are they turned?

Rings stand at every pinned place (tips of drawn rows, both ends) and where else it takes one for the tube to stay within
ε of the line and of its radius (see `simplify`), but not closer together than 0.6 r. Stretches longer than the longest
allowed, or than the flare at the ground allows, or along which the radius halves, are cut into equal parts.

    ε   `_BEND` times the tolerance of `Detail`, metres     r   radius

So a limb has at most one ring for each point of its line and each longest stretch, besides those of its collar and
of the flare, however thin and crooked it is. A ring is perpendicular to the chord over one radius of the line, so that the small tremor of a hand does not tilt
thick wood to and fro.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.geometry.detail import Detail
from sketchtree.geometry.frames import rotation_minimising
from sketchtree.geometry.limbs import CentreLines
from sketchtree.geometry.simplify import enough
from sketchtree.watch import Pulse, no_pulse

_FLARED = 3.0  # height of the flare at the ground, / radius there
_CLOSEST = 0.6  # of two rings, / radius
_THINS = 2.0  # largest quotient of the radii of two rings, but on twigs
_BEND = 2.5  # sagitta of a bend / sagitta of a ring's side
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


@dataclass(frozen=True, eq=False)
class Forks:
    """Where rings are wanted for the sake of the limbs that grow out there."""

    limb: Int[np.ndarray, " place"]  # that gets the ring
    s: Float[np.ndarray, " place"]  # metres along it
    margin: Float[np.ndarray, " place"]  # metres, > 0; other rings keep that far away


def rings(
    lines: CentreLines,
    collar_top: Float[np.ndarray, " limb"],
    collar_size: Int[np.ndarray, " limb"],
    detail: Detail,
    height: float,
    *,
    slender: float = np.inf,
    forks: Forks | None = None,
    pulse: Pulse = no_pulse,
) -> Rings:
    """Rings of every limb. Where `collar_top` > 0 metres, `collar_size` rings are spaced evenly from the foot
    up to there, for the collar to take over. No two rings stand farther apart than `slender` radii; `forks` get theirs."""
    limb, s = _places(lines, detail, height, slender, pulse)
    if forks is not None:
        limb, s = _with_forks(lines, limb, s, forks)
    clearance = 0.3 * np.maximum(lines.radius[lines.start[:-1]], 1e-6)
    if forks is not None:
        clearance = np.minimum(clearance, 0.5 * (lines.length - collar_top))
    limb, s = _with_collars(limb, s, collar_top, collar_size, clearance)
    start = np.r_[0, np.cumsum(np.bincount(limb, minlength=len(lines)))].astype(np.int64)
    point, radius = lines.at(limb, s)
    tangent = _tangents(lines, limb, s, radius)
    limb, s, point, tangent, radius, start = _domed(start, limb, s, point, tangent, radius, 2.0 * detail.tolerance * height)
    pulse()
    first = np.broadcast_to(_BACK, (len(lines), 3))
    return Rings(start, s, point, tangent, rotation_minimising(point, tangent, start, first), radius)


def _places(lines: CentreLines, detail: Detail, height: float, slender: float, pulse: Pulse):
    """Limb and place of every ring, before collars and domes."""
    limb = lines.of_point
    tube = np.column_stack([lines.point, lines.radius])
    stand = np.flatnonzero(enough(tube, lines.s, lines.pinned, _CLOSEST * lines.radius, _BEND * detail.tolerance * height, pulse))
    left, right = stand[:-1], stand[1:]
    span = limb[left] == limb[right]
    left, right = left[span], right[span]
    thins = np.log(lines.radius[left] / lines.radius[right]) / np.log(_THINS)
    thins = np.ceil(np.where(lines.radius[left] > 4.0 * detail.tolerance * height, thins, 1.0) - 1e-6)
    begin, end = lines.s[left], lines.s[right]
    parts = np.maximum(np.ceil((end - begin) / np.maximum(detail.longest * height, _CLOSEST * lines.radius[left]) - 1e-6), thins)
    parts = np.maximum(parts, np.ceil((end - begin) / (slender * np.minimum(lines.radius[left], lines.radius[right])) - 1e-6))
    limb, begin, end, parts = _flaring(lines, limb[left], begin, end, np.maximum(parts, 1.0))
    parts = parts.astype(np.int64)
    within = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    place = np.r_[np.repeat(begin, parts) + within * np.repeat((end - begin) / parts, parts), lines.length]
    limb = np.r_[np.repeat(limb, parts), np.arange(len(lines))]
    order = np.lexsort((place, limb))
    return limb[order], place[order]


def _flaring(lines: CentreLines, limb, begin, end, parts):
    """The stretches from `begin` to `end` and their parts, cut and made finer where a stem flares at the ground."""
    foot = lines.radius[lines.start[:-1]][limb]
    flared = np.minimum(end, lines.ground[limb] + _FLARED * foot)
    low = lines.is_stem[limb] & (flared > begin)
    apart = low & (end > flared + foot)
    share = (end - flared) / (end - begin)
    upper = np.flatnonzero(apart)
    fine = np.ceil((np.where(apart, flared, end) - begin) / (0.4 * foot) - 1e-6)
    return (
        np.r_[limb, limb[upper]],
        np.r_[begin, flared[upper]],
        np.r_[np.where(apart, flared, end), end[upper]],
        np.r_[np.where(low, np.maximum(fine, np.where(apart, 1.0, parts)), parts), np.maximum(np.ceil(parts * share - 1e-6), 1.0)[upper]],
    )


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


def _with_forks(lines: CentreLines, limb, s, forks: Forks):
    """The places with those that the forks want, which the others give way to; both ends of every limb stay."""
    stride = float(lines.length.max(initial=0.0)) * 2.0 + 1.0
    rank = np.lexsort((forks.s, forks.limb))
    wanted, margin = (forks.limb * stride + forks.s)[rank], forks.margin[rank]
    far = np.ones(len(wanted), bool)
    for _ in range(3):  # of wanted rings that stand close together, one stays
        kept = np.flatnonzero(far)
        close = np.diff(wanted[kept]) < 0.5 * np.minimum(margin[kept][1:], margin[kept][:-1])
        drop = np.r_[False, close][: len(kept)] & (np.cumsum(np.r_[False, close][: len(kept)]) % 2 == 1)
        far[kept[drop]] = False
    wanted, margin, on = wanted[far], margin[far], forks.limb[rank][far]
    place = limb * stride + s
    after = np.clip(np.searchsorted(wanted, place), 0, max(len(wanted) - 1, 0))
    before = np.maximum(after - 1, 0)
    close = np.zeros(len(place), bool)
    if len(wanted):
        close = (np.abs(wanted[after] - place) < margin[after]) | (np.abs(wanted[before] - place) < margin[before])
    keep = ~close | (s <= 0.0) | (s >= lines.length[limb])
    limb, s = np.r_[limb[keep], on], np.r_[s[keep], wanted - on * stride]
    order = np.lexsort((s, limb))
    return limb[order], s[order]


def _tangents(lines: CentreLines, limb, s, radius):
    ahead, _ = lines.at(limb, s + radius)
    behind, _ = lines.at(limb, s - radius)
    chord = ahead - behind
    return chord / np.maximum(np.linalg.norm(chord, axis=1, keepdims=True), 1e-300)


def _domed(start, limb, s, point, tangent, radius, least: float):
    """One more ring past the tips thicker than `least` metres: the shoulder of the rounded end, whose top is the apex."""
    last = start[1:] - 1
    round_ = radius[last] > least
    start = start + np.r_[0, np.cumsum(round_)]
    last = last[round_]
    order = np.argsort(np.r_[limb, limb[last]], kind="stable")
    ahead = 0.55 * radius[last]
    columns = (
        np.r_[limb, limb[last]],
        np.r_[s, s[last] + ahead],
        np.concatenate([point, point[last] + ahead[:, None] * tangent[last]]),
        np.concatenate([tangent, tangent[last]]),
        np.r_[radius, 0.8 * radius[last]],
    )
    return *(column[order] for column in columns), start
