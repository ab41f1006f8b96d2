"""Where in a picture does a place in the world appear, and what lies behind a pixel?

A camera without distortion {K, R, C} (Guo et al. 2018, §4): a place X is seen at

    x ~ K R (X − C)

    K   matrix     focal lengths and principal point, pixels
    R   rotation   world → camera; the camera's x runs to the right, y down, z ahead
    C   centre     of the camera, world units

The middle of the first pixel is at (0.5, 0.5), as in COLMAP.
"""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from sketchtree.errors import ViewsError


@dataclass(frozen=True, eq=False)
class Camera:
    """One camera. Columns are read-only. Raises ViewsError for numbers that are no camera."""

    matrix: Float[np.ndarray, "3 3"]
    rotation: Float[np.ndarray, "3 3"]
    centre: Float[np.ndarray, " 3"]
    size: tuple[int, int]  # width and height, pixels

    def __post_init__(self):
        for name, shape in (("matrix", (3, 3)), ("rotation", (3, 3)), ("centre", (3,))):
            value = np.array(getattr(self, name), np.float64)
            if value.shape != shape or not np.isfinite(value).all():
                raise ViewsError(f"The `{name}` of a camera is not {' × '.join(map(str, shape))} finite numbers.", remedy="Write the cameras again.")
            value.flags.writeable = False
            object.__setattr__(self, name, value)
        if np.abs(self.rotation @ self.rotation.T - np.eye(3)).max() > 1e-3 or np.linalg.det(self.rotation) < 0:
            raise ViewsError("The rotation of a camera is no rotation.", remedy="Write the cameras again: rows of length 1, right-handed.")
        if min(self.matrix[0, 0], self.matrix[1, 1]) <= 0 or min(self.size) < 1:
            raise ViewsError(f"A camera of {self.size[0]} × {self.size[1]} pixels has the focal length {self.matrix[0, 0]:g}.", remedy="Both must be positive.")

    @property
    def to_pixel(self) -> Float[np.ndarray, "3 4"]:
        """K R (X − C) as one matrix: of (x, y, z, 1), pixels times depth and depth."""
        return self.matrix @ np.column_stack([self.rotation, -self.rotation @ self.centre])

    @property
    def ahead(self) -> Float[np.ndarray, " 3"]:
        """Where it looks, a unit vector of the world."""
        return self.rotation[2]

    @property
    def up(self) -> Float[np.ndarray, " 3"]:
        """The top of its picture, a unit vector of the world."""
        return -self.rotation[1]

    def project(self, xyz: Float[np.ndarray, "point 3"]) -> tuple[Float[np.ndarray, "point 2"], Float[np.ndarray, " point"]]:
        """Pixels, and depths along the axis (behind the camera: not above 0, and the pixel means nothing)."""
        local = (np.asarray(xyz) - self.centre) @ self.rotation.T
        depth = local[:, 2]
        flat = local @ self.matrix.T
        return flat[:, :2] / np.where(depth > 0, depth, np.inf)[:, None], depth

    def unproject(self, pixel: Float[np.ndarray, "point 2"], depth: Float[np.ndarray, " point"]) -> Float[np.ndarray, "point 3"]:
        """Places of the world at those depths along the axis."""
        ray = np.column_stack([pixel, np.ones(len(pixel))]) @ np.linalg.inv(self.matrix).T
        return (ray * np.asarray(depth)[:, None]) @ self.rotation + self.centre

    def pixels(self) -> Float[np.ndarray, "pixel 2"]:
        """The middles of all its pixels, row by row."""
        column, row = np.meshgrid(np.arange(self.size[0]) + 0.5, np.arange(self.size[1]) + 0.5)
        return np.column_stack([column.ravel(), row.ravel()])

    def holds(self, pixel: Float[np.ndarray, "point 2"], depth: Float[np.ndarray, " point"]) -> np.ndarray:
        """Whether what `project` gave lies in the picture."""
        return (depth > 0) & (pixel >= 0).all(axis=1) & (pixel < np.array(self.size)).all(axis=1)

    def resized(self, size: tuple[int, int]) -> "Camera":
        """The same camera with a picture of another size."""
        by = np.array([size[0] / self.size[0], size[1] / self.size[1], 1.0])
        return replace(self, matrix=by[:, None] * self.matrix, size=(int(size[0]), int(size[1])))

    def moved(self, turn: Float[np.ndarray, "3 3"], scale: float, shift: Float[np.ndarray, " 3"]) -> "Camera":
        """The same camera in a world whose places are scale · turn X + shift."""
        return replace(self, rotation=self.rotation @ turn.T, centre=scale * turn @ self.centre + shift)
