"""Which way is up, and how large is the world, when the cameras alone are known?

Ours. Who takes photos holds the camera more or less level, so up is near the mean of the pictures' tops; who walks round a plant stays at a height, so where
the cameras lie in a plane (thickness under a fifth of its width) that is not farther than 35° from there, up is square to it. The origin is the place looked
at. Structure from motion knows no unit; then the cameras' mean distance from that place is 1 until a height is given.
"""

import numpy as np
from jaxtyping import Float

from sketchtree.multiview.cameras import Camera
from sketchtree.multiview.sources import looked_at

FLAT = 0.2
ASIDE = np.cos(np.radians(35.0))


def up_of(cameras: list[Camera]) -> Float[np.ndarray, " 3"]:
    """A unit vector of the cameras' world."""
    mean = np.mean([camera.up for camera in cameras], axis=0)
    mean = mean / max(np.linalg.norm(mean), 1e-12)
    centre = np.array([camera.centre for camera in cameras])
    _, width, axes = np.linalg.svd(centre - centre.mean(axis=0), full_matrices=True)
    if len(cameras) >= 3 and width[1] > 1e-9 and width[2] < FLAT * width[1] and abs(axes[2] @ mean) > ASIDE:
        return axes[2] * np.sign(axes[2] @ mean)
    return mean


def turn_up(up: Float[np.ndarray, " 3"]) -> Float[np.ndarray, "3 3"]:
    """The smallest rotation that makes `up` (0, 1, 0)."""
    up = np.asarray(up, np.float64) / np.linalg.norm(up)
    axis = np.cross(up, [0.0, 1.0, 0.0])
    cross = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
    if up[1] < -1.0 + 1e-9:
        return np.diag([1.0, -1.0, -1.0])
    return np.eye(3) + cross + cross @ cross / (1.0 + up[1])


def moved_upright(
    cameras: list[Camera], points: Float[np.ndarray, "point 3"], up: Float[np.ndarray, " 3"] | None, metric: bool
) -> tuple[list[Camera], Float[np.ndarray, "point 3"], float]:
    """(cameras and points with y up, the place looked at as origin; by how much the world was scaled: 1 where its unit is a metre)."""
    turn, focus = turn_up(up_of(cameras) if up is None else up), looked_at(cameras)
    scale = 1.0 if metric else 1.0 / max(float(np.mean([np.linalg.norm(camera.centre - focus) for camera in cameras])), 1e-12)
    shift = -scale * turn @ focus
    return [camera.moved(turn, scale, shift) for camera in cameras], scale * np.asarray(points) @ turn.T + shift, scale
