"""Photos of a plant → its cloud: every step in order, on one screen (Guo et al. 2018, §4).

photos → cameras (structure from motion, or poses that are given) → depth maps → fusion → cloud; masks instead of photos → visual hull → cloud
"""

import os
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from jaxtyping import Key

from sketchtree.clouds.cloud import PointCloud
from sketchtree.clouds.prepared.outliers import height_without
from sketchtree.errors import OptionError
from sketchtree.keys import numpy_generator, stage_key
from sketchtree.multiview.accelerated.engine import engine_of
from sketchtree.multiview.carve import carved, silhouette
from sketchtree.multiview.photos import View, photo_files, views_of
from sketchtree.multiview.poses.posed import Poses
from sketchtree.multiview.sky_and_ground import far_off, ground, within
from sketchtree.multiview.sources import sources_of
from sketchtree.multiview.upright import moved_upright
from sketchtree.watch import Pulse, Watch, no_pulse

if TYPE_CHECKING:
    from sketchtree.multiview.thin.contrasts import Contrasts

QUALITIES = ("preview", "full")
SOUGHT = {"preview": {"longest": 1000, "details": 4096}, "full": {"longest": 1600, "details": 8192}}  # by structure from motion; matching takes the square of details
FEW = 0.3  # of the pixels; of true cameras 45 % and more are confirmed, of cameras that look some pixels aside 10-30 %
DOUBTFUL = (
    "Only {:.0%} of the depths in the photos are confirmed by others: cameras may be wrong, or the plant moved. Check that poses belong to these photos, and that "
    "there was no wind."
)


@dataclass(frozen=True, eq=False)
class PhotosCloud:
    """The cloud, and what was learnt on the way."""

    cloud: PointCloud  # in the unit of given poses, or metres if a height was given, else the cameras' mean distance is 1; y up
    metric: bool
    placed: tuple[str, ...]  # photos whose cameras are known
    left_out: tuple[str, ...]  # photos that could not be placed
    error: float | None  # of matched points in the photos, pixels
    confirmed: float | None  # share of the pixels whose depth other photos confirm; None: carved
    size: float  # of a pixel at the median depth
    photos: "Contrasts | None"  # what they show of wood too thin for depths, in the frame of the cloud; None: carved
    notices: tuple[str, ...]
    seconds: dict[str, float] = field(default_factory=dict)


def photos_cloud(
    folder: str | os.PathLike, *, key: Key, poses: str | os.PathLike | None = None, quality: str = "preview", height: float | None = None,
    up: tuple[float, float, float] | None = None, keep_ground: bool = False, engine: str = "auto", watch: Watch | None = None, pulse: Pulse = no_pulse,
) -> PhotosCloud:
    """The cloud of the plant that the photos in a folder show.

    `poses`: a file or folder of them (`read_poses`), else they are found; `height`: of the plant, metres; `up`: in the frame of the poses;
    `engine`: what works PatchMatch out (`accelerated.engine`). Raises ViewsError for photos and poses that can't be used, OptionError for an unknown quality or
    engine, or a height that is none.
    """
    from sketchtree.multiview.depths import FULL, PREVIEW

    if quality not in QUALITIES:
        raise OptionError(f"There is no quality called {quality!r}.", remedy=f"Choose one of: {', '.join(QUALITIES)}.")
    if height is not None and not 0 < height < np.inf:
        raise OptionError(f"A height of {height:g} m is none.", remedy="Give metres above 0, or leave it out.")
    wanted, watch = replace(PREVIEW if quality == "preview" else FULL, engine=engine_of(engine)), watch or Watch()
    with watch("cameras"):
        placed, left_out, notices = _placed(folder, poses, quality, key, watch, pulse)
    with watch("photos"):
        upwards = placed.up if up is None else np.array(up)
        cameras, points, _ = moved_upright([photo.camera for photo in placed.photos], placed.points, upwards, poses is not None)
        views = _views(folder, placed, cameras, wanted.longest)
    cloud, size, confirmed, shown = _dense(views, points, placed, wanted, key, watch, pulse)
    if confirmed is not None and confirmed < FEW:
        notices = [*notices, DOUBTFUL.format(confirmed)]
    if not keep_ground:
        with watch("ground"):
            cloud, notices = _without_ground(cloud, key, notices)
            if confirmed is not None:
                cloud, notices = _without_far(cloud, notices)
    if height is not None:
        by = height / max(height_without(cloud.xyz), 1e-12)
        cloud, size = PointCloud(by * cloud.xyz, cloud.colour, cloud.normal), by * size
        shown = None if shown is None else shown.scaled(by)
    names = tuple(view.name for view in views)
    return PhotosCloud(cloud, poses is not None or height is not None, names, left_out, placed.error, confirmed, size, shown, tuple(notices), watch.seconds)


