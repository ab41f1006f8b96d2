"""Where was foliage seen? A mask on the page and its place in the world.

The camera is orthographic and looks along −z (Tan et al. 2008, §3.1): a point (x, y, z) is seen at (x, y), whatever its depth. The mask counts rows from its top:

    x = left + c · pixel,   y = top − r · pixel        of the upper left corner of the pixel in row r and column c

Foliage has gaps smaller than a leaf is long, and wood goes through them: growth is kept to the mask with those closed (`closed`). It ends where foliage is dense (`dense`): leaves that hang elsewhere would
fill the gaps.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from jaxtyping import Bool, Float
from scipy import ndimage, signal

from sketchtree.errors import OptionError

_FINEST = 600  # pixels, the longer side of the mask at most that growth looks at: an eighth of a leaf
_DENSE = (0.5, 0.4, 0.3)  # of a disc as large as a leaf is long, is foliage where leaves are dense
_KEPT = 0.98  # of the foliage, within a leaf of it
_STEPS = 4  # places looked at along a piece of wood


@dataclass(frozen=True, eq=False)
class Target:
    """Foliage of one tree. Requirements, checked at construction: at least one pixel is foliage; pixels have a size."""

    mask: Bool[np.ndarray, "row column"]  # rows from the top; True: foliage
    left: float  # x of the mask's left edge, metres
    top: float  # y of its upper edge, metres
    pixel: float  # metres a pixel

    def __post_init__(self):
        mask = np.array(self.mask, bool)
        if mask.ndim != 2 or not mask.any():
            raise OptionError("There is no foliage to grow into: the mask has no pixel that is set.", remedy="Draw the crown around the leaves.")
        if not (np.isfinite([self.left, self.top, self.pixel]).all() and self.pixel > 0):
            raise OptionError(f"A pixel of the mask is {self.pixel:g} m.", remedy="Give a size above zero.")
        mask.flags.writeable = False
        object.__setattr__(self, "mask", mask)

    @classmethod
    def of_outlines(cls, outlines, pixels: int = 512) -> "Target":
        """All that closed outlines (each point 2, world metres, y up) enclose; the longer side has so many pixels."""
        shapes = [shapely.make_valid(shapely.Polygon(np.asarray(outline, float))) for outline in outlines if len(outline) > 2]
        whole = shapely.union_all(shapes) if shapes else shapely.Polygon()
        if whole.area <= 0:
            raise OptionError("The crown encloses nothing.", remedy="Draw it as a closed line around the leaves.")
        low_x, low_y, high_x, high_y = whole.bounds
        pixel = max(high_x - low_x, high_y - low_y) / pixels
        columns, rows = (max(int(np.ceil(span / pixel)), 1) for span in (high_x - low_x, high_y - low_y))
        x, y = np.meshgrid(low_x + (np.arange(columns) + 0.5) * pixel, high_y - (np.arange(rows) + 0.5) * pixel)
        return cls(shapely.contains_xy(whole, x, y), float(low_x), float(high_y), float(pixel))

    @property
    def height(self) -> float:
        """From the lowest foliage to the highest, metres."""
        rows = np.flatnonzero(self.mask.any(axis=1))
        return float((rows[-1] - rows[0] + 1) * self.pixel)

    @property
    def highest(self) -> float:
        """y of the highest foliage, metres."""
        return float(self.top - np.flatnonzero(self.mask.any(axis=1))[0] * self.pixel)

    def coarser(self, most: int = _FINEST) -> "Target":
        """The same with at most so many pixels on its longer side; a pixel is foliage where half of what it covers is, or where else nothing would be left."""
        step = -(-max(self.mask.shape) // most)
        if step <= 1:
            return self
        rows, columns = (-(-side // step) for side in self.mask.shape)
        padded = np.zeros((rows * step, columns * step), np.float32)
        padded[: self.mask.shape[0], : self.mask.shape[1]] = self.mask
        share = padded.reshape(rows, step, columns, step).mean(axis=(1, 3))
        return Target(share >= min(0.5, share.max()), self.left, self.top, self.pixel * step)

    def closed(self, gap: float) -> "Target":
        """The same with gaps closed that are up to twice `gap` wide (metres)."""
        steps = int(np.ceil(gap / self.pixel)) + 1
        mask = np.pad(self.mask, steps)
        near = ndimage.distance_transform_edt(~mask) * self.pixel <= gap
        kept = ndimage.distance_transform_edt(near) * self.pixel > gap
        return Target(mask | kept, self.left - steps * self.pixel, self.top + steps * self.pixel, self.pixel)

    def dense(self, leaf: float) -> "Target":
        """Where leaves of this length are at home: what is foliage for half or more for a leaf's length round it. The share asked for is the highest of `_DENSE` at which `_KEPT` of the foliage lies
        within a leaf of what is left, so that branchlets that stand by themselves stay."""
        steps = int(np.ceil(leaf / self.pixel)) + 1
        mask = np.pad(self.mask, steps)
        offset = np.arange(-steps, steps + 1) * self.pixel
        disc = np.hypot(offset[:, None], offset) <= leaf
        share = signal.fftconvolve(mask, disc / disc.sum(), mode="same")
        for least in _DENSE:
            dense = share >= least
            if dense.any() and np.mean(ndimage.distance_transform_edt(~dense)[mask] * self.pixel <= leaf) >= _KEPT:
                return Target(dense, self.left - steps * self.pixel, self.top + steps * self.pixel, self.pixel)
        return self

    def inside(self, point: Float[np.ndarray, "*point axis"]) -> Bool[np.ndarray, "*point"]:
        """Which points (metres; x, y and perhaps z) are seen where foliage is."""
        point = np.asarray(point)
        column = np.floor((point[..., 0] - self.left) / self.pixel).astype(np.int64)
        row = np.floor((self.top - point[..., 1]) / self.pixel).astype(np.int64)
        within = (row >= 0) & (row < self.mask.shape[0]) & (column >= 0) & (column < self.mask.shape[1])
        return within & self.mask[np.where(within, row, 0), np.where(within, column, 0)]

    def exit_fraction(self, start, end, bisections: int = 16) -> Float[np.ndarray, " branch"]:
        """The share of each straight piece from `start` to `end` that is seen in the foliage, 0-1 (`space.Barrier`); 1 for what starts outside, so that what was drawn
        there may stay where it is."""
        share = np.linspace(0.0, 1.0, 4 * _STEPS + 1)[1:]
        at = np.asarray(start)[:, None] + share[:, None] * (np.asarray(end) - start)[:, None]
        out = ~self.inside(at)
        first = np.where(out.any(axis=1), np.argmax(out, axis=1), len(share))
        return np.where(self.inside(start), np.r_[0.0, share][first], 1.0)

    @cached_property
    def centres(self) -> Float[np.ndarray, "foliage 2"]:
        """The middle of every pixel of foliage, metres."""
        row, column = np.nonzero(self.mask)
        return np.stack([self.left + (column + 0.5) * self.pixel, self.top - (row + 0.5) * self.pixel], axis=1)
