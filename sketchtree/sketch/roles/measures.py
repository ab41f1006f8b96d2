"""What does every stroke look like? One row of numbers a stroke, for all strokes at once.

    P   length along the stroke, its closing piece left out        A   area once it is closed (shoelace)
    Σ|φ|, Σφ   how much it turns in all, and net (2π: once round)   d   distance between its ends
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from jaxtyping import Bool, Float, Int

from sketchtree.sketch.strokes import Stroke

NEEDLE = 16  # points to which a stroke is thinned out before its turning is summed: a tremor is no turn


@dataclass(frozen=True, eq=False)
class Measures:
    """The strokes of a drawing in numbers; sketch units, y up."""

    strokes: tuple[Stroke, ...]
    points: Float[np.ndarray, "point 2"]  # of all strokes, one after the other
    first_point: Int[np.ndarray, " stroke+1"]  # where each begins in `points`

    @classmethod
    def of(cls, strokes: tuple[Stroke, ...]) -> "Measures":
        """The measures of these strokes (at least one)."""
        counts = np.array([len(stroke.points) for stroke in strokes])
        return cls(tuple(strokes), np.concatenate([stroke.points for stroke in strokes]), np.r_[0, np.cumsum(counts)])

    def __len__(self) -> int:
        return len(self.strokes)

    @cached_property
    def low(self) -> Float[np.ndarray, "stroke 2"]:
        """Lower left corner of each stroke's bounding box."""
        return np.minimum.reduceat(self.points, self.first_point[:-1])

    @cached_property
    def high(self) -> Float[np.ndarray, "stroke 2"]:
        """Upper right corner of each stroke's bounding box."""
        return np.maximum.reduceat(self.points, self.first_point[:-1])

    @cached_property
    def first(self) -> Float[np.ndarray, "stroke 2"]:
        """First points."""
        return self.points[self.first_point[:-1]]

    @cached_property
    def last(self) -> Float[np.ndarray, "stroke 2"]:
        """Last points."""
        return self.points[self.first_point[1:] - 1]

    @cached_property
    def size(self) -> Float[np.ndarray, " stroke"]:
        """The larger side of each bounding box."""
        return (self.high - self.low).max(1)

    @cached_property
    def length(self) -> Float[np.ndarray, " stroke"]:
        """P."""
        return np.add.reduceat(np.where(np.isfinite(self._step), self._step, 0.0), self.first_point[:-1])

    @cached_property
    def shortest_step(self) -> Float[np.ndarray, " stroke"]:
        """The least distance from one point to the next; infinite for a single point."""
        return np.minimum.reduceat(self._step, self.first_point[:-1])

    @cached_property
    def _step(self) -> Float[np.ndarray, " point"]:
        """Distance of every point from the next of its stroke; infinite at the last."""
        step = np.r_[np.hypot(*np.diff(self.points, axis=0).T), np.inf]
        step[self.first_point[1:] - 1] = np.inf
        return step

    @cached_property
    def area(self) -> Float[np.ndarray, " stroke"]:
        """A, without sign."""
        origin = np.repeat(self.first, np.diff(self.first_point), axis=0)
        x, y = (self.points - origin).T
        moment = np.r_[x[:-1] * y[1:] - x[1:] * y[:-1], 0.0]
        moment[self.first_point[1:] - 1] = 0.0
        return 0.5 * np.abs(np.add.reduceat(moment, self.first_point[:-1]))

    @cached_property
    def opening(self) -> Float[np.ndarray, " stroke"]:
        """d; 0 where the file says that the stroke is closed."""
        apart = np.hypot(*(self.first - self.last).T)
        return np.where(self.closed, 0.0, apart)

    @cached_property
    def around(self) -> Float[np.ndarray, " stroke"]:
        """Length of each stroke with its closing piece."""
        return self.length + np.hypot(*(self.first - self.last).T)

    @cached_property
    def closed(self) -> Bool[np.ndarray, " stroke"]:
        """Strokes that the file closes, or that are painted."""
        return np.array([stroke.closed or stroke.filled for stroke in self.strokes])

    @cached_property
    def filled(self) -> Bool[np.ndarray, " stroke"]:
        """Painted areas."""
        return np.array([stroke.filled for stroke in self.strokes])

    @cached_property
    def evenly(self) -> Float[np.ndarray, "stroke step 2"]:
        """NEEDLE points at even lengths along each stroke (all alike on a dot)."""
        return self.resampled(np.arange(len(self)), NEEDLE)

    @cached_property
    def turning(self) -> Float[np.ndarray, " stroke"]:
        """Σ|φ| of the thinned-out stroke, radians."""
        return np.abs(self._turns).sum(1)

    @cached_property
    def winding(self) -> Float[np.ndarray, " stroke"]:
        """|Σφ| of the thinned-out stroke, radians."""
        return np.abs(self._turns.sum(1))

    @cached_property
    def _turns(self) -> Float[np.ndarray, "stroke turn"]:
        step = np.diff(self.evenly, axis=1)
        a, b = step[:, :-1], step[:, 1:]
        return np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(-1))

    @cached_property
    def drawing(self) -> tuple[Float[np.ndarray, " 2"], Float[np.ndarray, " 2"]]:
        """(lower left, upper right corner) of the whole drawing."""
        return self.low.min(0), self.high.max(0)

    def shapes(self, rows: Int[np.ndarray, " row"]) -> np.ndarray:
        """These strokes as lines for shapely, a single point doubled; closing pieces are left out."""
        counts = np.diff(self.first_point)[rows]
        at = np.repeat(self.first_point[:-1][rows] - np.r_[0, np.cumsum(counts)[:-1]], counts) + np.arange(counts.sum())
        index = np.repeat(np.arange(len(rows)), counts)
        single = np.flatnonzero(counts == 1)
        at, index = np.r_[at, self.first_point[:-1][rows[single]]], np.r_[index, single]
        order = np.argsort(index, kind="stable")
        return shapely.linestrings(self.points[at[order]], indices=index[order])

    def resampled(self, rows: Int[np.ndarray, " row"], count: int) -> Float[np.ndarray, "row step 2"]:
        """`count` points at even lengths along each of these strokes, as drawn (closing pieces left out)."""
        starts, ends = self.first_point[:-1][rows], self.first_point[1:][rows]
        counts = ends - starts
        at = np.repeat(starts - np.r_[0, np.cumsum(counts)[:-1]], counts) + np.arange(counts.sum())
        points, first = self.points[at], np.r_[0, np.cumsum(counts)]
        step = np.r_[0.0, np.hypot(*np.diff(points, axis=0).T)]
        step[first[:-1]] = 0.0
        along = np.cumsum(step)
        begin, total = along[first[:-1]], along[first[1:] - 1] - along[first[:-1]]
        pad = np.arange(len(rows)) * (2.0 * along[-1] + 1.0)  # keeps neighbouring strokes apart
        wanted = begin[:, None] + pad[:, None] + total[:, None] * np.linspace(0, 1, count)
        axis = along + np.repeat(pad, counts)
        return np.stack([np.interp(wanted, axis, points[:, k]) for k in (0, 1)], -1)
