"""How far is it to the nearest surface, and which way is away from it?

The surface is given by samples of it. Distances to them are held at the corners of a regular grid, in the plane or in space, negative
where it is solid, between corners multilinear: every corner reads a sample near it (the Euclidean distance transform of the corners next
to samples says which: Maurer et al. 2003, as in scipy), as a disc one pitch wide to either side, so that what is flat reads as flat. Beyond `band`
the grid tells nothing apart. Close to the surface the samples themselves are asked (a k-d tree).

    F(p)   the distance read off the grid, between corners or at the nearest one
    d(p)   the true one
    ρ      how far a point of the surface may be from every sample
    e      slack of the grid: d ≥ F − e

With pitch h in k dimensions e counts half a cell's diagonal, a = h √k / 2, where a sample stands for its nearest corner,
again where a corner reads that corner's, and again from there to p (d is 1-Lipschitz; the nearest corner is a away at most, and
so are all corners of a cell on average, by their weights):

    e = 3 a + ρ,      and with δ the distance to the nearest sample,   d ≥ δ − ρ

So a ball of that radius about p holds nothing of the surface and may be crossed in one stride, however thin the surface
is (sphere tracing, Hart 1996).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Bool, Float
from scipy.ndimage import distance_transform_edt
from scipy.spatial import cKDTree

MOST_CORNERS = 8_000_000  # of one grid


@dataclass(frozen=True, eq=False)
class DistanceField:
    """Distances on a grid, and the samples they are distances to. Beyond the grid everything is `band` away."""

    corners: tuple[Float[np.ndarray, " corner"], ...]  # along each of 2 or 3 axes, metres, evenly apart
    distance: Float[np.ndarray, "..."]  # at the corners, metres, −band to band, 32 bits
    sample: Float[np.ndarray, "sample axis"]
    band: float  # metres: what is farther counts as this far
    apart: float  # ρ, metres

    @classmethod
    def from_samples(
        cls,
        sample: Float[np.ndarray, "sample axis"],
        normal: Float[np.ndarray, "sample axis"],
        corners: tuple[Float[np.ndarray, " corner"], ...],
        solid: Bool[np.ndarray, "..."],
        band: float,
        apart: float,
    ) -> "DistanceField":
        """The field on a grid (see `grid`); `normal` are unit, to either side.

        No point of the surface within the grid may be farther than `apart` (ρ) from every sample."""
        distance = np.minimum(_distances(sample, normal, corners), band, dtype=np.float32)
        return cls(corners, np.where(solid, -distance, distance), sample, band, apart)

    @property
    def axes(self) -> int:
        """2 in the plane, 3 in space."""
        return len(self.corners)

    @property
    def pitch(self) -> float:
        """h, metres between corners."""
        return float(self.corners[0][1] - self.corners[0][0])

    @property
    def slack(self) -> float:
        """e, metres."""
        return 1.5 * np.sqrt(self.axes) * self.pitch + self.apart

    @cached_property
    def _tree(self) -> cKDTree:
        return cKDTree(self.sample, balanced_tree=False, compact_nodes=False)

    def at(self, point: Float[np.ndarray, "point axis"]) -> Float[np.ndarray, " point"]:
        """F at these points, metres; negative where it is solid."""
        found = np.full(len(point), self.band)
        rows, cell, part = self._cells(point)
        found[rows] = _between(self._about(cell), part)
        return found

    def at_least(self, point: Float[np.ndarray, "point axis"], exact: float) -> Float[np.ndarray, " point"]:
        """What d is at least, metres; 0 in cells that are solid. Where that is less than `exact` by the grid, by the nearest sample."""
        found = self.roughly(point) - self.slack
        close = np.flatnonzero(found < exact)
        close = close[~self._in_solid(point[close])]
        found[close] = self._tree.query(point[close])[0] - self.apart
        return np.maximum(found, 0.0)

    def roughly(self, point: Float[np.ndarray, "point axis"]) -> Float[np.ndarray, " point"]:
        """F at the corner nearest to each point, metres: wrong by no more than the slack either way."""
        flat, held = np.zeros(len(point), np.int64), np.ones(len(point), bool)
        for axis, along in enumerate(self.corners):
            number = np.rint((point[:, axis] - along[0]) / self.pitch)
            held &= (number >= 0) & (number < len(along))
            flat *= len(along)
            flat += np.where(held, number, 0).astype(np.int64)
        return np.where(held, self.distance.ravel()[flat * held], self.band)

    def away(self, point: Float[np.ndarray, "point axis"]) -> Float[np.ndarray, "point axis"]:
        """Unit directions away from what is near, ∇F / |∇F|; 0 where nothing is."""
        rows, cell, part = self._cells(point)
        about = self._about(cell)
        slope = np.stack([_between(np.diff(about, axis=k), part, leave=k) for k in range(self.axes)], axis=1)
        length = np.linalg.norm(slope, axis=1)
        found = np.zeros((len(point), self.axes))
        found[rows] = slope / np.where(length > 1e-6 * self.pitch, length, np.inf)[:, None]
        return found

    def _cells(self, point):
        """(rows inside the grid, the first corner of the cell of each, where in it it lies, 0-1; both by axis)."""
        at = [(point[:, k] - along[0]) / self.pitch for k, along in enumerate(self.corners)]
        held = np.ones(len(point), bool)
        for axis, along in zip(at, self.corners, strict=True):
            held &= (axis >= 0) & (axis < len(along) - 1)
        rows = np.flatnonzero(held)
        at = [axis[rows] for axis in at]
        cell = [axis.astype(np.int64) for axis in at]
        return rows, cell, [axis - first for axis, first in zip(at, cell, strict=True)]

    def _about(self, cell):
        """F at the corners of the cells: one axis of 2 for each of the grid's, and the cells last."""
        flat = np.ravel_multi_index(cell, self.distance.shape)
        apart = np.cumprod([1, *self.distance.shape[:0:-1]])[::-1]
        step = sum(np.ix_(*[[0, stride] for stride in apart]))
        return self.distance.ravel()[step[..., None] + flat]

    def _in_solid(self, point):
        """Which points lie in a cell all of whose corners are solid."""
        found = np.zeros(len(point), bool)
        if self._solid.any():
            rows, cell, _ = self._cells(point)
            found[rows] = self._solid[tuple(cell)]
        return found

    @cached_property
    def _solid(self) -> Bool[np.ndarray, "..."]:
        """The cells all of whose corners are solid."""
        solid = self.distance < 0
        for axis, count in enumerate(solid.shape):
            solid = solid.take(np.arange(count - 1), axis) & solid.take(np.arange(1, count), axis)
        return solid


