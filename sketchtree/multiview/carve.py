"""What is the largest body that no silhouette contradicts? The visual hull of masks (Laurentini 1994), for photos that are masks or show too little to be matched.

A cube round the place looked at is split into voxels; one that falls outside the mask of more than `spare` views that have it in the picture, or inside that of
less than half of all, is thrown away, the others are split again. The points are the middles of the voxels at the surface, their normals point away from what
is full around them, their colours are the mean of the views that show the surface from in front.
"""

import numpy as np
from jaxtyping import Bool
from scipy.ndimage import binary_dilation, distance_transform_edt

from sketchtree.clouds.cloud import PointCloud
from sketchtree.errors import ViewsError
from sketchtree.multiview.photos import View
from sketchtree.multiview.sources import looked_at

STARTS = 16  # voxels a side of the first cube
_FACES = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)])


def silhouette(view: View) -> Bool[np.ndarray, "row column"] | None:
    """The mask that a view is: its alpha channel, or what is white where it is black and white. None: it is a photo."""
    if view.cut_out:
        return view.seen
    brightness = view.rgb.mean(axis=2)
    two = (brightness < 0.1) | (brightness > 0.9)
    return brightness > 0.5 if two.mean() > 0.97 and np.ptp(view.rgb, axis=2).mean() < 0.02 and 0.001 < (brightness > 0.5).mean() < 0.9 else None


def carved(views: list[View], masks: list[Bool[np.ndarray, "row column"]], *, voxels: int = 256, spare: int = 1) -> PointCloud:
    """The surface of the visual hull, `voxels` across the cube. Raises ViewsError where the masks have nothing in common."""
    cameras = [view.camera for view in views]
    focus = looked_at(cameras)
    reach = 0.75 * min(np.linalg.norm(camera.centre - focus) for camera in cameras)
    away = [distance_transform_edt(~mask) for mask in masks]  # pixels to the mask
    side, cell = 2 * reach / STARTS, np.argwhere(np.ones((STARTS,) * 3))
    while True:
        cell = cell[_inside(focus - reach + (cell + 0.5) * side, side, cameras, away, spare)]
        if not len(cell):
            raise ViewsError("The silhouettes have no place in common.", remedy="Check that masks are white where the plant is, and that poses belong to them.")
        if 2 * reach / side >= voxels:
            break
        side /= 2
        cell = (2 * cell[:, None, :] + np.argwhere(np.ones((2, 2, 2)))).reshape(-1, 3)
    return _surface(cell, focus - reach, side, views)


def _inside(middle, side, cameras, away, spare) -> Bool[np.ndarray, " cell"]:
    """Which voxels may touch the plant: their balls meet the mask in all but `spare` of the views that have them, and in half of all."""
    misses, seen = np.zeros(len(middle), np.int64), np.zeros(len(middle), np.int64)
    for camera, distance in zip(cameras, away, strict=True):
        pixel, depth = camera.project(middle)
        held = np.flatnonzero(camera.holds(pixel, depth))
        x, y = pixel[held].astype(int).T
        radius = 0.87 * side * camera.matrix[0, 0] / depth[held]  # half a diagonal, pixels
        misses[held] += distance[y, x] > radius
        seen[held] += 1
    return (misses <= spare) & (2 * (seen - misses) >= len(cameras))


def _surface(cell, corner, side, views: list[View]) -> PointCloud:
    low = cell.min(axis=0) - 2
    full = np.zeros(cell.max(axis=0) - low + 3, bool)
    full[tuple((cell - low).T)] = True
    rim = np.argwhere(full & binary_dilation(~full))
    out = np.stack([_FACES[k] * ~full[tuple((rim + _FACES[k]).T)][:, None] for k in range(6)]).sum(axis=0).astype(float)
    out += 0.3 * _FACES[np.argmax(np.stack([~full[tuple((rim + face).T)] for face in _FACES]), axis=0)]
    normal = out / np.linalg.norm(out, axis=1, keepdims=True)
    xyz = corner + (rim + low + 0.5) * side
    colour, weight = np.zeros((len(xyz), 3)), np.full(len(xyz), 1e-9)
    for view in views:
        pixel, depth = view.camera.project(xyz)
        held = np.flatnonzero(view.camera.holds(pixel, depth))
        x, y = pixel[held].astype(int).T
        facing = np.maximum(-(normal[held] @ view.camera.ahead), 0.0) * (view.seen[y, x] + 1e-3)
        colour[held] += facing[:, None] * view.rgb[y, x]
        weight[held] += facing
    return PointCloud(xyz, np.clip(colour / weight[:, None], 0.0, 1.0), normal)
