"""The pixels of a photo, each different colour once: what a mixture says of a colour is worked out once, however many pixels have it."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int, UInt8


@dataclass(frozen=True, eq=False)
class Pixels:
    """The pixels of a picture that lie in a mask, row by row."""

    at: Int[np.ndarray, " pixel"]  # row × width + column
    colour: Float[np.ndarray, "colour 3"]  # every colour that occurs, 0-255
    which: Int[np.ndarray, " pixel"]  # row of `colour`
    width: int

    @classmethod
    def of(cls, rgb: UInt8[np.ndarray, "row column 3"], mask: Bool[np.ndarray, "row column"]) -> "Pixels":
        """The pixels of a mask."""
        at = np.flatnonzero(mask)
        code = rgb.reshape(-1, 3)[at].astype(np.int64) @ [65536, 256, 1]
        found, which = np.unique(code, return_inverse=True)
        return cls(at, np.stack([found >> 16, (found >> 8) & 255, found & 255], axis=1).astype(np.float64), which, rgb.shape[1])

    def __len__(self) -> int:
        return len(self.at)

    def colours(self) -> Float[np.ndarray, "pixel 3"]:
        """The colour of every pixel."""
        return self.colour[self.which]

    def some(self, rows: Int[np.ndarray, " some"]) -> "Pixels":
        """A few of them, with the colours that they have."""
        kept, which = np.unique(self.which[rows], return_inverse=True)
        return Pixels(self.at[rows], self.colour[kept], which, self.width)