def _placed(folder, poses, quality, key, watch, pulse) -> tuple[Poses, tuple[str, ...], list[str]]:
    """Cameras, given or found."""
    if poses is not None:
        from sketchtree.multiview.poses.read_poses import read_poses

        found = read_poses(poses, folder)
        names = {os.path.basename(photo.name) for photo in found.photos}
        return found, tuple(file.name for file in photo_files(folder) if file.name not in names), []
    from sketchtree.multiview.sfm import structure_from_motion

    seed = int(numpy_generator(stage_key(key, "cameras")).integers(0, 2**31))
    found = structure_from_motion(folder, **SOUGHT[quality], seed=seed, part=watch.on_part, pulse=pulse)
    return found.poses, found.left_out, list(found.notices)


def _views(folder, placed: Poses, cameras, longest: int) -> list[View]:
    from sketchtree.multiview.poses.read_poses import find_photo

    files = photo_files(folder)
    return list(views_of(((find_photo(photo.name, files), camera, photo.lens) for photo, camera in zip(placed.photos, cameras, strict=True)), longest))


def _dense(views: list[View], points, placed: Poses, wanted, key, watch, pulse) -> tuple[PointCloud, float, float | None, "Contrasts | None"]:
    """The cloud, the size of a pixel in it, what share of the pixels is confirmed, what photos show of thin wood: of depth maps, or of the visual hull where most views are masks."""
    masks = [silhouette(view) for view in views]
    if sum(mask is not None for mask in masks) > len(views) / 2:
        with watch("carve"):
            rows = [k for k, mask in enumerate(masks) if mask is not None]
            cloud = carved([views[k] for k in rows], [masks[k] for k in rows], voxels=192 if wanted.longest < 800 else 384)
            return cloud, float(np.median(np.linalg.norm(np.diff(cloud.xyz, axis=0), axis=1))), None, None
    from sketchtree.multiview.depths import depth_maps
    from sketchtree.multiview.fuse import confirmed, gathered, thinned
    from sketchtree.multiview.thin.contrasts import contrasts_of

    sources = sources_of([view.camera for view in views], wanted.sources, points, [photo.sees for photo in placed.photos])
    levels = depth_maps(views, sources, wanted, key=stage_key(key, "depths"), watch=watch, pulse=pulse)
    with watch("fuse"):
        found = gathered(levels, pulse=pulse)
        near = within(found.xyz, [view.camera for view in views])
        shown = contrasts_of([level.camera for level in levels], [level.rgb for level in levels], [level.empty for level in levels])
        return thinned(found, found.size, near if near.sum() > 0.05 * len(near) else None), found.size, confirmed(levels), shown


def _without_far(cloud: PointCloud, notices: list[str]) -> tuple[PointCloud, list[str]]:
    far = far_off(cloud.xyz)
    if not far.any():
        return cloud, notices
    return cloud.select(~far), [*notices, f"{far.sum():,} points lie far from the plant; they were left out."]


def _without_ground(cloud: PointCloud, key, notices: list[str]) -> tuple[PointCloud, list[str]]:
    lies = ground(cloud, key=key)
    if not lies.any() or lies.all():
        return cloud, notices
    return cloud.select(~lies), [*notices, f"{lies.sum():,} points of the ground were left out."]
