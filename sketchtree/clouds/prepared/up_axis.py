"""Which axis of the points is up?

Ground says it: on one axis there is some, on the other there isn't. Where that doesn't decide, the trunk does. Seen along the axis that is up, a trunk is one dense spot, and its
points begin at the lowest end and go on without a gap; seen along another, the densest spot is some branch or other. And a tree stands on little: its lowest tenth lies over fewer
spots of the plan than its highest; a crown that lies on its side is about as wide at both ends. For an axis

    score = share of the points in the densest spot · (part of the height that some spot fills from the lowest end on) · spots of the highest tenth / spots of the lowest, 1 to 30

and the axis of the higher score is up, as surely as the squares of the scores differ. A spruce, or a tree that weeps to the ground, stands on much: there the third factor is 1. Scans
are mostly made with z up, so where the scores hardly differ z is taken, and that is said.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.pieces import Axis
from sketchtree.clouds.files.placed import turned
from sketchtree.clouds.prepared.ground import ground
from sketchtree.clouds.voxels import voxel_rows, voxel_size
from sketchtree.errors import OptionError

_LOOKED_AT = 40_000  # points
_SPOT = 0.03  # of the cloud's diagonal
_LAYERS = 40  # of the height
_END, _NARROWER = 0.1, 30.0  # of the height; so many times less at the foot than at the top is as much as counts
_UNSURE = 0.7


@dataclass(frozen=True, eq=False)
class Upright:
    """A cloud with y up."""

    cloud: PointCloud
    axis: Axis  # of the given cloud
    sure: float  # 0.5 (a guess) to 1
    remark: str | None


def upright(cloud: PointCloud, up: Literal["auto", "y", "z"] = "auto", says: Axis | None = None) -> Upright:
    """The cloud turned so that y is up: as told; else as its file says; else as it looks. Raises OptionError for another axis."""
    if up not in ("auto", "y", "z"):
        raise OptionError(f"`up` is {up!r}.", remedy="Say auto, y or z.")
    if up != "auto" or says is not None:
        axis = says if up == "auto" else up
        return Upright(_turned(cloud, axis), axis, 1.0, None)
    chance = up_chances(cloud.xyz)
    axis = "y" if chance > _UNSURE else "z"
    sure = max(0.5, chance if axis == "y" else 1.0 - chance)
    remark = f"Which axis of the cloud is up is hard to say; {axis} was taken. If the tree lies down, say which with `--up y` or `--up z`."
    return Upright(_turned(cloud, axis), axis, sure, remark if sure < _UNSURE else None)


def up_chances(xyz: Float[np.ndarray, "point 3"]) -> float:
    """How surely y is up rather than z, 0 to 1."""
    if len(xyz) > _LOOKED_AT:
        xyz = xyz[voxel_rows(xyz, voxel_size(xyz, _LOOKED_AT))]
    stood = [turned(xyz, axis) for axis in ("y", "z")]
    there = [0.0 if found is None else found.share for found in map(ground, stood)]
    if (there[0] > 0) != (there[1] > 0):
        return 0.99 if there[0] > 0 else 0.01
    one, other = (_stands(points) for points in stood)
    return float(one**2 / (one**2 + other**2))


def _stands(xyz: Float[np.ndarray, "point 3"]) -> float:
    """How much this looks like a tree that stands (y up)."""
    low, high = np.percentile(xyz[:, 1], [0.2, 99.8])
    spot = _SPOT * float(np.linalg.norm(np.ptp(np.percentile(xyz, [0.2, 99.8], axis=0), axis=0))) + 1e-12
    level = (xyz[:, 1] - low) / (high - low + 1e-12)
    return _trunk(xyz, spot, level) * _narrower(xyz, spot, level)


def _narrower(xyz, spot: float, level) -> float:
    """How many times fewer spots of the plan the lowest tenth lies over than the highest."""
    foot, top = (len(np.unique(np.floor(xyz[end][:, [0, 2]] / spot), axis=0)) for end in (level < _END, level > 1 - _END))
    return float(np.clip(top / max(foot, 1), 1.0, _NARROWER))


def _trunk(xyz, spot: float, level) -> float:
    """How much there is a trunk that begins at the lowest end."""
    layer = np.clip(level * _LAYERS, 0, _LAYERS - 1).astype(np.int64)
    share, run = 0.0, 0
    for shift in ([0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5]):  # a spot may lie across the border of cells
        cell = np.floor(xyz[:, [0, 2]] / spot + shift).astype(np.int64)
        _, name, count = np.unique(cell, axis=0, return_inverse=True, return_counts=True)
        share = max(share, float(count.max()) / len(xyz))
        filled = np.zeros((len(count), _LAYERS + 1), bool)
        filled[name.ravel(), layer] = True
        run = max(run, int((~filled).argmax(axis=1).max()))
    return share * (run + 1) / _LAYERS


def _turned(cloud: PointCloud, axis: Axis) -> PointCloud:
    return cloud if axis == "y" else PointCloud(turned(cloud.xyz, axis), cloud.colour, None if cloud.normal is None else turned(cloud.normal, axis))
