"""Where does wood cross a circle round a point, and is there wood all the way out to it (§2, Figure 3)?"""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

from sketchtree.photo.trace.wood_likeness import WoodLikeness

SIGHT = 0.7  # of a line of sight must be wood; what is no limb after all is too faint (`clear`)
_GAP = 0.03  # radians: clusters nearer than this are one


class Clusters(NamedTuple):
    """Runs of wood on one circle."""

    centre: Float[np.ndarray, "cluster 2"]  # on the circle, pixels
    width: Float[np.ndarray, " cluster"]  # along the circle, pixels
    seen: Bool[np.ndarray, " cluster"]  # there is wood on the whole way from the circle's centre


def clusters_on(likeness: WoodLikeness, centre: Float[np.ndarray, " 2"], radius: float, *, strict: bool) -> Clusters:
    """The clusters of wood on the circle, each with whether it can be seen from the centre over wood only.

    `strict`: every pixel of the line must be wood, as in the paper; else SIGHT of it (grain, small leaves)."""
    return clusters_on_all(likeness, [centre], [radius], strict=strict)[0]


def clusters_on_all(likeness: WoodLikeness, centres: Sequence[Float[np.ndarray, " 2"]], radii: Sequence[float], *, strict: bool) -> list[Clusters]:
    """The same of several circles: all pixels are asked at once."""
    rings = [_ring(radius) for radius in radii]
    wood = likeness.is_wood(np.concatenate([centre + radius * ring for centre, radius, ring in zip(centres, radii, rings, strict=True)]))
    found, lines = [], []
    for centre, radius, ring, own in zip(centres, radii, rings, np.split(wood, np.cumsum([len(ring) for ring in rings])[:-1]), strict=True):
        count = len(ring)
        start, stop = runs(own, int(round(_GAP / (2 * np.pi) * count)))
        middle = 2 * np.pi * (start + stop - 1) / 2 / count
        out = np.stack([np.cos(middle), np.sin(middle)], axis=1).reshape(-1, 2)
        lines.append(centre + out[:, None] * np.arange(1.0, max(radius, 2.0))[None, :, None])
        found.append((centre + radius * out, (stop - start) * 2 * np.pi * radius / count))
    sights = likeness.is_wood(np.concatenate([line.reshape(-1, 2) for line in lines]))
    ends = np.cumsum([line.shape[0] * line.shape[1] for line in lines])[:-1]
    shares = [own.reshape(line.shape[:2]).mean(axis=1) for own, line in zip(np.split(sights, ends), lines, strict=True)]
    return [Clusters(place, width, share >= (1.0 if strict else SIGHT)) for (place, width), share in zip(found, shares, strict=True)]


@lru_cache(maxsize=64)
def _ring(radius: float) -> Float[np.ndarray, "angle 2"]:
    """Directions a pixel apart round a circle."""
    count = max(int(np.ceil(2 * np.pi * radius)), 16)
    angle = 2 * np.pi * np.arange(count) / count
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def runs(wood: Bool[np.ndarray, " angle"], gap: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """(first, one past the last) of every run of wood round a circle; a run over the seam counts on past the end. Gaps of at most `gap` are bridged; a circle that is
    wood all round has no run (it shows no branch)."""
    count = len(wood)
    if wood.all() or not wood.any():
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    turn = int(np.argmin(wood))
    line = np.zeros(count + 2, bool)
    line[1 : count - turn + 1], line[count - turn + 1 : -1] = wood[turn:], wood[:turn]
    edges = np.flatnonzero(line[1:] != line[:-1])
    start, stop = edges[::2], edges[1::2]
    if len(start) > 1 and gap:
        apart = start[1:] - stop[:-1] > gap
        start, stop = start[np.concatenate([[True], apart])], stop[np.concatenate([apart, [True]])]
    return (start + turn) % count, (start + turn) % count + (stop - start)
