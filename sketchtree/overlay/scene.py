"""A flat picture, before it is written: lines, discs and words in pixels, x right, y down."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, UInt8


@dataclass(frozen=True, eq=False)
class Path:
    """A line, or an area if it has a `fill`."""

    points: Float[np.ndarray, "point 2"]  # pixels
    colour: str | None  # #rrggbb; None: no line
    width: float = 1.5  # pixels
    opacity: float = 1.0
    dash: float | None = None  # pixels of line, then as many of nothing; None: a whole line
    closed: bool = False
    fill: str | None = None  # #rrggbb
    fill_opacity: float = 0.15


@dataclass(frozen=True)
class Disc:
    """A round mark."""

    x: float
    y: float
    radius: float  # pixels
    fill: str | None  # #rrggbb
    colour: str | None = None  # of its rim
    width: float = 1.5


@dataclass(frozen=True)
class Words:
    """One line of text; (x, y) is the left, middle or right end of its base line."""

    x: float
    y: float
    text: str
    size: float = 15.0  # pixels
    colour: str = "#222222"
    anchor: str = "start"  # start | middle | end
    bold: bool = False
    halo: bool = False  # white around the letters, for what lies over a drawing


@dataclass(frozen=True, eq=False)
class Underlay:
    """A picture under everything, shown faintly."""

    pixels: UInt8[np.ndarray, "row column 3"]
    box: tuple[float, float, float, float]  # left, top, width, height, pixels of the scene
    opacity: float = 0.35


@dataclass(frozen=True, eq=False)
class Scene:
    """What is to be seen, in the order of painting."""

    width: int  # pixels
    height: int
    marks: tuple[Path | Disc | Words, ...]
    title: str
    underlay: Underlay | None = None
