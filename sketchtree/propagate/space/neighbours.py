"""Which place is whose, where several trees grow side by side?

A grid of voxels over all trees whose boxes meet. Into it goes the wood of every tree, and what its open branches would grow if they
met nothing: their claim. Every voxel belongs to the tree that is densest about it,

    owner = argmax_k  (t_k, G_σ * ρ_k + ε / (1 + |q − r_k|)),      t_k = 2 where k's wood is and it was k's; 1 where k's wood is; else 0

    ρ_k   metres of wood and claim of tree k in the voxel       G_σ   a Gaussian, `_BLUR` voxels wide
    r_k   foot of tree k: it decides where nothing is near; equals go to the foot that is first by (x, z, y)

so what has been grown into stays its tree's. Of tree k, the *territory* is a barrier and a guide. With φ the distance to the nearest
voxel of another, metres,

    barrier     wood may be where φ > gap / 2,   gap: a twig's length
    guide       d ← (1 − w) d + w t/|t|,   t = d + κ (n + u/4),   n = ∇φ/|∇φ|,   κ = −d·n > 0,   w = s² (3 − 2s),   s = 1 − (φ − gap/2) / D

Crowns that come near each other keep that gap, as crowns of a wood do (crown shyness, Putz et al. 1984), and branches turn up (u) and aside
before it. The field is made anew before every generation from all trees at once, so none of them is first.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.ndimage import distance_transform_edt, gaussian_filter, map_coordinates

from sketchtree.axes import NULL
from sketchtree.propagate.space.domain import Domain

MOST_VOXELS = 12_000_000  # of the whole grid
_MOST_OF_ONE = 120_000  # of one tree's box, about
_BLUR = 2.0  # voxels
_FAINT = 1e-3  # ε, metres of wood
_FEELS = 2.5  # D, in spacings of laterals
_UP = 0.25
_PROBES = 0.5  # voxels between two places of a step that are looked at


@dataclass(frozen=True, eq=False)
class Wood:
    """Wood, or wood to be, of one tree: pieces by their middles."""

    point: Float[np.ndarray, "piece 3"]  # metres
    length: Float[np.ndarray, " piece"]  # metres

    @classmethod
    def along(cls, start: Float[np.ndarray, "row 3"], end: Float[np.ndarray, "row 3"], pieces: int = 3) -> "Wood":
        """Straight rows, cut into so many pieces each; the last ends count as a piece of no length."""
        share = np.r_[(np.arange(pieces) + 0.5) / pieces, 1.0]
        point = start[:, None] + share[:, None] * (end - start)[:, None]
        length = np.linalg.norm(end - start, axis=1)[:, None] * np.r_[np.full(pieces, 1.0 / pieces), 0.0]
        return cls(point.reshape(-1, 3), length.ravel())


@dataclass(frozen=True, eq=False)
class Territory:
    """The places of one tree, in its own frame: a barrier and a guide of its space."""

    own: Bool[np.ndarray, "x y z"]
    distance: Float[np.ndarray, "x y z"]  # φ at the middles of the voxels, metres
    low: Float[np.ndarray, " 3"]  # corner of its first voxel in the world, metres
    place: Float[np.ndarray, " 3"]  # of the tree in the world, metres
    pitch: float
    gap: float  # metres
    influence: float  # D, metres

    def inside(self, point: Float[np.ndarray, "point 3"]) -> Bool[np.ndarray, " point"]:
        """Which points wood may be at; beyond the grid it is as at its rim."""
        voxel = _voxel(point, self.place, self.low, self.pitch, self.own.shape)
        return self.own[tuple(voxel.T)] & (self._margin(point) > 0)

    def exit_fraction(
        self, start: Float[np.ndarray, "branch 3"], end: Float[np.ndarray, "branch 3"], bisections: int = 9
    ) -> Float[np.ndarray, " branch"]:
        """The fraction of each way from `start` to `end` that is the tree's own, 0-1; 0 for what starts elsewhere."""
        fraction = np.ones(len(start))
        length = np.linalg.norm(end - start, axis=1)
        rows = np.flatnonzero(self._margin(start) <= length + 2 * self.pitch)
        if len(rows) == 0:
            return fraction
        count = int(np.ceil(length[rows].max() / (_PROBES * self.pitch))) + 1
        going, way = rows, end - start
        going = going[self.inside(start[going])]
        fraction[rows] = 0.0
        for k in range(1, count + 1):
            going = going[self.inside(start[going] + k / count * way[going])]
            fraction[going] = k / count
        return fraction

    def turned(
        self,
        start: Float[np.ndarray, "branch 3"],
        heading: Float[np.ndarray, "branch 3"],
        step: Float[np.ndarray, " branch"],
        limb: Int[np.ndarray, " branch"],
    ) -> Float[np.ndarray, "branch 3"]:
        """Headings that lead less into what another tree holds; those that lead away stay the same to the last bit."""
        margin = self._margin(start)
        rows = np.flatnonzero(margin < self.influence)
        away = self._away(start[rows])
        against = -np.einsum("bi,bi->b", heading[rows], away)
        meets = against > 1e-9
        rows, away, against = rows[meets], away[meets], against[meets]
        if len(rows) == 0:
            return heading
        near = 1.0 - np.clip(margin[rows] / self.influence, 0.0, 1.0)
        weight = (near * near * (3.0 - 2.0 * near))[:, None]
        along = heading[rows] + against[:, None] * (away + _UP * np.eye(3)[1])
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        turned = (1.0 - weight) * heading[rows] + weight * along
        found = heading.copy()
        found[rows] = turned / np.linalg.norm(turned, axis=1, keepdims=True)
        return found

    def _margin(self, point):
        return self._distance(point) - 0.5 * self.gap

    def _distance(self, point):
        at = (point + self.place - self.low) / self.pitch - 0.5
        return map_coordinates(self.distance, at.T, order=1, mode="nearest")

    def _away(self, point):
        step = self.pitch * np.eye(3)
        slope = np.stack([self._distance(point + one) - self._distance(point - one) for one in step], axis=1)
        return slope / np.maximum(np.linalg.norm(slope, axis=1, keepdims=True), 1e-12)


