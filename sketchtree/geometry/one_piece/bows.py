"""Which way does the surface go from a limb's outline to its tube?

Along each generator a quadratic Bezier curve runs from the outline's corner P, by F + (P − A), to the shoulder C (A, F and C
as found for the limb alone, see `outlines`), and on along the generator to the collar's top. The tube's collar does the same
with P = A; here P has moved where limbs crowd, and the shoulder stands the farther up the tube.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.geometry.one_piece.grid import Grid
from sketchtree.geometry.one_piece.outlines import Collars, Outlines


def bow_rings(size):
    """How many of a collar's `size` rings stand on the bow, the outline first."""
    return size - 1 - np.where(size > 2, 1 + size // 8, 0)


def bow(
    grid: Grid,
    x: Float[np.ndarray, "vertex 3"],
    collars: Collars,
    outlines: Outlines,
    corner: Float[np.ndarray, "corner 3"],
    profile: Float[np.ndarray, "3 corner 3"],
) -> None:
    """Shape the collars in place; `corner` are the outlines' corners in space, `profile` is A, F and C."""
    side = np.diff(outlines.start)
    for n, size in np.unique(np.stack([side, collars.size]), axis=1).T.tolist():
        some = np.flatnonzero((side == n) & (collars.size == size))
        at = outlines.start[some][:, None] + np.arange(n)
        ring = grid.ring.start[collars.limb[some]][:, None] + np.arange(size)
        vertex = grid.first[ring][..., None] + np.arange(n)
        start, (low, foot, shoulder), top = corner[at], profile[:, at], x[vertex[:, -1]]
        shoulder = shoulder + collars.ease[some][:, None, None] * (top - shoulder)
        bowed = int(bow_rings(size))
        above = size - 1 - bowed  # rings between the bow and the top
        t = np.linspace(0.0, 1.0, bowed)[:, None, None]
        curve = (1 - t) ** 2 * start[:, None] + 2 * (1 - t) * t * (foot + start - low)[:, None] + t**2 * shoulder[:, None]
        share = (np.arange(1, above + 1) / (above + 1))[:, None, None]
        rise = (1 - share) * shoulder[:, None] + share * top[:, None]
        x[vertex] = np.concatenate([curve, rise, top[:, None]], axis=1)


def lengthwise_in_collars(
    grid: Grid,
    x: Float[np.ndarray, "vertex 3"],
    v: Float[np.ndarray, " vertex"],
    pace: Float[np.ndarray, " ring"],
    collars: Collars,
) -> None:
    """Within a collar v follows each generator, counted back from the collar's top at the pace there; in place."""
    side = grid.side[grid.ring.start[:-1]][collars.limb]
    for n, size in np.unique(np.stack([side, collars.size]), axis=1).T.tolist():
        some = np.flatnonzero((side == n) & (collars.size == size))
        ring = grid.ring.start[collars.limb[some]][:, None] + np.arange(size)
        vertex = grid.first[ring][..., None] + np.arange(n)
        step = np.linalg.norm(np.diff(x[vertex], axis=1), axis=-1)
        back = np.cumsum(step[:, ::-1], axis=1)[:, ::-1]
        v[vertex[:, :-1]] = v[vertex[:, -1:]] - pace[ring[:, -1]][:, None, None] * back