def grid(low: Float[np.ndarray, " axis"], high: Float[np.ndarray, " axis"], pitch: float) -> tuple[Float[np.ndarray, " corner"], ...]:
    """Corners `pitch` apart along each axis, from `low` to `high` or just beyond, metres."""
    count = np.ceil((high - low) / pitch).astype(np.int64) + 2
    assert np.prod(count.astype(float)) <= MOST_CORNERS
    return tuple(first + pitch * np.arange(n) for first, n in zip(low, count, strict=True))


def _between(about, part, leave: int | None = None):
    """What is read between the corners of cells, from axis to axis; the axis to `leave` has one corner only."""
    for axis, share in enumerate(part):
        about = about[0] if axis == leave else about[0] + share * (about[1] - about[0])
    return about


def _distances(sample, normal, corners):
    """The distance of every corner to the disc about the sample of the nearest corner that has one."""
    shape = tuple(len(along) for along in corners)
    low, pitch = np.array([along[0] for along in corners]), corners[0][1] - corners[0][0]
    corner = np.rint((sample - low) / pitch).astype(np.int64)
    held = np.flatnonzero(((corner >= 0) & (corner < shape)).all(axis=1))
    if len(held) == 0:
        return np.full(shape, np.inf)
    flat = np.ravel_multi_index(tuple(corner[held].T), shape)
    which = np.full(shape, -1, np.int32)
    which.ravel()[flat] = held
    nearest = distance_transform_edt(which < 0, return_distances=False, return_indices=True)
    which = which[tuple(nearest)]
    squares, height = np.zeros(shape, np.float32), np.zeros(shape, np.float32)
    for axis, along in enumerate(corners):
        along = along.reshape([-1 if k == axis else 1 for k in range(len(shape))])
        off = (along - sample[:, axis][which]).astype(np.float32)
        squares += off**2
        height += off * normal[:, axis].astype(np.float32)[which]
    beside = np.sqrt(np.maximum(squares - height**2, 0.0)) - np.float32(pitch)
    return np.hypot(height, np.maximum(beside, 0.0))
