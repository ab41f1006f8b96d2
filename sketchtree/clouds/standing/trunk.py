"""How thick is a trunk, and how sure is that? Ours: by several slices across its axis, from the ground to a bit above breast height, that share one taper (`tapered`).

Branches that hang round the stem are left out first: a trunk's points lie above one another, so it is where the projected density is high (`density`), and next to that.

The lowest slices are left out, since roots flare there. The diameter at the root, d_root of Eq. 5, is what the taper comes to at the foot: the stem's own, without the flare. The error
that is stated says how much the result would change without one slice or another (a jackknife), with the scatter of the points: not what a scan can't tell, such as a trunk that
isn't round behind. `cross_section` is the paper's way, by one slice at the root.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float
from scipy.ndimage import binary_dilation, label

from sketchtree.clouds.standing.cross_section import CrossSection, across, cross_section, plane_points
from sketchtree.clouds.standing.density import HIGHER, density
from sketchtree.clouds.standing.tapered import Tapered, tapered

_MOST, _FEWEST, _PER = 10, 3, 12  # slices, and points of each
_FLARE = 0.25  # of the stem's length: what is lower isn't looked at
_CAP = 150  # points of a slice that are looked at
_HEIGHTS = 8.0  # breast heights that a plant is high: so wide are the cells of density
_ROUNDS = 2  # slices say where the axis is, the axis how to slice
_WIDE = 3.0  # times a slice's typical distance from its middle: farther points are no bark
_ROUND, _FILLED, _SLENDER = 0.35, 0.45, 0.25  # of the radius: circles that points lie farther from are none; of a stem less than a quarter as thick as breast height, whose disc points may fill (depths from photos do)


@dataclass(frozen=True, eq=False)
class Trunk:
    """A trunk as it was measured."""

    root: float  # d_root: diameter at the foot, without flare, metres
    breast: float  # diameter at breast height, metres
    error: float  # of both: one standard deviation, metres
    base: Float[np.ndarray, "3"]  # where the axis meets the foot, metres
    axis: Float[np.ndarray, "3"]  # unit, upwards
    seen: float  # share of the bark's directions that had points
    off: float  # how far points typically lie off the bark, metres
    section: CrossSection | None  # the paper's, at the root; in the plane across `axis` through `base`


def trunk(stem: Float[np.ndarray, "low 3"], breast_height: float) -> Trunk | None:
    """The trunk that a stem's points, up to a bit above breast height, lie round. None where they are too few, or lie round nothing."""
    stem = _column(stem, breast_height)
    base, axis = _begun(stem)
    for _ in range(_ROUNDS):
        slices = _slices(stem, base, axis)
        if slices is None:
            return None
        s, parts = slices
        found = tapered(parts, s)
        base, axis = _line(base, axis, s, found)
    s, parts = slices
    middle = float(np.mean(s))
    low = max(0.0, float(((stem - base) @ axis).min()))
    root, breast = 2 * found.radius(low), 2 * found.radius(breast_height)
    most = _FILLED if root < _SLENDER * breast_height else _ROUND
    if min(root, breast) <= 0 or found.off > most * found.radius(middle):
        return None
    far = [2 * (_without(parts, s, k, found).radius(middle) - found.radius(middle)) for k in range(len(s))] if len(s) > _FEWEST else [0.0]
    error = float(np.hypot(2 * found.error, np.sqrt((len(far) - 1) / len(far) * np.sum(np.square(far)))))
    section = cross_section(plane_points(stem, base + low * axis, axis, 2.0 * float(s[1] - s[0])))
    return Trunk(float(root), float(breast), error, base + low * axis, axis, _seen(parts, found, s), found.off, section)


def foot_radii(trunks: Sequence[Trunk | None]) -> Float[np.ndarray, " foot"] | None:
    """Radius of every foot, metres; where one can't be told, that of the middle one of the others. None where none can."""
    known = [one.root / 2 for one in trunks if one is not None]
    return np.array([one.root / 2 if one is not None else float(np.median(known)) for one in trunks]) if known else None


def _column(stem, breast_height: float):
    """The points of a stem that stand where most lie above one another; all, where those are too few to say more."""
    found = density(stem, _HEIGHTS * breast_height)
    name, _ = label(found.value > HIGHER * found.value.max(), np.ones((3, 3)))
    dense = binary_dilation(name == name[np.unravel_index(found.value.argmax(), name.shape)], np.ones((3, 3)))
    cell = np.floor((stem[:, [0, 2]] - found.corner) / found.size).astype(np.int64)
    kept = dense[cell[:, 0], cell[:, 1]]
    return stem[kept] if kept.sum() >= _FEWEST * _PER else stem


def _without(parts, s, k: int, found: Tapered) -> Tapered:
    """The taper without one of the slices."""
    return tapered(parts[:k] + parts[k + 1 :], np.delete(s, k), replace(found, centre=np.delete(found.centre, k, axis=0)))


def _begun(stem):
    """A first axis: through the middles of the lower and the upper half."""
    level = np.median(stem[:, 1])
    low, high = np.median(stem[stem[:, 1] <= level], axis=0), np.median(stem[stem[:, 1] >= level], axis=0)
    axis = high - low if high[1] - low[1] > 1e-6 else np.array([0.0, 1.0, 0.0])
    axis = axis / np.linalg.norm(axis)
    return low + (stem[:, 1].min() - low[1]) / max(axis[1], 0.2) * axis, axis


def _slices(stem, base, axis):
    """(metres along the axis, points in the plane across it) of slices above the flare; None for too few."""
    one, other = across(axis)
    away = stem - base
    along, plane = away @ axis, np.stack([away @ one, away @ other], axis=1)
    top = float(along.max())
    begin = _FLARE * top
    high = along >= begin
    number = int(np.clip(high.sum() // _PER, 0, _MOST))
    if number < _FEWEST or np.ptp(along[high]) <= 0:
        return None
    which = np.minimum(((along - begin) / (top - begin) * number).astype(int), number - 1)
    s, parts = [], []
    for k in range(number):
        some = plane[high & (which == k)]
        if len(some) >= 4:
            middle = np.median(some, axis=0)
            far = np.linalg.norm(some - middle, axis=1)
            some = some[far <= _WIDE * np.median(far) + 1e-12]
            s.append(begin + (k + 0.5) * (top - begin) / number)
            parts.append(some[:: max(1, len(some) // _CAP)])
    return (np.array(s), parts) if len(s) >= _FEWEST else None


def _line(base, axis, s, found: Tapered):
    """The line through the middles of slices: where it begins, and its direction."""
    one, other = across(axis)
    (slope, shift), *_ = np.linalg.lstsq(np.c_[s, np.ones(len(s))], found.centre, rcond=None)
    way = axis + slope[0] * one + slope[1] * other
    return base + shift[0] * one + shift[1] * other, way / np.linalg.norm(way)


def _seen(parts, found: Tapered, s) -> float:
    """Share of twelve directions that have points, over all slices."""
    hit = np.zeros(12, bool)
    for k, some in enumerate(parts):
        away = some - found.centre[k]
        near = np.abs(np.linalg.norm(away, axis=1) - found.radius(s[k])) <= max(3 * found.off, 0.1 * found.radius(s[k]))
        hit[(np.floor((np.arctan2(away[near, 1], away[near, 0]) / (2 * np.pi) + 0.5) * 12)).astype(int) % 12] = True
    return float(hit.mean())
