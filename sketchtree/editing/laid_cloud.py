"""Which points of a scan lie behind the drawing, where, and what is to be done with them?

Their foot stands at a place of the front page, upright, so many of its units to a metre; from there they turn with the page (`editing.turning`). Strokes over them take their depth from
them (`editing.seen`), or the tree that stands in them is traced (`laid_tree`).
"""

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Float

from sketchtree.errors import OptionError, SketchError
from sketchtree.sketch.strokes import SCRIBBLES, Stroke, StrokeKind

if TYPE_CHECKING:
    from sketchtree.clouds.cloud import PointCloud
    from sketchtree.clouds.prepared.prepare import Prepared

MOST = 60_000  # points that a drawing keeps
SIZES = (0.5, 8.0)  # CSS pixels that a point may be wide
_EMPTY = 800.0  # height on a page without a stroke, sketch units


@dataclass(frozen=True)
class LaidCloud:
    """The points of one plant. Raises SketchError for bytes that are no points, OptionError for a place that is none."""

    points: bytes = field(repr=False)  # x, y, z of each as 32 bits, little-endian: metres, y up, the foot at the origin; then, where there are colours, red, green and blue of each as 8 bits
    coloured: bool
    x: float  # of its foot, sketch units
    y: float  # up
    unit: float  # sketch units a metre, > 0
    trunk: float = 0.0  # radius of the stoutest stem at its foot, metres; 0: the points don't tell
    remarks: tuple[str, ...] = ()  # what was done to the points of the file

    def __post_init__(self):
        object.__setattr__(self, "remarks", tuple(self.remarks))  # files have lists
        if not (np.isfinite([self.x, self.y, self.unit, self.trunk]).all() and self.unit > 0 and self.trunk >= 0):
            raise OptionError("The cloud lies nowhere.", remedy="Lay it under the drawing again.")
        if not self.points or len(self.points) % self._stride or len(self) > MOST or not np.isfinite(self._xyz).all():
            raise SketchError("The points behind the drawing can't be read.", remedy="Open their cloud again.")

    def __len__(self) -> int:
        return len(self.points) // self._stride

    @property
    def _stride(self) -> int:
        return 15 if self.coloured else 12

    @property
    def _xyz(self) -> Float[np.ndarray, "point 3"]:
        return np.frombuffer(self.points, "<f4", 3 * len(self)).reshape(-1, 3)

    @property
    def digest(self) -> str:
        """What its points are known by."""
        return _digest(self.points)

    @property
    def place(self) -> tuple[float, float, float]:
        """x, y, unit."""
        return self.x, self.y, self.unit

    @property
    def cloud(self) -> "PointCloud":
        """Its points: metres, y up, the foot at the origin."""
        from sketchtree.clouds.cloud import PointCloud

        colour = np.frombuffer(self.points, np.uint8, offset=12 * len(self)).reshape(-1, 3) / 255.0 if self.coloured else None
        return PointCloud(self._xyz, colour)

    @property
    def on_page(self) -> Float[np.ndarray, "point 3"]:
        """The same in sketch units on the front page: x to the right, y up, z towards the viewer."""
        return self._xyz.astype(np.float64) * self.unit + (self.x, self.y, 0.0)

    @property
    def height(self) -> float:
        """Of its highest point above its foot, metres."""
        return float(self._xyz[:, 1].max())


@dataclass(frozen=True)
class CloudChoices:
    """How it is seen, and whether its own tree is wanted. Raises OptionError for a value out of range."""

    shown: bool = True
    size: float = 2.0  # CSS pixels that a point is wide
    traced: bool = False  # the tree is the one that stands in the points (`cloud_tree`), not that of the strokes
    turn: float = 0.0  # degrees: the azimuth that the page faced last

    def __post_init__(self):
        if not -360.0 <= self.turn <= 360.0:
            raise OptionError(f"A page turned by {self.turn:g} degrees is out of range.", remedy="Turn it by -360 to 360.")
        if not SIZES[0] <= self.size <= SIZES[1]:
            raise OptionError(f"A point of {self.size:g} pixels is out of range.", remedy=f"Choose {SIZES[0]:g} to {SIZES[1]:g}.")

    @property
    def drawn(self) -> "CloudChoices":
        """The same, where the tree is that of the strokes."""
        return replace(self, traced=False)


def laid(prepared: "Prepared", strokes: Iterable[Stroke] = ()) -> LaidCloud:
    """The points of a plant behind a drawing: its foot at that of the drawn branches, and as high as they are; alone, on a page of its own."""
    from sketchtree.clouds.voxels import voxel_rows, voxel_size

    cloud, remarks = prepared.cloud, prepared.remarks
    if len(cloud) > MOST:
        rows = voxel_rows(cloud.xyz, voxel_size(cloud.xyz, MOST))
        remarks += (f"The drawing keeps {len(rows):,} of the tree's {len(cloud):,} points, spread evenly.",)
        cloud = cloud.select(rows)
    points = cloud.xyz.astype("<f4").tobytes()
    if cloud.colour is not None:
        points += np.round(255 * np.clip(cloud.colour, 0.0, 1.0)).astype(np.uint8).tobytes()
    return LaidCloud(points, cloud.colour is not None, *_place(float(cloud.xyz[:, 1].max()), strokes), _stoutest(prepared), remarks)


def _stoutest(prepared: "Prepared") -> float:
    """Radius of the stoutest stem at its foot, metres; 0 where none can be measured."""
    from sketchtree.clouds.standing.feet import feet
    from sketchtree.clouds.standing.stems import breast_height
    from sketchtree.clouds.standing.trunk import trunk

    xyz = prepared.cloud.xyz
    found = (trunk(xyz[rows], breast_height(prepared.cloud.height)) for rows in feet(xyz, prepared.above).stems)
    return max((one.root / 2 for one in found if one is not None), default=0.0)


def laid_under(cloud: LaidCloud, strokes: Iterable[Stroke]) -> LaidCloud:
    """The same points, behind another drawing."""
    x, y, unit = _place(cloud.height, strokes)
    return replace(cloud, x=x, y=y, unit=unit)


def _place(height: float, strokes: Iterable[Stroke]) -> tuple[float, float, float]:
    drawn = [stroke for stroke in strokes if stroke.view_deg % 360.0 == 0.0 and stroke.kind not in (*SCRIBBLES, StrokeKind.OBSTACLE)]
    limbs = [stroke.points for stroke in drawn if stroke.kind == StrokeKind.BRANCH]
    if not limbs:
        return 0.0, 0.0, _EMPTY / height
    low = np.concatenate(limbs)
    foot = low[low[:, 1].argmin()]
    tall = max(stroke.points[:, 1].max() for stroke in drawn) - foot[1]
    return float(foot[0]), float(foot[1]), float(tall / height) if tall > 0 else _EMPTY / height


@lru_cache(maxsize=8)
def _digest(points: bytes) -> str:
    return hashlib.sha256(points).hexdigest()[:32]
