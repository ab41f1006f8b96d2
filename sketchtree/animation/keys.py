"""Which moments of a motion have to be kept?

Every track is cut where it is farthest from the line between its neighbouring keys, until it is nowhere farther than it may be (Douglas and
Peucker 1973), all tracks at once. Tracks that stay at rest are left out.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.asset import Keys


def fewest_keys(joint: Int[np.ndarray, " track"], time: Float[np.ndarray, " time"], value: Float[np.ndarray, "track time channel"], rest, tolerance) -> Keys:
    """Keys of all tracks that ever differ from `rest` ([track channel]) by more than the tolerance (one, or one a track). Quaternions: neighbours lie on one side already."""
    tolerance = np.broadcast_to(np.asarray(tolerance, float), len(joint))
    moves = (np.abs(value - np.asarray(rest)[:, None]).max(axis=(1, 2)) > tolerance) if len(value) else np.zeros(0, bool)
    joint, value, tolerance = joint[moves], value[moves], tolerance[moves]
    if not len(joint):
        return Keys(np.zeros(0, np.int64), np.zeros(1, np.int64), np.zeros(0), np.zeros((0, np.shape(rest)[-1])))
    kept = _kept(time, value, tolerance)
    count = kept.sum(axis=1)
    return Keys(joint, np.r_[0, np.cumsum(count)], np.broadcast_to(time, kept.shape)[kept], value[kept])


def one_sided(turn: Float[np.ndarray, "track time 4"]) -> Float[np.ndarray, "track time 4"]:
    """The same turns, each quaternion on the side of the one before it."""
    flips = np.where(np.sum(turn[:, 1:] * turn[:, :-1], axis=2) < 0, -1.0, 1.0)
    return turn * np.concatenate([np.ones((len(turn), 1)), np.cumprod(flips, axis=1)], axis=1)[..., None]


def _kept(time, value, tolerance) -> Bool[np.ndarray, "track time"]:
    kept = np.zeros(value.shape[:2], bool)
    kept[:, [0, -1]] = True
    rows = np.arange(len(value))
    while len(rows):
        away = _away(time, value[rows], kept[rows])
        start = np.flatnonzero(kept[rows].ravel())  # an interval goes from a key to the one before the next
        worst = np.maximum.reduceat(away.ravel(), start)
        interval = np.cumsum(kept[rows].ravel()) - 1
        first = _first_of(away.ravel() >= worst[interval], interval, len(start))
        cut = first[worst > tolerance[rows][start // value.shape[1]]]
        row, at = np.divmod(cut, value.shape[1])
        kept[rows[row], at] = True
        rows = rows[np.unique(row)]
    return kept


def _first_of(true, interval, count):
    """The first place in each interval where it is true."""
    place = np.flatnonzero(true)
    first = np.empty(count, np.int64)
    first[interval[place][::-1]] = place[::-1]
    return first


def _away(time, value, kept):
    """How far each moment is from the line between its neighbouring keys."""
    at = np.arange(len(time))
    before = np.maximum.accumulate(np.where(kept, at, 0), axis=1)
    after = np.minimum.accumulate(np.where(kept, at, len(time) - 1)[:, ::-1], axis=1)[:, ::-1]
    share = (time[at] - time[before]) / np.maximum(time[after] - time[before], 1e-12)
    low, high = (np.take_along_axis(value, place[..., None], axis=1) for place in (before, after))
    return np.abs(value - (low + share[..., None] * (high - low))).max(axis=2)