class Neighbours:
    """The field that several trees share. It changes from generation to generation (`claimed`)."""

    def __init__(
        self,
        domains: list[Domain],
        places: Float[np.ndarray, "tree 3"],
        gaps: Float[np.ndarray, " tree"],
        *,
        most: int = MOST_VOXELS,
    ):
        """`domains` are the trees' boxes, each in its tree's own frame; `places` where these frames stand in the world and
        `gaps` twig lengths, metres."""
        self.domains, self.places, self.gaps = domains, places, gaps
        box = np.array([(domain.low + place, domain.high + place) for domain, place in zip(domains, places, strict=True)])
        self.meets = _meet(box)
        self.low, self.high = (box[self.meets].min(axis=(0, 1)), box[self.meets].max(axis=(0, 1))) if self.meets.any() else box[0]
        self.pitch = self._pitch(box[self.meets], most)
        self.shape = tuple(np.ceil((self.high - self.low) / self.pitch).astype(int) + 1)
        self.owner = np.full(self.shape if self.meets.any() else (0, 0, 0), NULL, np.int32)
        self.part = [_part(one, self.low, self.pitch) for one in box]
        self.wood = [np.zeros(_size(part), np.float32) if meets else None for part, meets in zip(self.part, self.meets, strict=True)]
        self.stands = [np.zeros(_size(part), bool) if meets else None for part, meets in zip(self.part, self.meets, strict=True)]
        foot = np.array([domain.root[0] + place for domain, place in zip(domains, places, strict=True)])
        self.foot, self.turns = foot, np.lexsort((foot[:, 1], foot[:, 2], foot[:, 0]))

    def _pitch(self, box, most: int) -> float:
        if len(box) == 0:
            return 1.0
        size = float(np.median(np.prod(box[:, 1] - box[:, 0], axis=1)))
        whole = float(np.prod(self.high - self.low))
        return max(0.5 * float(self.gaps[self.meets].min()), (size / _MOST_OF_ONE) ** (1 / 3), (whole / most) ** (1 / 3))

    def claimed(self, wood: list[Wood], claims: list[Wood]) -> list[Territory | None]:
        """The trees' territories, once each has this new wood and lays claim to that; None for a tree that meets no other.

        One `Wood` a tree, in its own frame."""
        best, rank = np.full(self.owner.shape, -1.0, np.float32), np.full(self.owner.shape, -1, np.int8)
        owner = np.full(self.owner.shape, NULL, np.int32)
        for k in self.turns[self.meets[self.turns]]:
            part, low = self.part[k], self._corner(k)
            more = _sum(wood[k], self.places[k], low, self.pitch, _size(part))
            self.wood[k] += more[0]
            self.stands[k] |= more[1]
            claim = _sum(claims[k], self.places[k], low, self.pitch, _size(part))[0]
            score = gaussian_filter(self.wood[k] + claim, _BLUR, mode="constant") + self._faint(k)
            tier = self.stands[k].astype(np.int8) * (1 + (self.owner[part] == k))
            wins = (tier > rank[part]) | ((tier == rank[part]) & (score > best[part]))
            for whole, its in ((best, score), (rank, tier), (owner, k)):
                whole[part] = np.where(wins, its, whole[part])
        self.owner = owner
        return [self._territory(k) if self.meets[k] else None for k in range(len(self.domains))]

    def _corner(self, k):
        return self.low + self.pitch * np.array([s.start for s in self.part[k]])

    def _faint(self, k):
        at = [self.low[axis] + self.pitch * (np.arange(s.start, s.stop) + 0.5) - self.foot[k, axis] for axis, s in enumerate(self.part[k])]
        away = np.sqrt(at[0][:, None, None] ** 2 + at[1][None, :, None] ** 2 + at[2][None, None, :] ** 2)
        return (_FAINT / (1.0 + away)).astype(np.float32)

    def _territory(self, k: int) -> Territory | None:
        own = self.owner[self.part[k]] == k
        if own.all():
            return None
        distance = (distance_transform_edt(own) - 0.5) * self.pitch
        influence = _FEELS * self.domains[k].spacing
        return Territory(own, distance, self._corner(k), self.places[k], self.pitch, float(self.gaps[k]), influence)


