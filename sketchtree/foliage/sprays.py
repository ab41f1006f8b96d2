"""Which leaves of a tree can one card stand for, and how do they lie on it?

Leaves that follow each other on one stem, and lie near a plane: a *spray*. Sprays begin as single leaves; again and again those neighbours are joined
that stray least from a common plane by it (Ward 1963, "Hierarchical grouping to optimize an objective function"), until they are few enough:

    cost = E(a ∪ b) − E(a) − E(b)        E: sum of squared distances of the leaves' points from their best plane, and a little for their spread in it

A spray lies in the plane of the two widest directions of its feet and tips. There it has an own frame, y along the mean leaf, x so that its first leaf
is on the right; sprays of as many leaves that lie alike share one picture (k-means), the medians of their places and headings.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int
from scipy.cluster.vq import kmeans2

_APART = 2.5  # times the usual step from foot to foot, a stem has come to its end
_SPREAD = 0.02  # of the spread within the plane, in E
_PICTURES = 40  # of all sprays together, about
_SHARE = 12  # sprays that share a picture, at least


class Layout(NamedTuple):
    """Where the leaves of a spray lie on its picture, in leaf lengths."""

    foot: Float[np.ndarray, "leaf 2"]
    heading: Float[np.ndarray, " leaf"]  # radians from upright, positive to the right


def sprays(point: Float[np.ndarray, "leaf point 3"], most: int, longest: int) -> Int[np.ndarray, "spray leaf"]:
    """Rows of the leaves of every spray, -1 where it has fewer than others. There are at most `most` sprays, unless `longest` leaves in each forbid it.

    The points of a leaf say where it is; the first is its foot. Leaves of a stem follow each other."""
    count = len(point)
    foot = point[:, 0]
    step = np.linalg.norm(np.diff(foot, axis=0), axis=1)
    usual = np.median(step) if count > 1 else 0.0
    run = np.cumsum(np.r_[True, step > _APART * usual])[:count]
    length = np.ones(count, np.int64)
    moments = _moments(point - (foot.mean(axis=0) if count else 0.0))
    while len(length) > most:
        first = np.cumsum(length) - length
        pair = np.flatnonzero((run[first[1:]] == run[first[:-1]]) & (length[1:] + length[:-1] <= longest))
        if len(pair) == 0:
            break
        joined = moments[pair] + moments[pair + 1]
        cost = _stray(joined) - _stray(moments[pair]) - _stray(moments[pair + 1])
        take = _apart(pair[np.argsort(cost, kind="stable")], min(len(length) - most, (len(pair) + 1) // 2), len(length))
        keep = np.ones(len(length), bool)
        keep[take + 1] = False
        moments[take] += moments[take + 1]
        length[take] += length[take + 1]
        moments, length = moments[keep], length[keep]
    first = np.cumsum(length) - length
    place = np.arange(int(length.max(initial=1)))
    return np.where(place < length[:, None], first[:, None] + place, -1)


def _moments(point) -> Float[np.ndarray, "leaf 10"]:
    """Number, sum and products of each leaf's points."""
    products = np.einsum("lpi,lpj->lij", point, point).reshape(len(point), 9)
    return np.column_stack([np.full(len(point), point.shape[1]), point.sum(axis=1), products])


def _stray(moments) -> Float[np.ndarray, " spray"]:
    """E."""
    number, total = moments[:, 0], moments[:, 1:4]
    scatter = moments[:, 4:].reshape(-1, 3, 3) - total[:, :, None] * total[:, None] / number[:, None, None]
    spread = np.linalg.eigvalsh(scatter)
    return spread[:, 0] + _SPREAD * spread[:, 1:].sum(axis=1)


def _apart(pair, most: int, count: int) -> Int[np.ndarray, " pair"]:
    """The first `most` of these pairs (each with its next) that share no member."""
    free, taken = np.ones(count, bool), []
    for one in pair.tolist():
        if free[one] and free[one + 1]:
            free[one] = free[one + 1] = False
            taken.append(one)
            if len(taken) == most:
                break
    return np.array(taken, np.int64)


def layouts(foot: Float[np.ndarray, "spray leaf 3"], tip: Float[np.ndarray, "spray leaf 3"], share: float) -> tuple[list[Layout], Int[np.ndarray, " spray"]]:
    """The pictures of sprays of equally many leaves, which are the `share` of all sprays, and which picture each has."""
    place, ahead = _in_plane(foot, tip)
    kinds = int(np.clip(min(_PICTURES * share, len(foot) / _SHARE), 1, _PICTURES)) if foot.shape[1] > 1 else 1
    which = np.zeros(len(foot), np.int64)
    if kinds > 1:
        which = kmeans2(np.concatenate([place, ahead], axis=1).reshape(len(foot), -1), kinds, iter=12, minit="++", seed=7, missing="warn")[1]
        _, which = np.unique(which, return_inverse=True)
    found = []
    for kind in range(int(which.max(initial=0)) + 1):
        of = which == kind
        heading = np.median(ahead[of], axis=0)
        found.append(Layout(np.median(place[of], axis=0), np.arctan2(heading[:, 0], heading[:, 1])))
    return found, which


def _in_plane(foot, tip):
    """Feet, and unit vectors to the tips, in each spray's own frame; leaf lengths."""
    size = np.linalg.norm(tip - foot, axis=2).mean(axis=1)[:, None, None]
    middle = (0.5 * (foot + tip)).mean(axis=1, keepdims=True)
    foot, tip = (foot - middle) / size, (tip - middle) / size
    points = np.concatenate([foot, tip], axis=1)
    _, axes = np.linalg.eigh(np.einsum("spi,spj->sij", points, points))
    plane = axes[:, :, 1:]  # columns: the two widest directions
    ahead = np.einsum("si,sij->sj", (tip - foot).mean(axis=1), plane)
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    across = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)
    first = np.einsum("si,sij,sj->s", tip[:, 0], plane, across)
    frame = np.einsum("sij,sjk->sik", plane, np.stack([across * np.where(first < 0, -1, 1)[:, None], ahead], axis=2))
    reach = (tip - foot) @ frame
    return foot @ frame, reach / np.maximum(np.linalg.norm(reach, axis=2, keepdims=True), 1e-9)
