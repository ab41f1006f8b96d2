"""A cloud as it was read → the points of one tree that stands at the origin, y up: every step in order, and all that was done is said.

    doubles merged → turned upright → ground taken away → pot taken away → one tree → what belongs to nothing left out → thinned → moved so that its foot is the origin
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float

from sketchtree.axes import NULL
from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.files.placed import Placed, Placement
from sketchtree.clouds.prepared.doubled import single_rows
from sketchtree.clouds.prepared.ground import Ground, ground
from sketchtree.clouds.prepared.outliers import outliers
from sketchtree.clouds.prepared.pot import pot
from sketchtree.clouds.prepared.several import Plants, one_tree, plants
from sketchtree.clouds.prepared.up_axis import upright
from sketchtree.clouds.standing.stems import stems
from sketchtree.clouds.voxels import voxel_rows, voxel_size
from sketchtree.errors import SketchError

POINTS = 300_000
_FEWEST = 100  # points that may be a tree
_FLAT = 0.005  # of the width: what is no higher lies
_TALLEST, _LOWEST = 150.0, 0.05  # metres: a tree that isn't between them has other units


@dataclass(frozen=True, eq=False)
class Prepared:
    """The points of one tree."""

    cloud: PointCloud  # metres, y up, the foot at the origin
    above: Float[np.ndarray, " point"]  # metres above the ground; where none was seen, above the foot
    placement: Placement  # the file's coordinates → these
    up_sure: float  # that the axis is up, 0.5 to 1
    ground: bool  # whether some was seen
    trees: int  # that stood in the cloud
    remarks: tuple[str, ...]


def prepare(given: Placed | PointCloud, *, up: Literal["auto", "y", "z"] = "auto", tree: int | None = None, points: int = POINTS, keep_pot: bool = False) -> Prepared:
    """One tree of a cloud. `up`: the axis of the cloud that is up; `tree`: which of several, 1 the largest; `points`: how many are kept at most; `keep_pot`: a
    pot is not looked for.

    Raises SketchError where several trees stand and none was chosen, too few points are left, or nothing stands there; OptionError for another axis, or a tree that isn't there.
    """
    placed = given if isinstance(given, Placed) else Placed(given, Placement(), "cloud", None, len(given), 0.0, ())
    remarks = list(placed.remarks)
    cloud = _single(placed.cloud, remarks)
    stood = upright(cloud, up, placed.says_up)
    placement = placed.placement.then_turned(stood.axis)
    remarks += [stood.remark] if stood.remark else []
    cloud, above, floor = _cleared(stood.cloud, remarks)
    cloud, above = (cloud, above) if keep_pot else _unpotted(cloud, above, remarks)
    _check(len(cloud))
    _check_height(cloud)
    found = plants(cloud.xyz, above)
    rows = one_tree(found, tree, [_in_file(placement, x, z) for x, z in found.place])
    remarks += _left_out(found)
    cloud, above = cloud.select(rows), above[rows]
    if len(cloud) > points:
        rows = voxel_rows(cloud.xyz, voxel_size(cloud.xyz, points))
        remarks.append(f"The tree has {len(cloud):,} points; {len(rows):,} were kept, spread evenly.")
        cloud, above = cloud.select(rows), above[rows]
    lost = outliers(cloud.xyz)
    if lost.any():
        remarks.append(_said(int(lost.sum()), "point belongs to nothing; it was left out.", "points belong to nothing; they were left out."))
        cloud, above = cloud.select(~lost), above[~lost]
    _check(len(cloud))
    _check_height(cloud)
    foot = _foot(cloud.xyz, above)
    cloud = PointCloud(cloud.xyz - foot, cloud.colour, cloud.normal)
    remarks += _units(cloud.height)
    return Prepared(cloud, above, placement.then_moved(-foot), stood.sure, floor is not None, len(found), tuple(remarks))


def _single(cloud: PointCloud, remarks: list[str]) -> PointCloud:
    rows = single_rows(cloud.xyz)
    if len(rows) < len(cloud):
        remarks.append(_said(len(cloud) - len(rows), "point was there twice; both were merged.", "points were there twice; they were merged."))
    return cloud if len(rows) == len(cloud) else cloud.select(rows)


def _cleared(cloud: PointCloud, remarks: list[str]) -> tuple[PointCloud, np.ndarray, Ground | None]:
    """The cloud without its ground, and how high above it every point is."""
    floor = ground(cloud.xyz)
    if floor is None:
        return cloud, cloud.xyz[:, 1] - cloud.xyz[:, 1].min(), None
    remarks.append(f"{floor.is_ground.sum():,} points are ground (it slopes by {np.degrees(floor.slope):.0f}°); they were taken away.")
    kept = ~floor.is_ground & (floor.above > 0)
    _check(int(kept.sum()))
    return cloud.select(kept), floor.above[kept], floor


def _unpotted(cloud: PointCloud, above: np.ndarray, remarks: list[str]) -> tuple[PointCloud, np.ndarray]:
    """The cloud without the pot that the plant stands in, and how high above that every point is."""
    rim = pot(cloud.xyz, above) if len(cloud) >= _FEWEST else None
    if rim is None:
        return cloud, above
    kept = above >= rim
    remarks.append(f"{(~kept).sum():,} points are of a pot, or of what else the plant stands in, {rim:.2g} m high: they were taken away (`--keep-pot` leaves them).")
    return cloud.select(kept), above[kept] - rim


def _check(count: int) -> None:
    if count < _FEWEST:
        few = "None of the points" if not count else "Only one point" if count == 1 else f"Only {count:,} points"
        raise SketchError(f"{few} of the cloud may be a tree.", remedy="Give a cloud with more points, or one with a tree in it.")


def _check_height(cloud: PointCloud) -> None:
    """Nothing stands in points that all lie at one level."""
    wide = float(np.ptp(cloud.xyz[:, [0, 2]], axis=0).max())
    if cloud.height <= _FLAT * wide:
        raise SketchError(f"The points lie {wide:.3g} m wide and {cloud.height:.2g} m high: nothing stands there.", remedy="Check which axis is up (`--up y` or `--up z`).")


def _in_file(placement: Placement, x: float, z: float) -> str:
    """Where a tree stands, in the file's own coordinates."""
    here = placement.to_file(np.array([x, 0.0, z]))
    one, other = ((0, "x"), (2, "z")) if placement.up == "y" else ((0, "x"), (1, "y"))
    return ", ".join(f"{name} {round(float(here[k]), 1) + 0.0:.1f}" for k, name in (one, other))


def _left_out(found: Plants) -> list[str]:
    count = int((found.of_point == NULL).sum())
    return [_said(count, "point is of a low plant, or of what lies on the ground; it was left out.", "points are of low plants, or of what lies on the ground; they were left out.")] if count else []


def _said(count: int, of_one: str, of_more: str) -> str:
    return f"One {of_one}" if count == 1 else f"{count:,} {of_more}"


def _foot(xyz, above):
    """Where the largest stem stands, on the ground."""
    found = stems(xyz, above)
    rows = found.rows[0]
    lowest = rows[np.argsort(above[rows], kind="stable")[: max(3, len(rows) // 50)]]
    return np.array([found.place[0, 0], float(np.median(xyz[lowest, 1] - above[lowest])), found.place[0, 1]])


def _units(height: float) -> list[str]:
    if _LOWEST <= height <= _TALLEST:
        return []
    return [f"The tree would be {f'{height:,.0f}' if height > 1 else f'{height:.2g}'} m high: the cloud is probably not in metres (`--unit 0.001` for millimetres, 0.3048 for feet)."]
