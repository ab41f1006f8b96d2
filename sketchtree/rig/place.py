"""Where on the tree is each vertex: on which limb, how many metres along it?

Wood, whatever mesh it is (tubes, one piece, any level of detail): the limb inside whose wood a point lies deepest, by its
power (Aurenhammer 1987, "Power diagrams", SIAM Journal on Computing 16):

    limb, s = argmin |x − p|² − r²        over all spheres (p, r) along the limbs

It is 0 on the skin of a tube and negative inside, so a child's vertices count to the parent as long as they are within the
parent's wood, and to the child from there on; no thick limb is outdone by a thin one that happens to be near. As the nearest
neighbour of (x, 0) among (p, √(R² − r²)), R the largest radius, in four dimensions, it is a query of a k-d tree; limbs of like
thickness share one. The best few spheres give the spans of line on which the true least is found.

Leaves: by their own row, since a leaf's vertices are nearer to other twigs than to its own more often than not.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int

from sketchtree.axes import NULL
from sketchtree.geometry.limbs import CentreLines

_LIKE = 3.0  # radii that share a k-d tree, largest / smallest
_BEYOND = 2.5  # of the largest radius: farther from a limb nobody looks for it at first
_SPHERES = 3  # that are looked at, of each thickness
_SPACING = 4.0  # of spheres along a line, radii


class Places(NamedTuple):
    """One row a point."""

    limb: Int[np.ndarray, " point"]
    s: Float[np.ndarray, " point"]  # metres along it


def along(lines: CentreLines, column: Float[np.ndarray, "point *channel"], place: Places) -> Float[np.ndarray, "place *channel"]:
    """A column that is known at the points of the lines, at the places; linear between."""
    stride = float(lines.s.max(initial=0.0)) + 1.0
    s = np.clip(place.s, 0.0, lines.length[place.limb])
    right = np.searchsorted(lines.of_point * stride + lines.s, place.limb * stride + s, side="right")
    right = np.clip(right, lines.start[place.limb] + 1, lines.start[place.limb + 1] - 1)
    share = np.clip((s - lines.s[right - 1]) / (lines.s[right] - lines.s[right - 1]), 0.0, 1.0)
    share = share.reshape(-1, *[1] * (column.ndim - 1))
    return column[right - 1] + share * (column[right] - column[right - 1])


def wood_places(lines: CentreLines, position: Float[np.ndarray, "vertex 3"]) -> Places:
    """Limb and place of every vertex of the wood. The same position gives the same place."""
    if not len(lines):
        return Places(np.full(len(position), NULL), np.zeros(len(position)))
    best = _Best(np.full(len(position), np.inf), np.zeros(len(position), np.int64), np.zeros(len(position)))
    spheres = _spheres(lines)
    low = lines.radius.max()
    while len(spheres.span):
        low = low / _LIKE
        thick = (spheres.radius >= low) | (spheres.radius < 1e-6)
        _look(lines, spheres.select(thick), position, best, near=True)
        spheres = spheres.select(~thick)
    lost = np.flatnonzero(~np.isfinite(best.power))
    if len(lost):
        rest = _Best(*(column[lost] for column in best))
        _look(lines, _spheres(lines), position[lost], rest, near=False)
        for column, found in zip(best, rest, strict=True):
            column[lost] = found
    return Places(lines.of_point[best.span], best.s)


def places_on(lines: CentreLines, limb: Int[np.ndarray, " point"], position: Float[np.ndarray, "point 3"]) -> Places:
    """The nearest place on the limb that each point belongs to: on the two spans at that limb's nearest point."""
    if not len(position):
        return Places(np.zeros(0, np.int64), np.zeros(0))
    known, apart = _by_limb(lines)
    _, here = known.query(np.column_stack([position, apart * limb]))
    best = _Best(np.full(len(position), np.inf), np.zeros(len(position), np.int64), np.zeros(len(position)))
    every = np.arange(len(position))
    for span in (here - 1, here):
        _closer(lines, np.clip(span, lines.start[limb], lines.start[limb + 1] - 2), every, position, best, by_power=False)
    return Places(limb, best.s)


