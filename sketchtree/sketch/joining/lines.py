"""The strokes as clean polylines, measured along their length: what attaching works on."""

import dataclasses
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from jaxtyping import Float

DOUBLED = 1e-9  # of a line's length: points nearer than this are one


@dataclass(frozen=True, eq=False)
class Line:
    """One branch line: a stroke, or what was left of it after cleaning. At least two points, none doubled."""

    row: int  # of its stroke in the sketch
    id: str  # of its stroke
    points: Float[np.ndarray, "point 2"]  # sketch units, y up
    width: Float[np.ndarray, " point"]  # drawn width; NaN where it says nothing
    begun: float = np.nan  # when its stroke was begun, ms; NaN where the file does not say

    @cached_property
    def along(self) -> Float[np.ndarray, " point"]:
        """Length of the line up to each point."""
        step = self.points[1:] - self.points[:-1]
        along = np.zeros(len(self.points))
        np.cumsum(np.hypot(step[:, 0], step[:, 1]), out=along[1:])
        return along

    @cached_property
    def length(self) -> float:
        """Length of the whole line, sketch units."""
        return float(self.along[-1])

    @cached_property
    def shape(self) -> shapely.LineString:
        """The same line for shapely."""
        return shapely.LineString(self.points)

    def at(self, s) -> Float[np.ndarray, "*s 2"]:
        """The point(s) at length `s`."""
        point = np.empty((*np.shape(s), 2))
        for axis in (0, 1):
            point[..., axis] = np.interp(s, self.along, self.points[:, axis])
        return point

    def direction(self, s: float, reach: float) -> Float[np.ndarray, " 2"]:
        """Unit direction at `s`, taken over `reach` to either side as far as the line goes."""
        return unit(self.at(min(s + reach, self.length)) - self.at(max(s - reach, 0.0)))

    def reversed(self) -> "Line":
        """The same line drawn the other way."""
        return dataclasses.replace(self, points=self.points[::-1], width=self.width[::-1])

    def cut(self, low: float, high: float) -> "Line":
        """The part between two lengths (low < high); a drawn point where it is cut is not doubled."""
        same = DOUBLED * self.length
        inner = (self.along > low + same) & (self.along < high - same)
        s = np.concatenate([[low], self.along[inner], [high]])
        points = np.concatenate([self.at(s[:1]), self.points[inner], self.at(s[-1:])])
        return dataclasses.replace(self, points=points, width=np.interp(s, self.along, self.width))


def turning(lines: list[Line]) -> Float[np.ndarray, " line"]:
    """How much every line turns in all, radians: the sum of its angles from one piece to the next."""
    points = np.concatenate([line.points for line in lines])
    first = np.cumsum([0] + [len(line.points) for line in lines])
    step = np.diff(points, axis=0)
    angle = np.zeros(len(points))
    angle[1:-1] = angle_between(step[:-1], step[1:])
    angle[first[:-1]] = angle[first[1:] - 1] = 0.0
    return np.add.reduceat(angle, first[:-1])


def unit(vector: Float[np.ndarray, "*row 2"]) -> Float[np.ndarray, "*row 2"]:
    """Vectors scaled to length 1; a zero vector stays zero."""
    norm = np.hypot(vector[..., 0], vector[..., 1])[..., None]
    return vector / np.where(norm > 0, norm, 1.0)


def angle_between(a: Float[np.ndarray, "*row 2"], b: Float[np.ndarray, "*row 2"]) -> Float[np.ndarray, "*row"]:
    """Angle between directions, radians, 0 to π."""
    return np.abs(np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(-1)))


def extent(lines: list[Line]) -> float:
    """H: the lines' height, or their width where that is larger."""
    points = np.concatenate([line.points for line in lines])
    return float(np.ptp(points, axis=0).max())
