"""All lines of a drawing as one set of arrays, so that a question is put to every line at once.

Points stand line after line. Each line's lengths are its own (`along`); `run` is the same made to grow from line to line,
so that one sorted search finds the place of any length on any line.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from jaxtyping import Float, Int

from sketchtree.sketch.joining.lines import Line, unit

TOWARD = (0.05, 0.35)  # of a line's length: the part that tells its width toward an end


@dataclass(frozen=True, eq=False)
class Bundle:
    """Lines side by side. `height` is H, of all lines together."""

    points: Float[np.ndarray, "point 2"]
    first: Int[np.ndarray, " line+1"]  # of each line's points
    along: Float[np.ndarray, " point"]
    width: Float[np.ndarray, " line"]  # the middle one of each line's widths; NaN if they say nothing
    taper: Float[np.ndarray, " line"]  # log of the width toward its last point over that toward its first; 0 where they say nothing
    time: Float[np.ndarray, " line"]  # when each was begun, ms; NaN where the file does not say
    height: float

    @classmethod
    def of(cls, lines: list[Line]) -> "Bundle":
        """The lines as arrays; at least one line."""
        known = bool((np.concatenate([line.width for line in lines]) > 0).any())
        width = np.array([typical_width(line.width) for line in lines]) if known else np.nan
        tapers = np.array([taper(line) for line in lines]) if known else 0.0
        return cls.of_points([line.points for line in lines], width, tapers, np.array([line.begun for line in lines]))

    @classmethod
    def of_points(cls, lines: list[Float[np.ndarray, "point 2"]], width=np.nan, taper=0.0, time=np.nan) -> "Bundle":
        """Polylines of two points or more as arrays; at least one polyline."""
        points = np.concatenate(lines)
        count = np.array([len(line) for line in lines])
        first = np.concatenate([[0], np.cumsum(count)])
        step = np.zeros(len(points))
        step[1:] = np.hypot(points[1:, 0] - points[:-1, 0], points[1:, 1] - points[:-1, 1])
        step[first[:-1]] = 0.0
        total = np.cumsum(step)
        along = total - np.repeat(total[first[:-1]], count)
        alike = [np.broadcast_to(np.asarray(column, float), len(lines)) for column in (width, taper, time)]
        return cls(points, first, along, *alike, float(np.ptp(points, axis=0).max()))

    @cached_property
    def length(self) -> Float[np.ndarray, " line"]:
        """Length of every line."""
        return self.along[self.first[1:] - 1]

    @cached_property
    def begin(self) -> Float[np.ndarray, " line"]:
        """Where every line's own lengths begin in `run`."""
        apart = self.length + self.height
        return np.cumsum(apart) - apart

    @cached_property
    def run(self) -> Float[np.ndarray, " point"]:
        """Lengths that grow from line to line."""
        return self.along + np.repeat(self.begin, np.diff(self.first))

    def __len__(self) -> int:
        return len(self.length)

    @cached_property
    def shapes(self) -> np.ndarray:
        """The lines for shapely (line)."""
        counts = np.diff(self.first)
        return shapely.linestrings(self.points, indices=np.repeat(np.arange(len(counts)), counts))

    @cached_property
    def ends(self) -> Float[np.ndarray, "end 2"]:
        """First and last point of every line, alternating: end 2 k + e is end e of line k."""
        return self.points[np.stack([self.first[:-1], self.first[1:] - 1], 1).ravel()]

    @cached_property
    def end_shapes(self) -> np.ndarray:
        """The same points for shapely (end)."""
        return shapely.points(self.ends)

    def after(self, line: Int[np.ndarray, "*place"], s: Float[np.ndarray, "*place"]) -> Int[np.ndarray, "*place"]:
        """The point that ends the piece on which length `s` of each line lies."""
        found = self.run.searchsorted(self.begin[line] + s)
        return np.minimum(np.maximum(found, self.first[line] + 1), self.first[line + 1] - 1)

    def at(self, line: Int[np.ndarray, "*place"], s: Float[np.ndarray, "*place"]) -> Float[np.ndarray, "*place 2"]:
        """The points at lengths `s` of lines `line`; beyond an end, the end."""
        after = self.after(line, s)
        low, high = self.along[after - 1], self.along[after]
        t = np.minimum(np.maximum((s - low) / np.where(high > low, high - low, 1.0), 0.0), 1.0)[..., None]
        return self.points[after - 1] * (1 - t) + self.points[after] * t

    def direction(self, line, s, reach) -> Float[np.ndarray, "*place 2"]:
        """Unit direction at `s`, in the order of drawing, over `reach` to either side as far as the line goes."""
        return unit(self.at(line, s + reach) - self.at(line, s - reach))

    def thicker_away(self) -> Float[np.ndarray, " end"]:
        """log of every line's width toward the other end over that toward this one."""
        return np.stack([self.taper, -self.taper], 1).ravel()

    def leaving(self, reach: Float[np.ndarray, " line"]) -> Float[np.ndarray, "end 2"]:
        """Unit direction of every line as it leaves each of its ends, over `reach` of it."""
        line = np.repeat(np.arange(len(self)), 2)
        s = np.stack([reach, self.length - reach], 1).ravel()
        return unit(self.at(line, s) - self.ends)


def typical_width(width: Float[np.ndarray, " point"]) -> float:
    """The middle one of a line's widths; NaN if they say nothing. A width of 0 says nothing."""
    known = width[width > 0]
    return float(np.median(known)) if len(known) else np.nan


def taper(line: Line) -> float:
    """log of a line's typical width over its last part to that over its first; 0 if they say nothing.

    The very ends are left out: a pen presses lightly there whichever way it goes.
    """
    if not (line.width > 0).all() or line.width.max() == line.width.min():
        return 0.0
    width = np.interp(np.linspace(*TOWARD, 8) * line.length, line.along, line.width)
    other = np.interp((1 - np.linspace(*TOWARD, 8)) * line.length, line.along, line.width)
    return float(np.log(np.median(other) / np.median(width)))
