"""A photo as every step here takes it: eight bits a channel, upright, sRGB.

Pixels, x right, y DOWN, the origin at the top left corner: the middle of the pixel in row r and column c is (c + ½, r + ½). Only what leaves this room counts y up
(`turned_over`)."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, UInt8

from sketchtree.errors import SketchError

LEAST = 2  # pixels, either way


@dataclass(frozen=True, eq=False)
class Photo:
    """One picture. Requirements, checked at construction: at least `LEAST` pixels either way (else SketchError)."""

    rgb: UInt8[np.ndarray, "row column 3"]  # sRGB, upright
    alpha: UInt8[np.ndarray, "row column"] | None = None  # where the file has one that is not full everywhere
    name: str = "photo"
    warnings: tuple[str, ...] = ()

    def __post_init__(self):
        rgb = np.array(self.rgb, np.uint8)
        assert rgb.ndim == 3 and rgb.shape[2] == 3, "a photo has rows, columns and three channels"
        if min(rgb.shape[:2]) < LEAST:
            raise SketchError(f"{self.name} has {rgb.shape[1]} × {rgb.shape[0]} pixels; {LEAST} × {LEAST} are the least.", remedy="Give a larger photo.")
        rgb.flags.writeable = False
        object.__setattr__(self, "rgb", rgb)

    @property
    def height(self) -> int:
        """Rows."""
        return self.rgb.shape[0]

    @property
    def width(self) -> int:
        """Columns."""
        return self.rgb.shape[1]

    @property
    def is_grey(self) -> bool:
        """Whether it has no colour at all."""
        return bool((self.rgb[..., 0] == self.rgb[..., 1]).all() and (self.rgb[..., 1] == self.rgb[..., 2]).all())


def turned_over(points: Float[np.ndarray, "point 2"]) -> Float[np.ndarray, "point 2"]:
    """Pixels with y down → with y up (or back): y negated, nothing shifted."""
    return np.asarray(points, np.float64) * [1.0, -1.0]


def at_pixels(mask: Bool[np.ndarray, "row column"], points: Float[np.ndarray, "point 2"]) -> Bool[np.ndarray, " point"]:
    """What a mask says at points (pixels, y down); False off the picture."""
    column, row = np.floor(np.asarray(points)).astype(np.int64).T
    inside = (row >= 0) & (row < mask.shape[0]) & (column >= 0) & (column < mask.shape[1])
    found = np.zeros(len(row), bool)
    found[inside] = mask[row[inside], column[inside]]
    return found
