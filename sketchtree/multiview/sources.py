"""Which other photos tell the depth of one, and between which depths is it to be sought?

Ours. The best partner stands about 10° further round the place that both look at: nearer ones tell depth badly, farther ones show another side. Depths run from
the nearest matched point to the farthest, with a margin; without points, from 0.35 to 1.9 of the distance of the place at which the cameras look (that nearest
to all their axes).
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from sketchtree.multiview.cameras import Camera

BEST_ANGLE, NARROWER, WIDER, WIDEST = 10.0, 4.0, 14.0, 50.0  # degrees
MARGIN = 0.25  # of the nearest and farthest depth of matched points
NEAR, FAR = 0.35, 1.9  # of the distance of the place looked at
_POINTS = 12  # fewer matched points tell no range


@dataclass(frozen=True, eq=False)
class Sources:
    """The partners of one view, best first, and its range of inverse depths."""

    rows: Int[np.ndarray, " source"]
    low: float
    high: float


def looked_at(cameras: list[Camera]) -> Float[np.ndarray, " 3"]:
    """The place nearest to all axes; where they are parallel, one ahead of them."""
    ahead = np.array([camera.ahead for camera in cameras])
    centre = np.array([camera.centre for camera in cameras])
    across = np.eye(3) - ahead[:, :, None] * ahead[:, None, :]
    spread = np.ptp(centre, axis=0).max()
    soft = 1e-6 * len(cameras)
    return np.linalg.solve(across.sum(axis=0) + soft * np.eye(3), (across @ centre[:, :, None]).sum(axis=0)[:, 0] + soft * (centre + spread * ahead).mean(axis=0))


def sources_of(cameras: list[Camera], most: int, points: Float[np.ndarray, "point 3"], sees: list[Int[np.ndarray, " seen"]]) -> list[Sources]:
    """For every camera its partners (`most` at most) and depths; `sees`: the rows of `points` that were matched in it."""
    focus = looked_at(cameras)
    back = np.array([camera.centre - focus for camera in cameras])
    back = back / np.maximum(np.linalg.norm(back, axis=1), 1e-12)[:, None]
    angle = np.degrees(np.arccos(np.clip(back @ back.T, -1.0, 1.0)))
    facing = np.degrees(np.arccos(np.clip(np.array([[a.ahead @ b.ahead for b in cameras] for a in cameras]), -1.0, 1.0)))
    off = angle - BEST_ANGLE
    worth = np.exp(-0.5 * (off / np.where(off < 0, NARROWER, WIDER)) ** 2) * (angle < WIDEST) * (facing < WIDEST)
    np.fill_diagonal(worth, 0.0)
    found = []
    for k, camera in enumerate(cameras):
        order = np.argsort(-worth[k], kind="stable")[:most]
        near, far = _depths(camera, points[sees[k]], focus)
        found.append(Sources(order[worth[k][order] > 0.0], 1.0 / far, 1.0 / near))
    return found


def _depths(camera: Camera, points, focus) -> tuple[float, float]:
    depth = camera.project(points)[1] if len(points) else np.zeros(0)
    depth = depth[depth > 0]
    if len(depth) >= _POINTS:
        near, far = np.quantile(depth, [0.01, 0.99])
        return float(near * (1.0 - MARGIN)), float(far * (1.0 + MARGIN))
    away = float(np.linalg.norm(focus - camera.centre))
    return NEAR * away, FAR * away
