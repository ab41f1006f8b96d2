"""What is a point cloud? Places where a scanner or several photos saw something, and what they saw there.

Coordinates are metres, y up. What comes of cleaning, thinning or turning a cloud is another cloud.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.errors import SketchError


@dataclass(frozen=True, eq=False)
class PointCloud:
    """Points of one plant or of several. Columns are read-only. Raises SketchError for shapes that disagree, no point, or numbers that aren't finite."""

    xyz: Float[np.ndarray, "point 3"]  # metres, y up
    colour: Float[np.ndarray, "point 3"] | None = None  # sRGB, 0-1
    normal: Float[np.ndarray, "point 3"] | None = None  # unit, towards who saw it

    def __post_init__(self):
        for name in ("xyz", "colour", "normal"):
            value = getattr(self, name)
            if value is None:
                continue
            column = np.array(value, np.float64)
            if column.ndim != 2 or column.shape[1] != 3 or len(column) != len(self.xyz):
                raise SketchError(f"Column `{name}` of a cloud has shape {column.shape}.", remedy="Give every point three numbers.")
            column.flags.writeable = False
            object.__setattr__(self, name, column)
        if not len(self.xyz):
            raise SketchError("The cloud has no points.", remedy="Give a cloud with a plant in it.")
        if not np.isfinite(self.xyz).all():
            raise SketchError("Some points of the cloud are not finite.", remedy="Leave them out (`finite` does).")

    def __len__(self) -> int:
        return len(self.xyz)

    @property
    def height(self) -> float:
        """From the lowest point to the highest, metres."""
        return float(np.ptp(self.xyz[:, 1]))

    def select(self, keep: Int[np.ndarray, " kept"] | np.ndarray) -> "PointCloud":
        """Some of its points, by row or by a column of truths."""
        return PointCloud(*(None if value is None else value[keep] for value in (self.xyz, self.colour, self.normal)))
