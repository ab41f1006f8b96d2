"""How true and how whole is a cloud? Against the surface that was photographed, from 2 % of its height upwards, so that ground left in is no matter here.

accuracy       distance of the cloud's points from the surface: median, and the share within 0.5 % and 1.5 % of the tree's height
completeness   share of the surface seen by three views or more that has a point of the cloud within 0.5 % and 1.5 % of the height
"""

import numpy as np
from jaxtyping import Float
from scipy.spatial import cKDTree

from benchmarks.many_photos.renders import Rendered

SAMPLES = 300_000
SEEN_BY = 3
LOWEST = 0.02  # of the height


def sampled(corner: Float[np.ndarray, "triangle 3 3"], count: int, seed: int = 0) -> Float[np.ndarray, "point 3"]:
    """Points spread evenly over triangles."""
    chance = np.random.default_rng(seed)
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    own = corner[chance.choice(len(corner), count, p=area / area.sum())]
    u, v = np.sqrt(chance.uniform(size=count)), chance.uniform(size=count)
    weight = np.stack([1 - u, u * (1 - v), u * v], axis=1)
    return (own * weight[:, :, None]).sum(axis=1)


def visible(truth: Rendered, points: Float[np.ndarray, "point 3"]) -> np.ndarray:
    """How many views see each point: it is the nearest of all, or nearly, in its pixel."""
    seen = np.zeros(len(points), np.int64)
    for camera in truth.cameras:
        pixel, depth = camera.project(points)
        held = np.flatnonzero(camera.holds(pixel, depth))
        x, y = pixel[held].astype(int).T
        nearest = np.full((camera.size[1], camera.size[0]), np.inf)
        np.minimum.at(nearest, (y, x), depth[held])
        seen[held] += depth[held] < nearest[y, x] * 1.003
    return seen


def measured(cloud: Float[np.ndarray, "point 3"], truth: Rendered) -> dict[str, float]:
    """Accuracy and completeness, as shares; distances in metres."""
    surface, height = sampled(truth.corner, SAMPLES), truth.height
    cloud = cloud[cloud[:, 1] > LOWEST * height]
    away = cKDTree(surface).query(cloud)[0]
    seen = surface[(visible(truth, surface) >= SEEN_BY) & (surface[:, 1] > LOWEST * height)]
    back = cKDTree(cloud).query(seen)[0]
    return {
        "points": len(cloud), "median off": float(np.median(away)), "on .5 %": float((away < 0.005 * height).mean()), "on 1.5 %": float((away < 0.015 * height).mean()),
        "found .5 %": float((back < 0.005 * height).mean()), "found 1.5 %": float((back < 0.015 * height).mean()),
    }