def _meet(box) -> Bool[np.ndarray, " tree"]:
    """Which boxes overlap another; swept along x, so that long rows of trees stay cheap."""
    found = np.zeros(len(box), bool)
    order = np.argsort(box[:, 0, 0], kind="stable")
    low, high = box[order, 0], box[order, 1]
    last = np.searchsorted(low[:, 0], high[:, 0])
    for k, end in enumerate(last):
        others = np.arange(k + 1, end)
        met = others[((low[others] < high[k]) & (high[others] > low[k])).all(axis=1)]
        found[order[met]] = True
        found[order[k]] |= len(met) > 0
    return found


def _part(box, low, pitch: float) -> tuple[slice, ...]:
    first = np.floor((box[0] - low) / pitch).astype(int)
    last = np.ceil((box[1] - low) / pitch).astype(int)
    return tuple(slice(max(int(a), 0), int(b)) for a, b in zip(first, last, strict=True))


def _size(part) -> tuple[int, ...]:
    return tuple(s.stop - s.start for s in part)


def _voxel(point, place, low, pitch: float, shape):
    at = np.floor((point + place - low) / pitch).astype(np.int64)
    return np.clip(at, 0, np.array(shape) - 1)


def _sum(wood: Wood, place, low, pitch: float, shape):
    """(metres of wood in every voxel of a part of the grid, whether there is any)."""
    flat = np.ravel_multi_index(tuple(_voxel(wood.point, place, low, pitch, shape).T), shape)
    size = int(np.prod(shape))
    metres = np.bincount(flat, wood.length, minlength=size).astype(np.float32)
    return metres.reshape(shape), np.bincount(flat, minlength=size).astype(bool).reshape(shape)
