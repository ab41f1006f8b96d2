"""The strokes as clean polylines, measured along their length: what attaching works on."""

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
        return lengths(self.points)

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
        return Line(self.row, self.id, self.points[::-1], self.width[::-1], self.begun)

    def cut(self, low: float, high: float) -> "Line":
        """The part between two lengths (low < high); a drawn point where it is cut is not doubled."""
        same = DOUBLED * self.length
        after, before = self.along.searchsorted(low + same, side="right"), self.along.searchsorted(high - same)
        s, points = np.empty(max(before - after, 0) + 2), np.empty((max(before - after, 0) + 2, 2))
        s[0], s[1:-1], s[-1] = low, self.along[after:before], high
        points[0] = self.at(low) if low > 0 else self.points[0]
        points[-1] = self.at(high) if high < self.length else self.points[-1]
        points[1:-1] = self.points[after:before]
        return Line(self.row, self.id, points, np.interp(s, self.along, self.width), self.begun)


def lengths(points: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, " point"]:
    """Length of a polyline up to each of its points."""
    step = points[1:] - points[:-1]
    along = np.zeros(len(points))
    np.hypot(step[:, 0], step[:, 1]).cumsum(out=along[1:])
    return along


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
    return np.abs(np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1]))


def ends_of(lines: list[Line]) -> Float[np.ndarray, "end 2"]:
    """First and last point of every line, alternating."""
    return np.array([point for line in lines for point in (line.points[0], line.points[-1])])


def shapes_of(lines: list[Line]) -> np.ndarray:
    """The lines for shapely (line)."""
    index = np.repeat(np.arange(len(lines)), [len(line.points) for line in lines])
    return shapely.linestrings(np.concatenate([line.points for line in lines]), indices=index)


def corners(lines: list[Line]) -> tuple[Float[np.ndarray, "line 2"], Float[np.ndarray, "line 2"]]:
    """(lower left, upper right corner) of the box around every line; at least one line."""
    points = np.concatenate([line.points for line in lines])
    first = np.cumsum([0] + [len(line.points) for line in lines[:-1]])
    return np.minimum.reduceat(points, first), np.maximum.reduceat(points, first)


def extent(lines: list[Line]) -> float:
    """H: the lines' height, or their width where that is larger."""
    points = np.concatenate([line.points for line in lines])
    return float(np.ptp(points, axis=0).max())
