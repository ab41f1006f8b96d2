"""Which way could a branch turn, to get out of another's?

    stay     as it is
    clears   the least turn that parts its deepest overlap: by θ = (depth + δ) / |l × n| about the axis l × n
             l  from where the branch starts to its nearest point,  n  away from the other branch's;  δ  a hair more than needed
    none     as it grew
    a star   each of `_ANGLES` towards `_SIDES` sides, evenly spread about the branch

All turns are measured from the way it grew. One that parts nothing since it would be too large is no choice.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.propagate.after.sag import rotation

_ANGLES = np.array([0.5, 1.0])  # of the most
_SIDES = 6
_ROUNDING = 1e-9


def choices(
    turned: Float[np.ndarray, "branch 3 3"],
    way: Float[np.ndarray, "branch 3"],
    lever: Float[np.ndarray, "branch 3"],
    away: Float[np.ndarray, "branch 3"],
    missing: Float[np.ndarray, " branch"],
    most: float,
    star: bool,
) -> tuple[Float[np.ndarray, "branch choice 3 3"], Float[np.ndarray, "branch choice"]]:
    """(rotations, their angles in radians; infinite where one is no choice) of branches that point along `way` and have been
    `turned` so far: first stay, then what clears, and with `star` none and the star.

    `lever` leads from each branch's start to its deepest overlap, `away` (of unit length) from the other branch, and the
    two are too near by `missing` (all metres). Nothing is turned by more than `most`, radians from the way it grew."""
    axis = np.cross(lever, away)
    gain = np.linalg.norm(axis, axis=1)
    angle = missing / np.maximum(gain, 1e-300)
    can = angle <= 2 * most
    clears = rotation(axis / np.maximum(gain, 1e-300)[:, None], np.where(can, angle, 0.0)) @ turned
    size = angle_of(clears)
    turns = [turned[:, None], clears[:, None]]
    angles = [angle_of(turned)[:, None], np.where(can & (size <= most), size, np.inf)[:, None]]
    if star:
        around, sizes = _star(way, most)
        turns += [np.broadcast_to(np.eye(3), (len(way), 1, 3, 3)), around]
        angles += [np.zeros((len(way), 1)), np.tile(sizes, (len(way), 1))]
    return np.concatenate(turns, axis=1), np.concatenate(angles, axis=1)


def angle_of(turn: Float[np.ndarray, "branch 3 3"]) -> Float[np.ndarray, " branch"]:
    """By how much each rotation turns, 0-π radians."""
    skew = np.stack([turn[:, 2, 1] - turn[:, 1, 2], turn[:, 0, 2] - turn[:, 2, 0], turn[:, 1, 0] - turn[:, 0, 1]], axis=1)
    return np.arctan2(np.linalg.norm(skew, axis=1), np.trace(turn, axis1=1, axis2=2) - 1.0)


def _star(way, most: float):
    """(rotations, angles): every angle towards every side."""
    along = way / np.maximum(np.linalg.norm(way, axis=1), 1e-300)[:, None]
    upright = np.abs(along[:, 1]) > 0.9
    beside = np.cross(along, np.where(upright[:, None], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]))
    beside /= np.maximum(np.linalg.norm(beside, axis=1), _ROUNDING)[:, None]
    other = np.cross(along, beside)
    side = np.arange(_SIDES) * 2 * np.pi / _SIDES
    axis = np.cos(side)[:, None] * beside[:, None] + np.sin(side)[:, None] * other[:, None]
    angles = np.repeat(most * _ANGLES, _SIDES)
    axis = np.tile(axis, (1, len(_ANGLES), 1))
    turns = rotation(axis.reshape(-1, 3), np.tile(angles, len(way)))
    return turns.reshape(len(way), len(angles), 3, 3), angles
