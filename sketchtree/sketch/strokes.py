"""What was drawn? Freehand strokes, as they stand in the file."""

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np
from jaxtyping import Float

from sketchtree.errors import SketchError


class StrokeKind(StrEnum):
    """What a stroke stands for."""

    BRANCH = "branch"
    CROWN = "crown"
    OBSTACLE = "obstacle"
    FOREGROUND = "foreground"  # a scribble over a photo: this is tree (`sketchtree.matting`)
    BACKGROUND = "background"  # and this is not
    MATTE_ADD = "matte_add"  # painted into the matte that comes of the scribbles (`trunk.edit_matte`)
    MATTE_ERASE = "matte_erase"  # and out of it


SCRIBBLES = frozenset({StrokeKind.FOREGROUND, StrokeKind.BACKGROUND, StrokeKind.MATTE_ADD, StrokeKind.MATTE_ERASE})
"""What is said about a photo with a brush: no part of a drawn tree."""


@dataclass(frozen=True, eq=False)
class Stroke:
    """One freehand line. Requirements, checked at construction: at least one point, all finite."""

    id: str  # unique in its sketch; from the file where it has one
    points: Float[np.ndarray, "point 2"]  # user units, x right, y UP (already negated)
    kind: StrokeKind = StrokeKind.BRANCH
    labelled: bool = False  # the file says the kind (layer, class, id); else it may be found by shape
    closed: bool = False
    width: float | None = None  # line width, user units
    pressure: Float[np.ndarray, " point"] | None = None  # 0-1
    time: Float[np.ndarray, " point"] | None = None  # milliseconds
    filled: bool = False  # painted as an area rather than as a line
    wood: bool = False  # its width is the limb's own thickness, measured on the drawing; no pen set it
    layer: str | None = None  # name of the innermost layer or group it lies in, where the file has one
    view_deg: float = 0.0  # azimuth of the page it was drawn on, from that of the sketch: other than 0 on a turned page

    def __post_init__(self):
        points = np.array(self.points, np.float64).reshape(-1, 2)
        points.flags.writeable = False
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "view_deg", float(self.view_deg) + 0.0)  # not turned is 0.0, never -0.0
        if len(points) == 0:
            raise SketchError("it has no points.", stroke=self.id, remedy="Delete it or draw it again.")
        if not np.isfinite(self.view_deg):
            raise SketchError("the azimuth of its page is not a finite number.", stroke=self.id, remedy="Delete it or draw it again.")
        if not np.isfinite(points).all():
            raise SketchError(
                "it has a coordinate that is not a finite number.",
                stroke=self.id,
                remedy="Export the drawing again, or delete that stroke.",
            )


@dataclass(frozen=True, eq=False)
class Sketch:
    """A drawing: strokes in the order of the file, in its user units with y up."""

    strokes: tuple[Stroke, ...]
    name: str = "sketch"
    units: str = "px"
    view_deg: float = 0.0  # azimuth of the page when it was drawn
    page: tuple[float, float, float, float] | None = None  # left, bottom, right, top edge of the page, user units, y up
    warnings: tuple[str, ...] = field(default=())

    def __len__(self) -> int:
        return len(self.strokes)
