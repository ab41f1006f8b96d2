"""Which moments of a motion have to be kept?

Every track is cut where it is farthest from the line between its neighbouring keys, until it is nowhere farther than it may be (Douglas and
Peucker 1973). All stretches between two keys, of all tracks, are looked at together; one that is near enough is not looked at again. Tracks that stay at rest are left out.
"""

import numpy as np
from jaxtyping import Bool, Float, Int

from sketchtree.asset import Keys


def fewest_keys(joint: Int[np.ndarray, " track"], time: Float[np.ndarray, " time"], value: Float[np.ndarray, "track time channel"], rest, tolerance) -> Keys:
    """Keys of all tracks that ever differ from `rest` ([track channel]) by more than the tolerance (one, or one a track). Quaternions: neighbours lie on one side already."""
    tolerance, rest = np.broadcast_to(np.asarray(tolerance, float), len(joint)), np.asarray(rest, float)
    moves = _moves(value, rest, tolerance)
    joint, value, tolerance = joint[moves], value[moves], tolerance[moves]
    if not len(joint):
        return Keys(np.zeros(0, np.int64), np.zeros(1, np.int64), np.zeros(0), np.zeros((0, rest.shape[-1])))
    kept = _kept(time, value, tolerance)
    return Keys(joint, np.r_[0, np.cumsum(kept.sum(axis=1))], np.broadcast_to(time, kept.shape)[kept], value[kept])


def one_sided(turn: Float[np.ndarray, "track time 4"]) -> Float[np.ndarray, "track time 4"]:
    """The same turns, each quaternion on the side of the one before it."""
    flips = np.where(np.sum(turn[:, 1:] * turn[:, :-1], axis=2) < 0, -1.0, 1.0)
    return turn * np.concatenate([np.ones((len(turn), 1)), np.cumprod(flips, axis=1)], axis=1)[..., None]


def _moves(value, rest, tolerance) -> Bool[np.ndarray, " track"]:
    """Is it ever away from rest?"""
    moves = np.zeros(len(value), bool)
    for channel in range(value.shape[2] if len(value) else 0):  # by channel: a maximum over three numbers at a time takes ten times as long
        own, still = value[..., channel], rest[:, channel]
        moves |= np.maximum(own.max(axis=1) - still, still - own.min(axis=1)) > tolerance
    return moves


def _kept(time, value, tolerance) -> Bool[np.ndarray, "track time"]:
    tracks, moments, channels = value.shape
    kept = np.zeros(tracks * moments, bool)
    columns = [np.ascontiguousarray(value[..., channel]).ravel() for channel in range(channels)]
    low = np.arange(tracks) * moments  # a stretch goes from the place of one key to that of the next, in all tracks one after the other
    high = low + moments - 1
    kept[low] = kept[high] = True
    while len(low := low[(wide := high - low > 1)]):
        high = high[wide]
        far, worst = _farthest(time, columns, low, high)
        cut = worst > tolerance[low // moments]
        low, high, far = low[cut], high[cut], far[cut]
        kept[far] = True
        low, high = np.concatenate([low, far]), np.concatenate([far, high])
    return kept.reshape(tracks, moments)


def _farthest(time, columns, low, high):
    """(the place within each stretch that is farthest from the line between its ends, the first of several; how far that is)."""
    inner = high - low - 1
    start = np.cumsum(inner) - inner
    place = np.arange(inner.sum()) + np.repeat(low + 1 - start, inner)
    began, ends = time[low % len(time)], time[high % len(time)]
    share = (time[place % len(time)] - np.repeat(began, inner)) / np.repeat(np.maximum(ends - began, 1e-12), inner)
    away = np.zeros(len(place))
    for column in columns:
        first, last = column[low], column[high]
        np.maximum(away, np.abs(column[place] - (np.repeat(first, inner) + share * np.repeat(last - first, inner))), out=away)
    worst = np.maximum.reduceat(away, start)
    as_far = np.flatnonzero(away >= np.repeat(worst, inner))
    return place[as_far[np.searchsorted(as_far, start)]], worst
