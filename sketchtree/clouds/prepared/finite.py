"""Which points are places? Those whose three numbers are finite: scanners write others where nothing came back."""

import numpy as np
from jaxtyping import Float

from sketchtree.clouds.cloud import PointCloud


def finite(
    xyz: Float[np.ndarray, "point 3"], colour: Float[np.ndarray, "point 3"] | None = None, normal: Float[np.ndarray, "point 3"] | None = None
) -> tuple[PointCloud, int]:
    """The cloud of the points that are places, and how many were left out. Raises SketchError where none is."""
    kept = np.isfinite(xyz).all(axis=1)
    return PointCloud(*(None if column is None else column[kept] for column in (xyz, colour, normal))), int((~kept).sum())
