"""Where does wood cross a circle round a point, and is there wood all the way out to it (§2, Figure 3)?"""

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

    `strict`: every pixel of the line must be wood, as in the paper; else four of five (grain, small leaves)."""
    count = max(int(np.ceil(2 * np.pi * radius)), 16)
    angle = 2 * np.pi * np.arange(count) / count
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    start, stop = runs(likeness.is_wood(centre + radius * ring), int(round(_GAP / (2 * np.pi) * count)))
    middle = 2 * np.pi * (start + stop - 1) / 2 / count
    out = np.stack([np.cos(middle), np.sin(middle)], axis=1).reshape(-1, 2)
    step = np.arange(1.0, max(radius, 2.0))
    line = centre + out[:, None] * step[None, :, None]
    wood = likeness.is_wood(line.reshape(-1, 2)).reshape(len(out), len(step)).mean(axis=1)
    return Clusters(centre + radius * out, (stop - start) * 2 * np.pi * radius / count, wood >= (1.0 if strict else SIGHT))


def runs(wood: Bool[np.ndarray, " angle"], gap: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """(first, one past the last) of every run of wood round a circle; a run over the seam counts on past the end. Gaps of at most `gap` are bridged; a circle that is
    wood all round has no run (it shows no branch)."""
    count = len(wood)
    if wood.all() or not wood.any():
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    turn = int(np.flatnonzero(~wood)[0])
    line = np.roll(wood, -turn)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], line, [False]]).astype(np.int8)))
    start, stop = edges[::2], edges[1::2]
    if len(start) > 1 and gap:
        apart = start[1:] - stop[:-1] > gap
        start, stop = start[np.concatenate([[True], apart])], stop[np.concatenate([apart, [True]])]
    return (start + turn) % count, (start + turn) % count + (stop - start)
