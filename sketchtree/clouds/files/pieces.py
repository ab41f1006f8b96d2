"""What does a reader hand on? The points of a file, some at a time, in the file's own numbers; so a file may be larger than memory."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from jaxtyping import Float

PIECE = 500_000  # points
Axis = Literal["y", "z"]


@dataclass(frozen=True, eq=False)
class Piece:
    """Some points of a file. Numbers may be anything that a file can hold, NaN too."""

    xyz: Float[np.ndarray, "point 3"]
    colour: Float[np.ndarray, "point 3"] | None = None  # 0 to the source's `colour_top`
    normal: Float[np.ndarray, "point 3"] | None = None  # of any length


@dataclass(eq=False)
class Source:
    """A file that was opened: what it says of itself, and its points."""

    what: str
    pieces: Iterator[Piece]
    points: int | None = None  # as the file says; None where it doesn't
    colour_top: float | None = None  # what full colour is written as; None: 1, 255 or 65535, by the largest seen
    up: Axis | None = None  # the axis that the file says is up
    remarks: list[str] = field(default_factory=list)  # may grow while pieces are read
