"""Can the cameras that were found be true? What two photos alone say of each other, against where all of them were placed.

Ours. Twigs are alike, and structure from motion may lay one over another: each photo then fits those that it was placed by, and what it shares with others tells
that it stands elsewhere. Two photos that share enough details have a geometry of their own (COLMAP's, verified without the others). A detail agrees with the
cameras if it lies within `NEAR` pixels of the epipolar line of the other, both ways, and before both cameras; two photos contradict their cameras if less than
half of their details agree. Of photos of real plants and of renders that are placed rightly none do; of renders over even ground, whose pairs are mostly false
themselves, a third. So where more than `WRONG` of all such pairs contradict, nothing is to be trusted. Where more than `DOUBT` do, the photo whose pairs
contradict it most is left out, and the next, until the rest agree; of those the most that pairs hold together are kept.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from sketchtree.multiview.cameras import Camera

NEAR = 4.0  # pixels, what COLMAP allows two photos
NARROW = 1e-5  # sine squared of the angle between two rays that meet far away, before or behind is not to be told
LEAST = 20  # details that two photos share, to have a say
HALF = 0.5
DOUBT, WRONG = 0.1, 0.25


@dataclass(frozen=True, eq=False)
class Pair:
    """Details that two photos share, in focal lengths from their middles, without the lens."""

    rows: tuple[int, int]  # of the cameras
    first: Float[np.ndarray, "detail 2"]
    second: Float[np.ndarray, "detail 2"]


def agrees(one: Camera, other: Camera, pair: Pair) -> Bool[np.ndarray, " detail"]:
    """Which of their details fit where two cameras stand."""
    a, b = _rays(one, pair.first), _rays(other, pair.second)
    way = other.centre - one.centre
    near = np.maximum(_aside(a, b, way) * other.matrix[0, 0], _aside(b, a, way) * one.matrix[0, 0]) < NEAR
    # least squares of one.centre + s a = other.centre + t b: both before the cameras
    ab, aw, bw = (a * b).sum(axis=1), a @ way, b @ way
    return near & ((1.0 - ab**2 < NARROW) | (aw > ab * bw) & (ab * aw > bw))


def contradictions(cameras: list[Camera], pairs: list[Pair]) -> tuple[Int[np.ndarray, "pair 2"], Bool[np.ndarray, " pair"]]:
    """(the cameras of every pair that has a say, whether it contradicts them)."""
    told = [pair for pair in pairs if len(pair.first) >= LEAST]
    rows = np.array([pair.rows for pair in told], np.int64).reshape(-1, 2)
    return rows, np.array([agrees(*(cameras[row] for row in pair.rows), pair).mean() < HALF for pair in told], bool)


def agreeing(count: int, rows: Int[np.ndarray, "pair 2"], wrong: Bool[np.ndarray, " pair"]) -> tuple[list[int], float]:
    """(which of so many cameras can be trusted, the share of pairs that contradicted all)."""
    left, share = np.ones(count, bool), float(wrong.mean()) if len(wrong) else 0.0
    if share > WRONG:
        return [], share
    while True:
        among = left[rows].all(axis=1)
        if not among.any() or wrong[among].mean() <= DOUBT:
            return (list(range(count)) if left.all() else _held_together(left, rows[among & ~wrong])), share
        against, all_of = (np.bincount(rows[which].ravel(), minlength=count) for which in (among & wrong, among))
        left[np.argmax(np.where(left, against / (all_of + 1.0), -1.0))] = False


def _held_together(left: Bool[np.ndarray, " camera"], rows: Int[np.ndarray, "pair 2"]) -> list[int]:
    """The most cameras of those left that pairs join."""
    links = coo_array((np.ones(len(rows)), (rows[:, 0], rows[:, 1])), shape=(len(left), len(left)))
    group = np.where(left, connected_components(links, directed=False)[1], -1)
    return np.flatnonzero(group == np.argmax(np.bincount(group[left]))).tolist()


def _rays(camera: Camera, xy) -> Float[np.ndarray, "detail 3"]:
    """Unit vectors of the world."""
    ray = np.column_stack([xy, np.ones(len(xy))]) @ camera.rotation
    return ray / np.linalg.norm(ray, axis=1, keepdims=True)


def _aside(a, b, way) -> Float[np.ndarray, " detail"]:
    """Sine of the angle between the second ray and the plane of the first and the way between the cameras."""
    normal = np.cross(a, way)
    return np.abs((normal * b).sum(axis=1)) / np.maximum(np.linalg.norm(normal, axis=1), 1e-12)