@lru_cache(maxsize=2)
def _by_limb(lines: CentreLines):
    """The points of the lines in a k-d tree whose fourth axis holds the limbs, and how far apart they stand on it: no limb is mistaken for
    the next, unless a point is as far from its own as the tree is wide, and more."""
    from scipy.spatial import cKDTree

    apart = 4.0 * (float(np.ptp(lines.point, axis=0).max()) + 1.0)
    return cKDTree(np.column_stack([lines.point, apart * lines.of_point])), apart


class _Spheres(NamedTuple):
    """Along the lines, closely enough for their thickness."""

    span: Int[np.ndarray, " sphere"]  # of the line, by its first point
    point: Float[np.ndarray, "sphere 3"]
    radius: Float[np.ndarray, " sphere"]

    def select(self, keep) -> "_Spheres":
        return _Spheres(*(column[keep] for column in self))


class _Best(NamedTuple):
    """What is best so far; written to."""

    power: Float[np.ndarray, " vertex"]
    span: Int[np.ndarray, " vertex"]
    s: Float[np.ndarray, " vertex"]


def _spheres(lines: CentreLines) -> _Spheres:
    span = np.flatnonzero(np.diff(lines.of_point) == 0)
    long = lines.s[span + 1] - lines.s[span]
    parts = np.clip(np.ceil(long / (_SPACING * np.maximum(lines.radius[span], 1e-6))), 1, 64).astype(np.int64)
    which = np.repeat(np.arange(len(span)), parts)
    share = (np.arange(len(which)) - np.repeat(np.cumsum(parts) - parts, parts) + 0.5) / parts[which]
    first = span[which]
    point = lines.point[first] + share[:, None] * (lines.point[first + 1] - lines.point[first])
    return _Spheres(first, point, lines.radius[first] + share * (lines.radius[first + 1] - lines.radius[first]))


def _look(lines: CentreLines, spheres: _Spheres, position, best: _Best, *, near: bool) -> None:
    """The best of these spheres, where it is better than what is known."""
    from scipy.spatial import cKDTree

    if not len(spheres.span):
        return
    most = spheres.radius.max()
    tree = cKDTree(np.column_stack([spheres.point, np.sqrt(most**2 - spheres.radius**2)]))
    count = min(_SPHERES, len(spheres.span))
    reach = np.sqrt(((_BEYOND * most) ** 2 + (_SPACING * most) ** 2) + most**2) if near else np.inf
    _, found = tree.query(np.column_stack([position, np.zeros(len(position))]), k=count, distance_upper_bound=reach, workers=-1)
    found = found.reshape(len(position), count)
    for k in range(count):
        seen = np.flatnonzero(found[:, k] < len(spheres.span))
        _closer(lines, spheres.span[found[seen, k]], seen, position, best, by_power=True)


def _closer(lines: CentreLines, span, rows, position, best: _Best, *, by_power: bool) -> None:
    """Put the span of each row in its place if its power (or its distance) is less."""
    start, chord = lines.point[span], lines.point[span + 1] - lines.point[span]
    away = position[rows] - start
    share = np.clip(np.einsum("ij,ij->i", away, chord) / np.maximum(np.einsum("ij,ij->i", chord, chord), 1e-300), 0.0, 1.0)
    away = away - share[:, None] * chord
    power = np.einsum("ij,ij->i", away, away)
    if by_power:
        power = power - (lines.radius[span] + share * (lines.radius[span + 1] - lines.radius[span])) ** 2
    less = power < best.power[rows]
    rows, span, share = rows[less], span[less], share[less]
    best.power[rows], best.span[rows] = power[less], span
    best.s[rows] = lines.s[span] + share * (lines.s[span + 1] - lines.s[span])
