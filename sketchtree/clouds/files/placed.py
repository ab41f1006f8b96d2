"""What was done to a file's points on their way to metres? All of it, so that a result can be laid over the file again."""

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.pieces import Axis
from sketchtree.similarity import Similarity


@dataclass(frozen=True)
class Placement:
    """world = scale · turned + translate, where turned is the file's point with its up axis as y: of z-up points (x, z, −y)."""

    up: Axis = "y"  # the file's axis that is y in the world
    similarity: Similarity = Similarity(1.0, (0.0, 0.0, 0.0))

    def to_world(self, point: Float[np.ndarray, "*point 3"]) -> Float[np.ndarray, "*point 3"]:
        """The file's coordinates → metres, y up."""
        return self.similarity.to_world(turned(point, self.up))

    def to_file(self, point: Float[np.ndarray, "*point 3"]) -> Float[np.ndarray, "*point 3"]:
        """Metres, y up → the file's coordinates."""
        held = self.similarity.to_sketch(point)
        return held if self.up == "y" else np.stack([held[..., 0], -held[..., 2], held[..., 1]], axis=-1)

    def then_turned(self, up: Axis) -> "Placement":
        """After its points, whose up axis was not known yet, were turned."""
        return Placement(up, Similarity(self.similarity.scale, tuple(map(float, turned(np.array(self.similarity.translate), up)))))

    def then_moved(self, by: Float[np.ndarray, "3"]) -> "Placement":
        """After its points were moved by so many metres."""
        return replace(self, similarity=Similarity(self.similarity.scale, tuple(float(a + b) for a, b in zip(self.similarity.translate, by, strict=True))))


@dataclass(frozen=True, eq=False)
class Placed:
    """A cloud as it was read: metres, near the origin, its axes still the file's."""

    cloud: PointCloud
    placement: Placement  # file → cloud; `up` is y: nothing was turned
    what: str  # PLY, LAS, LAZ, NPY, NPZ, text
    says_up: Axis | None  # the axis that the file says is up
    read: int  # points of the file
    voxel: float  # metres, of which one point was kept; 0 where all were
    remarks: tuple[str, ...]


def turned(point: Float[np.ndarray, "*point 3"], up: Axis) -> Float[np.ndarray, "*point 3"]:
    """Points whose axis `up` is up, with y up: right-handed, x stays."""
    return point if up == "y" else np.stack([point[..., 0], point[..., 2], -point[..., 1]], axis=-1)
