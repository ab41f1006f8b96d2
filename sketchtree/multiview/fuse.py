"""Which of all the depths are true, and what cloud do they make? Visibility over the views, then one point a voxel (Guo et al. 2018, §4; rules ours).

A pixel's place counts if its likelihood (Eq. 3) is at least `LEAST`, at least `AGREE` other views agree with it, and more views agree with it than see through
it: a view sees through a place where its own depth map, likely there, shows something more than `BEHIND` farther away. What photos look past is no place of the
plant (`outline`), nor is what a pixel shows that the plant fills less than `OWN` of: so thin limbs are as thin as they look. What is left is gathered in voxels
of the size of a pixel at the median depth: middle, mean colour, mean normal, each counted by likelihood and, squared, by how much of its pixel the plant fills. A
voxel with fewer than `COMPANY` others within `NEAR` voxels is a stray.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from scipy.spatial import cKDTree

from sketchtree.clouds.cloud import PointCloud
from sketchtree.errors import ViewsError
from sketchtree.multiview.compiled import side_by_side
from sketchtree.multiview.homography import normals_of
from sketchtree.multiview.outline import brought_in, filled, outlines_of
from sketchtree.multiview.workplace import Level
from sketchtree.watch import Pulse, no_pulse

LEAST = 0.25
AGREE = 2  # other views
BEHIND = 0.02  # of the depth
OWN = 0.35
COMPANY, NEAR = 4, 3.0


@dataclass(frozen=True, eq=False)
class Gathered:
    """Points of all views before they are thinned."""

    xyz: Float[np.ndarray, "point 3"]
    colour: Float[np.ndarray, "point 3"]
    normal: Float[np.ndarray, "point 3"]
    trust: Float[np.ndarray, " point"]
    size: float  # of a pixel at the median depth, world units


def confirmed(levels: list[Level]) -> float:
    """Share of the used pixels whose depth other photos confirm."""
    sure = sum(int((level.used & (level.likely >= LEAST) & (level.agreeing >= AGREE)).sum()) for level in levels)
    return sure / max(sum(int(level.used.sum()) for level in levels), 1)


def gathered(levels: list[Level], agree: int = AGREE, least: float = LEAST, outlines: bool = True, pulse: Pulse = no_pulse) -> Gathered:
    """The places of all depth maps that count; `outlines`: without those that photos look past. Raises ViewsError where none do."""
    alpha = [filled(level.rgb, level.empty) if outlines else None for level in levels]
    shown = outlines_of([level.camera for level in levels], alpha) if outlines else None

    def one(row: int):
        level = levels[row]
        y, x = np.nonzero(level.used & (level.likely >= least) & (level.agreeing >= min(agree, max(len(level.sources.rows), 1))))
        if not len(y):
            return None
        pixel, plane = np.column_stack([x, y]) + 0.5, level.plane[y, x].astype(np.float64)
        xyz = level.camera.unproject(pixel, 1.0 / plane[:, 0])
        keep = seen_through(xyz, level, levels) < level.agreeing[y, x]
        if outlines:
            keep &= alpha[row][y, x] >= OWN
            xyz[keep], keep[keep] = brought_in(xyz[keep], level.camera.centre, 1.0 / level.camera.matrix[0, 0], shown)
        trust = level.likely[y, x] * (alpha[row][y, x] ** 2 + 0.01 if outlines else 1.0)
        size = 1.0 / plane[keep, 0] / level.camera.matrix[0, 0]
        return xyz[keep], level.rgb[y, x][keep], normals_of(level.camera, pixel, plane)[keep], trust[keep], size

    columns = [some for some in side_by_side(one, range(len(levels)), pulse) if some is not None]
    if not columns or not sum(len(column[0]) for column in columns):
        raise ViewsError(
            "No place of the plant was found again in enough photos.",
            remedy="Check that poses belong to these photos; take more photos, nearer to one another, sharp and without wind.",
        )
    *columns, size = (np.concatenate(column).astype(np.float64) for column in zip(*columns, strict=True))
    return Gathered(*columns, float(np.median(size)))


def seen_through(xyz: Float[np.ndarray, "point 3"], own: Level, levels: list[Level]) -> np.ndarray:
    """How many other views see something behind each place."""
    count = np.zeros(len(xyz), np.int64)
    for other in levels:
        if other is own:
            continue
        pixel, depth = other.camera.project(xyz)
        held = np.flatnonzero(other.camera.holds(pixel, depth))
        x, y = pixel[held].astype(int).T
        sure = other.used[y, x] & (other.likely[y, x] >= 2 * LEAST) & (other.agreeing[y, x] >= AGREE)
        count[held] += sure & (depth[held] * (1.0 + BEHIND) < 1.0 / np.maximum(other.plane[y, x, 0], 1e-12))
    return count


def thinned(points: Gathered, size: float, keep: Bool[np.ndarray, " point"] | None = None) -> PointCloud:
    """One point for every voxel of that size: the middle of its points, counted by how far they are trusted."""
    columns = (points.xyz, points.colour, points.normal, points.trust)
    xyz, colour, normal, trust = columns if keep is None else (column[keep] for column in columns)
    _, voxel = np.unique(np.floor((xyz - xyz.min(axis=0)) / size).astype(np.int64), axis=0, return_inverse=True)
    voxel = voxel.ravel()
    whole = np.bincount(voxel, trust)[:, None]
    mean = [np.stack([np.bincount(voxel, trust * column[:, k]) for k in range(3)], axis=1) / whole for column in (xyz, colour, normal)]
    length = np.linalg.norm(mean[2], axis=1, keepdims=True)
    cloud = PointCloud(mean[0], np.clip(mean[1], 0.0, 1.0), np.where(length > 1e-6, mean[2] / np.maximum(length, 1e-6), [0.0, 1.0, 0.0]))
    stays = cKDTree(cloud.xyz).query_ball_point(cloud.xyz, NEAR * size, return_length=True) > COMPANY
    return cloud.select(stays) if stays.any() else cloud
