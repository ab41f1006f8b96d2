"""All lines of a drawing as one set of arrays, so that a question is put to every line at once.

Points stand line after line. Lengths run on from line to line (`run`), each line's own begun at `begin`, a gap of 1 H
between them, so that one sorted search finds the place of any length on any line.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from jaxtyping import Float, Int

from sketchtree.sketch.joining.lines import Line, unit


@dataclass(frozen=True, eq=False)
class Bundle:
    """Lines side by side. `height` is H, of all lines together."""

    points: Float[np.ndarray, "point 2"]
    first: Int[np.ndarray, " line+1"]  # of each line's points
    run: Float[np.ndarray, " point"]
    begin: Float[np.ndarray, " line"]
    length: Float[np.ndarray, " line"]
    width: Float[np.ndarray, " line"]  # the middle one of each line's widths; NaN if they say nothing
    time: Float[np.ndarray, " line"]  # when each was begun, ms; NaN where the file does not say
    height: float

    @classmethod
    def of(cls, lines: list[Line]) -> "Bundle":
        """The lines as arrays; at least one line."""
        points = np.concatenate([line.points for line in lines])
        first = np.cumsum([0] + [len(line.points) for line in lines])
        step = np.hypot(*np.diff(points, axis=0, prepend=points[:1]).T)
        height = float(np.ptp(points, axis=0).max())
        step[first[:-1]] = height
        run = np.cumsum(step)
        begin = run[first[:-1]]
        width = np.array([typical_width(line.width) for line in lines])
        time = np.array([line.begun for line in lines])
        return cls(points, first, run, begin, run[first[1:] - 1] - begin, width, time, height)

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

    def at(self, line: Int[np.ndarray, "*place"], s: Float[np.ndarray, "*place"]) -> Float[np.ndarray, "*place 2"]:
        """The points at lengths `s` of lines `line`; beyond an end, the end."""
        wanted = self.begin[line] + np.clip(s, 0.0, self.length[line])
        after = np.clip(np.searchsorted(self.run, wanted), self.first[line] + 1, self.first[line + 1] - 1)
        low, high = self.run[after - 1], self.run[after]
        t = np.clip((wanted - low) / np.where(high > low, high - low, 1.0), 0.0, 1.0)[..., None]
        return self.points[after - 1] * (1 - t) + self.points[after] * t

    def direction(self, line, s, reach) -> Float[np.ndarray, "*place 2"]:
        """Unit direction at `s`, in the order of drawing, over `reach` to either side as far as the line goes."""
        return unit(self.at(line, s + reach) - self.at(line, s - reach))

    def leaving(self, reach: Float[np.ndarray, " line"]) -> Float[np.ndarray, "end 2"]:
        """Unit direction of every line as it leaves each of its ends, over `reach` of it."""
        line = np.repeat(np.arange(len(self)), 2)
        s = np.stack([reach, self.length - reach], 1).ravel()
        return unit(self.at(line, s) - self.ends)


def typical_width(width: Float[np.ndarray, " point"]) -> float:
    """The middle one of a line's widths; NaN if they say nothing."""
    known = width[np.isfinite(width)]
    return float(np.median(known)) if len(known) else np.nan
