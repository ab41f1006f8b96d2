"""How deep is a tree of which one picture is known? As deep as wide: what is seen beside an axis stands before and behind it too.

Tan et al. 2008, §3.2: joints of the tree "rotated 90 degrees around the main trunk",

    (x, y, z) → (x_a − (z − z_a), y, z_a + (x − x_a))        x_a, z_a: the axis at the height y

The paper's axis is the trunk (`about_trunk`). A crown that hangs to one side of its trunk would then hang as far towards the viewer. Ours (`about_crown`, the default)
is the middle of the foliage at that height, of every lobe its own, as Chen et al. 2008 revolve a drawn crown; z_a is the trunk's.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy import ndimage

from sketchtree.propagate.attractors.target import Target

_GAP = 0.04  # of the crown's height: narrower gaps do not make two lobes of one
_SMOOTH = 0.04  # of the crown's height, over which an axis and a width are smooth


@dataclass(frozen=True, eq=False)
class Axes:
    """The axis that each place of the page turns about."""

    target: Target  # whose pixels the columns below are of
    middle: Float[np.ndarray, "row column"]  # x of the axis, metres
    half: Float[np.ndarray, "row column"]  # half the width of the lobe there, metres; 0 outside
    line: Float[np.ndarray, "point 2"]  # the trunk's (y, z), y rising

    @classmethod
    def about_crown(cls, target: Target, trunk: Float[np.ndarray, "point 3"]) -> "Axes":
        """Each lobe of the foliage about its own middle."""
        whole = target.closed(_GAP * target.height)
        filled = ndimage.binary_fill_holes(whole.mask)
        middle, half = _runs(filled)
        row, column = ndimage.distance_transform_edt(~filled, return_distances=False, return_indices=True)
        blur = _SMOOTH * target.height / whole.pixel
        middle = ndimage.gaussian_filter1d(middle[row, column], blur, axis=0, mode="nearest")
        half = np.where(filled, ndimage.gaussian_filter1d(half[row, column], blur, axis=0, mode="nearest"), 0.0)
        return cls(Target(filled, whole.left, whole.top, whole.pixel), whole.left + middle * whole.pixel, half * whole.pixel, _depths(trunk))

    @classmethod
    def about_trunk(cls, target: Target, trunk: Float[np.ndarray, "point 3"]) -> "Axes":
        """All about the line of the trunk, which goes on upright above its tip (the paper's)."""
        line = trunk[np.argsort(trunk[:, 1], kind="stable")]
        y = target.top - (np.arange(target.mask.shape[0]) + 0.5) * target.pixel
        middle = np.broadcast_to(np.interp(y, line[:, 1], line[:, 0])[:, None], target.mask.shape)
        x = target.left + (np.arange(target.mask.shape[1]) + 0.5) * target.pixel
        farthest = np.where(target.mask, np.abs(x - middle), 0.0).max(axis=1)[:, None]
        return cls(target, middle, np.where(target.mask, farthest, 0.0), _depths(trunk))

    def turned(self, point: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, "point 3"]:
        """The points a quarter turn further about their axes."""
        x, z = self._axis(point)
        return np.stack([x - (point[..., 2] - z), point[..., 1], z + (point[..., 0] - x)], axis=-1)

    def outward(self, point: Float[np.ndarray, "point 3"]) -> Float[np.ndarray, "point 3"]:
        """From its axis to each point, level, metres."""
        x, z = self._axis(point)
        return np.stack([point[..., 0] - x, np.zeros(point.shape[:-1]), point[..., 2] - z], axis=-1)

    def out(self, point: Float[np.ndarray, "*point 3"]) -> Float[np.ndarray, "*point"]:
        """How far from its axis each point is, over how far the foliage revolved goes there: 0 on the axis, 1 at the surface; infinite where none is seen."""
        row, column, inside = self._pixel(point)
        x, z = self._axis(point)
        half = np.where(inside, self.half[row, column], 0.0)
        return np.where(half > 0, np.hypot(point[..., 0] - x, point[..., 2] - z) / np.where(half > 0, half, 1.0), np.inf)

    def depth_of_trunk(self, y) -> np.ndarray:
        """z of the trunk at these heights, metres."""
        return np.interp(y, *self.line.T)

    def _axis(self, point):
        row, column, _ = self._pixel(point)
        return self.middle[row, column], self.depth_of_trunk(point[..., 1])

    def _pixel(self, point):
        """(row, column of the nearest pixel, whether the point is in it and that is foliage)."""
        place, (rows, columns) = self.target, self.target.mask.shape
        column = np.clip(np.floor((point[..., 0] - place.left) / place.pixel).astype(np.int64), 0, columns - 1)
        row = np.clip(np.floor((place.top - point[..., 1]) / place.pixel).astype(np.int64), 0, rows - 1)
        return row, column, place.inside(point)


def _runs(mask):
    """(the middle of the run of set pixels that each pixel of a row is in, half its width), in columns; 0 elsewhere."""
    start = mask & ~np.pad(mask, ((0, 0), (1, 0)))[:, :-1]
    end = mask & ~np.pad(mask, ((0, 0), (0, 1)))[:, 1:]
    number = np.cumsum(start, axis=None).reshape(mask.shape) - 1
    first, last = np.nonzero(start)[1], np.nonzero(end)[1] + 1
    number = np.where(mask, number, 0)
    return np.where(mask, 0.5 * (first + last)[number], 0.0), np.where(mask, 0.5 * (last - first)[number], 0.0)


def _depths(trunk):
    """The trunk's (y, z), y rising."""
    return trunk[np.argsort(trunk[:, 1], kind="stable")][:, 1:]
