"""Which photos are there, and where were they taken from? What every reader of poses gives."""

from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int

from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.lenses import Lens


@dataclass(frozen=True, eq=False)
class Posed:
    """One photo, the camera that took it, and its lens."""

    name: str  # of the file, with its folder where poses tell one
    camera: Camera  # as if its lens bent nothing
    lens: Lens = Lens()
    sees: Int[np.ndarray, " seen"] = field(default_factory=lambda: np.zeros(0, np.int64))  # rows of `Poses.points` that were matched in it


@dataclass(frozen=True, eq=False)
class Poses:
    """Photos of one scene in one frame, whose unit is a metre where the file's is."""

    photos: tuple[Posed, ...]
    points: Float[np.ndarray, "point 3"] = field(default_factory=lambda: np.zeros((0, 3)))  # that were matched, if known
    up: Float[np.ndarray, " 3"] | None = None  # a unit vector; None: to be found from the cameras
    error: float | None = None  # of the points in the photos, pixels

    def __len__(self) -> int:
        return len(self.photos)
