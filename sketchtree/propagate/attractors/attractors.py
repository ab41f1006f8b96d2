"""Which places should the tree come near? And how near is it (Tan et al. 2008, §3.2)?

    E(T) = Σ_i dist(s_i, T)        dist(s, T) = min_j |s − p_j|,   p_j along the tree

    image attractors     sampled evenly in the foliage, with a fixed interval; the tree as projected on the page           E2D
    attractors in 3D     joints of the tree turned by 90° (`revolved`); or evenly in the foliage revolved                  E3D

The tree's samples p_j are as dense as can be here: distances are to its straight pieces. Branches are only added, so with the new ones' distances d̂

    d^(n+1) = min(d^n, d̂)
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial import cKDTree

from sketchtree.axes import NULL
from sketchtree.propagate.attractors.revolved import Axes
from sketchtree.propagate.attractors.target import Target

_BLOCK = 200_000  # pairs at a time
_PIECES = 400  # of wood, that attractors are held against at once
_POINT = 1e-300  # m²: a shorter piece is a point
_SLACK = 1e-5  # of the farthest coordinate: what single precision may be off by


@dataclass(eq=False)
class Attractors:
    """Places, and how far each is from the tree."""

    place: Float[np.ndarray, "attractor axis"]  # metres; two axes: on the page
    distance: Float[np.ndarray, " attractor"]  # metres
    nearest: Int[np.ndarray, " attractor"]  # number of the limb that is so near; NULL without any

    @classmethod
    def at(cls, place: Float[np.ndarray, "attractor axis"]) -> "Attractors":
        """Without a tree yet: infinitely far."""
        return cls(place, np.full(len(place), np.inf), np.full(len(place), NULL))

    def __len__(self) -> int:
        return len(self.place)

    @property
    def energy(self) -> float:
        """Σ_i dist(s_i, T), metres."""
        return float(self.distance.sum())

    @property
    def axes(self) -> int:
        """2 on the page, 3 in space."""
        return self.place.shape[1]

    def approach(self, start: Float[np.ndarray, "piece 3"], end: Float[np.ndarray, "piece 3"], limb: Int[np.ndarray, " piece"]) -> None:
        """The tree has these pieces more, of these limbs."""
        if len(start) and len(self):
            start, end = start[:, : self.axes], end[:, : self.axes]
            if not np.isfinite(self.distance).all():  # one near each first, so that most pairs needn't be looked at
                _, piece = cKDTree(0.5 * (start + end)).query(self.place)
                new = np.sqrt(squared_each(self.place, start[piece], end[piece]))
                nearer = new < self.distance
                self.distance, self.nearest = np.where(nearer, new, self.distance), np.where(nearer, limb[piece], self.nearest)
            for first in range(0, len(start), _PIECES):
                self._approach(start[first : first + _PIECES], end[first : first + _PIECES], limb[first : first + _PIECES])

    def _approach(self, start, end, limb) -> None:
        """The same for as many pieces as fit in memory: only attractors are measured that the ball about all of them, and the one about a piece, come near."""
        middle, half = 0.5 * (start + end), 0.5 * np.linalg.norm(end - start, axis=1)
        whole = middle.mean(axis=0)
        near = np.flatnonzero(np.linalg.norm(self.place - whole, axis=1) - (np.linalg.norm(middle - whole, axis=1) + half).max() < self.distance)
        if len(near) == 0:
            return
        attractor, piece = _within(self.place[near], middle, self.distance[near], half)
        attractor = near[attractor]
        new = np.sqrt(squared_each(self.place[attractor], start[piece], end[piece]))
        order = np.lexsort((piece, new, attractor))
        attractor, new, piece = attractor[order], new[order], piece[order]
        first = np.flatnonzero(np.diff(attractor, prepend=NULL) != 0)
        first = first[new[first] < self.distance[attractor[first]]]
        self.distance, self.nearest = self.distance.copy(), self.nearest.copy()
        self.distance[attractor[first]], self.nearest[attractor[first]] = new[first], limb[piece[first]]

    def add(self, more: "Attractors") -> None:
        """These too."""
        self.place = np.concatenate([self.place, more.place])
        self.distance, self.nearest = np.r_[self.distance, more.distance], np.r_[self.nearest, more.nearest]

    def need(self, limbs: int, floor: float = 0.0) -> Float[np.ndarray, " limb"]:
        """For each of so many limbs, how far in all the attractors are that it is the nearest to, metres; those nearer than `floor` left out."""
        far = (self.distance > floor) & (self.nearest != NULL)
        return np.bincount(self.nearest[far], self.distance[far], minlength=limbs)


def image_attractors(target: Target, interval: float) -> Float[np.ndarray, "attractor 2"]:
    """A square grid in the foliage, `interval` metres apart; at least one point."""
    rows, columns = np.array(target.mask.shape) * target.pixel / interval
    x = target.left + (np.arange(int(np.ceil(columns))) + 0.5) * interval
    y = target.top - (np.arange(int(np.ceil(rows))) + 0.5) * interval
    grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    found = grid[target.inside(grid)]
    return found if len(found) else target.centres[[len(target.centres) // 2]]


def volume_attractors(target: Target, axes: Axes, interval: float) -> Float[np.ndarray, "attractor 3"]:
    """A cubic grid in the foliage revolved, `interval` metres apart."""
    page = image_attractors(target, interval)
    deep = float(axes.half.max())
    level = np.arange(-np.ceil(deep / interval), np.ceil(deep / interval) + 1) * interval
    z = axes.depth_of_trunk(page[:, 1])[:, None] + level
    point = np.concatenate([np.repeat(page, len(level), axis=0), z.reshape(-1, 1)], axis=1)
    return point[axes.out(point) <= 1.0]


def turned_joints(joints: Float[np.ndarray, "joint 3"], target: Target, axes: Axes) -> Float[np.ndarray, "attractor 3"]:
    """Joints that are in the foliage, a quarter turn on; those that come to lie outside it left out: nothing may grow there."""
    turned = axes.turned(joints[target.inside(joints)])
    return turned[target.inside(turned)]


def distances(
    place: Float[np.ndarray, "place axis"], start: Float[np.ndarray, "piece axis"], end: Float[np.ndarray, "piece axis"]
) -> tuple[Float[np.ndarray, " place"], Int[np.ndarray, " place"]]:
    """(from each place to the nearest of straight pieces, which one that is); infinitely far and NULL without any."""
    found, which = np.full(len(place), np.inf), np.full(len(place), NULL)
    step = max(_BLOCK // max(len(place), 1), 1)
    for k in range(0, len(start), step):
        square = squared_each(place[:, None], start[k : k + step], end[k : k + step])
        piece = square.argmin(axis=1)
        new = np.sqrt(square[np.arange(len(place)), piece])
        found, which = np.where(new < found, new, found), np.where(new < found, piece + k, which)
    return found, which


def _within(place, middle, distance, half):
    """(attractor, piece) of all pairs of which the ball about the piece comes nearer than the attractor is from the tree."""
    away = np.zeros((len(middle), len(place)), np.float32)
    for axis in range(place.shape[1]):  # not a matrix product: those take threads that wait for each other
        step = place[:, axis].astype(np.float32) - middle[:, axis, None].astype(np.float32)
        away += np.square(step, out=step)
    most = ((distance + _SLACK * np.abs(place).max()).astype(np.float32) + half[:, None].astype(np.float32)) ** 2
    piece, attractor = np.nonzero(away < most)
    return attractor, piece


def squared_each(place, start, end):
    """Squares of the distances from places to straight pieces, each to its own."""
    vector = end - start
    from_start = place - start
    along = (from_start * vector).sum(axis=-1) / np.maximum((vector * vector).sum(axis=-1), _POINT)
    rest = from_start - np.clip(along, 0.0, 1.0)[..., None] * vector
    return (rest * rest).sum(axis=-1)
