"""What do twenty pictures show of a tree? Renders from known cameras, the whole tree in each → depth maps → cloud, as `sketchtree views` makes it."""

import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from benchmarks.many_photos.renders import camera_of
from benchmarks.many_photos.sheet import depth_picture
from benchmarks.twenty_views.models import Model
from sketchtree.clouds.cloud import PointCloud
from sketchtree.keys import root_key
from sketchtree.multiview.depths import FULL, PREVIEW, depth_maps
from sketchtree.multiview.fuse import gathered, thinned
from sketchtree.multiview.photos import View
from sketchtree.multiview.sky_and_ground import ground, within
from sketchtree.multiview.sources import Sources, sources_of
from sketchtree.multiview.thin.contrasts import contrasts_of
from sketchtree.multiview.thin.followed import Following
from sketchtree.multiview.workplace import Level, level_of
from sketchtree.view.picture import draw_in_child, frame_camera, request_of

VIEWS = 20
FINE = 720  # pixels a side: larger pictures are worked on at full quality
NO_PARTNERS = Sources(np.zeros(0, np.int64), 0.0, 1.0)
SHOWN = (0, 5)  # views whose depth maps are kept as pictures
LOW, HIGH = 4.0, 16.0  # degrees that cameras look down by, in turns


def seen(model: Model, folder: Path, pixels: int) -> PointCloud:
    """The cloud of a model: made once, then read from the folder."""
    kept = folder / f"{model.name}_{pixels}.npz"
    if not kept.exists():
        began = time.process_time()
        folder.mkdir(parents=True, exist_ok=True)
        cloud, levels = cloud_of(pictures(model, folder / f"{model.name}_{pixels}.png", pixels), pixels)
        Image.fromarray(np.concatenate([depth_picture(levels[k]) for k in SHOWN], axis=1)).save(folder / f"{model.name}_{pixels}_depths.png")
        np.savez_compressed(kept, xyz=cloud.xyz.astype(np.float32), colour=cloud.colour.astype(np.float32), normal=cloud.normal.astype(np.float32), seconds=time.process_time() - began)
    with np.load(kept) as file:
        return PointCloud(file["xyz"], file["colour"], file["normal"])


def pictures(model: Model, sheet: Path, pixels: int) -> list[View]:
    """The model from twenty sides, as high and as wide; all are drawn on one sheet."""
    around = _around(model)
    angles = [(360.0 * k / VIEWS, (LOW, HIGH)[k % 2]) for k in range(VIEWS)]
    if not sheet.exists():
        drawn, why = draw_in_child(request_of([model.mesh], angles, (pixels, pixels), around=around, ground=True, supersample=2), sheet, 3000.0)
        if not drawn:
            raise RuntimeError(why)
    whole, columns = np.asarray(Image.open(sheet).convert("RGB"), np.float32) / 255.0, int(np.ceil(np.sqrt(VIEWS)))
    views = []
    for k, pose in enumerate(frame_camera(around, *angle, 1.0) for angle in angles):
        y, x = pixels * (k // columns), pixels * (k % columns)
        views.append(View(f"{k:03d}.png", camera_of(pose, pixels), np.ascontiguousarray(whole[y : y + pixels, x : x + pixels]), np.ones((pixels, pixels), bool)))
    return views


def pixel(model: Model, pixels: int) -> float:
    """How much of the model a pixel is, at its middle, metres."""
    around = _around(model)
    camera = camera_of(frame_camera(around, 0.0, LOW, 1.0), pixels)
    return float(camera.project(around.mean(axis=0)[None])[1][0] / camera.matrix[0, 0])


def following(model: Model, folder: Path, pixels: int) -> Following:
    """What the pictures show of twigs too thin for the cloud."""
    levels = [level_of(view, NO_PARTNERS, 1) for view in pictures(model, folder / f"{model.name}_{pixels}.png", pixels)]
    shown = contrasts_of([level.camera for level in levels], [level.rgb for level in levels], [level.empty for level in levels])
    return Following(shown, pixel(model, pixels))


def _around(model: Model) -> np.ndarray:
    """What has to be in every picture: places on a cylinder, from every side the same."""
    place = np.asarray(model.mesh.position, float)
    reach, high = np.hypot(place[:, 0], place[:, 2]).max(), place[:, 1].max()
    turn = np.arange(48) * np.pi / 24
    return np.concatenate([np.stack([reach * np.cos(turn), np.full(48, level), reach * np.sin(turn)], axis=1) for level in (0.0, high)])


def cloud_of(views: list[View], pixels: int) -> tuple[PointCloud, list[Level]]:
    """The cloud of pictures whose cameras are known, and their depth maps."""
    quality, cameras = replace(FULL if pixels > FINE else PREVIEW, longest=pixels), [view.camera for view in views]
    none = [np.zeros(0, np.int64)] * len(views)
    levels = depth_maps(views, sources_of(cameras, quality.sources, np.zeros((0, 3)), none), quality, key=root_key(0))
    points = gathered(levels)
    cloud = thinned(points, points.size, within(points.xyz, cameras))
    return cloud.select(~ground(cloud, key=root_key(0))), levels
