"""Which of these are stems of their own, and not parts of one trunk, its fork, or boughs that hang beside it? For stems that touch at the ground, of which nobody told how many there are. Ours.

    axis    of each a straight line through its points, the lowest quarter left out, where stems touch and roots flare; ρ: how far its points typically lie off it
    stem    it has points in nine of ten layers of the slab at least, and in both of the lowest: a bough that hangs into the slab ends in the air
    apart   two axes whose gap is, at the top of the slab, more than 2.3 (ρ_i + ρ_j), and at the ground, more than 0.6 (ρ_i + ρ_j) to the same side, or sideways

Led down in straight lines, the arms of a forked trunk meet or cross above the ground; and parts of one trunk are as wide as they lie apart. What isn't apart is one stem.
"""

import numpy as np
from jaxtyping import Float, Int
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components

_FLARE = 0.25  # of the slab
_LAYERS, _FILLED, _LOWEST = 10, 9, 2
_TOP, _FOOT = 2.3, 0.6  # times as far apart as they are thick
_CROSS = -0.25  # cosine between gaps: less is across
_STEPS = 5
_FEWEST = 6  # points that an axis is laid through


def apart(xyz: Float[np.ndarray, "point 3"], above: Float[np.ndarray, " point"], found: list[Int[np.ndarray, "_"]], top: float) -> list[Int[np.ndarray, "_"]]:
    """The stems of their own among what may be stems, points up to `top` metres above the ground; what isn't apart is put together."""
    found = [rows for rows in found if _stands(above[rows] / top)]
    if len(found) < 2:
        return found
    low, high, both = _gaps(xyz, above, found, top)
    ground, head = np.linalg.norm(low, axis=2), np.linalg.norm(high, axis=2)
    return _together(found, (head > _TOP * both) & (ground > _FOOT * both) & ((low * high).sum(axis=2) > _CROSS * ground * head))


def slim(xyz: Float[np.ndarray, "point 3"], above: Float[np.ndarray, " point"], found: list[Int[np.ndarray, "_"]], top: float) -> list[Int[np.ndarray, "_"]]:
    """The same of pieces that fall apart near the ground: those that lie as wide as apart, at the ground and at the top of the slab, are sprays of one tree that hang low. Stems may cross."""
    if len(found) < 2:
        return found
    low, high, both = _gaps(xyz, above, found, top)
    return _together(found, np.maximum(np.linalg.norm(low, axis=2), np.linalg.norm(high, axis=2)) > _TOP * both)


def _gaps(xyz, above, found, top: float):
    """(gaps between axes at the ground, at the top of the slab, how thick both are together) of every pair."""
    axes = [_axis(xyz[rows][:, [0, 2]], above[rows], top) for rows in found]
    foot, head, wide = (np.array(some) for some in zip(*axes, strict=True))
    return foot[:, None] - foot[None], head[:, None] - head[None], wide[:, None] + wide[None]


def _together(found, own) -> list:
    number, same = connected_components(csr_matrix(~own), directed=False)
    return [np.concatenate([rows for rows, name in zip(found, same, strict=True) if name == k]) for k in range(number)]


def _stands(level) -> bool:
    """Whether points, at such shares of the slab, go from its top down to the ground."""
    filled = np.bincount(np.clip((level * _LAYERS).astype(int), 0, _LAYERS - 1), minlength=_LAYERS) > 0
    return bool(filled.sum() >= _FILLED and filled[:_LOWEST].all())


def _axis(plan, above, top: float):
    """(place at the ground, at the top of the slab, how far points typically lie off it) of a straight line that most points lie round."""
    free = above >= _FLARE * top
    free = free if free.sum() >= _FEWEST else np.ones(len(above), bool)
    plan, level = plan[free], np.stack([np.ones(free.sum()), above[free]], axis=1)
    weight = np.ones(len(plan))
    for _ in range(_STEPS):
        line = np.linalg.lstsq(weight[:, None] * level, weight[:, None] * plan, rcond=None)[0]
        off = np.linalg.norm(plan - level @ line, axis=1)
        typical = float(np.median(off)) + 1e-12
        weight = 1.0 / (1.0 + (off / (2 * typical)) ** 2)
    return line[0], line[0] + top * line[1], typical
